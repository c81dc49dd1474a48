// The built-in analytic materials: whole tables, usable like a measured one.
#include <gtest/gtest.h>

#include "close.h"
#include "support.h"

using oracle::Table;

namespace {

const char *const names[] = {"builtin:two-layer", "builtin:conductor"};

test::Brdf open(const char *name) {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open(name, b.out()));
    return b;
}

// Reflected share of light that arrives at the given angle: integral of f cos over the hemisphere of the table.
double albedo(const Table &table, double theta, std::size_t channel) {
    constexpr int n = 200;
    double sum = 0.0;
    const oracle::Vec wo = oracle::spherical(theta, 0.0);
    for (int j = 0; j < n; ++j)
        for (int k = 0; k < n; ++k) {
            const double t = (j + 0.5) * oracle::pi / 2.0 / n, phi = (k + 0.5) * 2.0 * oracle::pi / n;
            const oracle::Vec wi = oracle::spherical(t, phi);
            const oracle::HalfDiff at = oracle::half_diff(wi, wo, {0.0, 0.0, 1.0});
            sum += oracle::lookup(table, oracle::Lookup::linear, at)[channel] * wi.z * std::sin(t);
        }
    return sum * oracle::pi / 2.0 / n * 2.0 * oracle::pi / n;
}

} // namespace

TEST(Builtin, DescribesItself) {
    for (const char *name : names) {
        smx_brdf_info info = SMX_BRDF_INFO_INIT;
        ASSERT_SMX_OK(smx_brdf_get_info(open(name), &info));
        EXPECT_STREQ(info.source, name);
        EXPECT_EQ("builtin:" + std::string(info.name), name);
        EXPECT_EQ(info.cells, 90u * 90u * 180u);
        EXPECT_EQ(info.filled_cells, 0u);
        EXPECT_EQ(std::string(info.sha256).size(), 64u);
    }
}

TEST(Builtin, KeepsEnergyAndIsReciprocal) {
    for (const char *name : names) {
        const Table table = test::filled_table(open(name));
        for (std::size_t c = 0; c < 3; ++c)
            for (const double theta : {0.1, 0.8, 1.3}) {
                EXPECT_LT(albedo(table, theta, c), 1.0 + 1e-3) << name << ", channel " << c << ", theta " << theta;
                EXPECT_GT(albedo(table, theta, c), 0.005) << name;
            }
        // wi and wo swapped is phi_d + pi, the same cell; mirrored is pi - phi_d.
        for (int pd = 1; pd < 90; pd += 7)
            EXPECT_CLOSE(table.at(0, 20, 30, pd), table.at(0, 20, 30, 180 - pd), 1e-9, 0.0) << name;
    }
}

TEST(Builtin, TwoLayersAreABodyUnderAWhiteGloss) {
    const Table t = test::filled_table(open("builtin:two-layer"));
    // The gloss is grey and far above the body; the body is coloured.
    EXPECT_GT(t.at(1, 0, 0, 0), 10.0 * t.at(1, 60, 0, 0));
    const double gloss = (t.at(0, 0, 0, 0) - t.at(0, 60, 0, 0)) / (t.at(2, 0, 0, 0) - t.at(2, 60, 0, 0));
    EXPECT_CLOSE(gloss, 1.0, 0.1, 0.0);
    const double body = t.at(0, 60, 0, 0) / t.at(2, 60, 0, 0);
    EXPECT_GT(std::abs(std::log(body)), 0.2);
}

TEST(Builtin, ConductorIsOneLobe) {
    const test::Density density = test::make_density(open("builtin:conductor"), SMX_MASKING_CORRELATED);
    smx_fit_report one = SMX_FIT_REPORT_INIT;
    ASSERT_SMX_OK(smx_material_get_report(test::fit(density, 1), &one));
    EXPECT_LT(one.residual, 0.05);
}

TEST(Builtin, UnknownNamesAreRefused) {
    smx_brdf brdf = nullptr;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "velvet", smx_brdf_open("builtin:velvet", &brdf));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "two-layer", smx_brdf_open("builtin:", &brdf));
    EXPECT_EQ(brdf, nullptr);
}
