// Errors in BRDF space: closed forms on Lambertians, an integral over directions written without the table's angles,
// and materials whose tables the oracle makes.
#include <gtest/gtest.h>

#include "close.h"
#include "support.h"

using oracle::Rgb;
using oracle::Table;
using oracle::Vec;

namespace {

// Of a mean over the table's cells against the integral over all directions: cells of a degree, cut at the horizon.
constexpr double cells_tolerance = 2e-3;
// The same with the cut at 80 degrees, which goes through cells as well.
constexpr double cut_tolerance = 5e-3;
// Of sums that differ in their order only.
constexpr double exact = 1e-9;
// Of sums over the same cells but a few: those at the horizon, which rounding puts above or below it.
constexpr double horizon_tolerance = 1e-6;
// Of an error that should be 0, for values up to a few.
constexpr double zero_tolerance = 1e-9;

test::Brdf open(const char *input) {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open(input, b.out()));
    return b;
}

smx_brdf_errors compare(smx_brdf brdf, smx_brdf reference) {
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    EXPECT_SMX_OK(smx_brdf_compare(brdf, reference, &errors));
    return errors;
}

smx_brdf_errors errors_of(smx_material material, smx_brdf reference) {
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    EXPECT_SMX_OK(smx_material_brdf_errors(material, reference, &errors));
    return errors;
}

// Root of the mean of e(mu)^2 over mu = cos_i in low..1: the hemisphere's solid angle is uniform in it.
template <class E>
double rms(double low, E e) {
    constexpr int n = 4000;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += std::pow(e(low + (1.0 - low) * (k + 0.5) / n), 2);
    return std::sqrt(sum / n);
}

Table map(Table table, const std::function<double(double)> &f) {
    for (double &value : table.values)
        if (value >= 0.0) value = f(value);
    return table;
}

// A table with structure in every angle.
Rgb wavy(const Vec &wi, const Vec &wo) {
    const Vec h = oracle::half_vector(wi, wo);
    const double d = oracle::dot(wi, h);
    return {0.2 + d * d * h.z, 0.3 * d + 0.1 * wi.z * wo.z, 0.5 * h.z * h.z};
}

} // namespace

TEST(BrdfErrors, OfATableAgainstItselfAreZero) {
    const test::Brdf brdf = open("builtin:two-layer");
    const smx_brdf_errors e = compare(brdf, brdf);
    for (const double error : {e.l2, e.log, e.cube_root, e.l2_80, e.log_80, e.cube_root_80}) EXPECT_EQ(error, 0.0);
}

TEST(BrdfErrors, OfLambertiansAreInClosedForm) {
    const double r = 0.5 / oracle::pi, f = 1.1 * r, cut = std::cos(test::radians(80.0));
    const smx_brdf_errors e = compare(open("analytic:lambert,albedo=0.55"), open("analytic:lambert,albedo=0.5"));
    EXPECT_CLOSE(e.l2, (f - r) / std::sqrt(3.0), cells_tolerance, 0.0);
    EXPECT_CLOSE(e.cube_root, (std::cbrt(f) - std::cbrt(r)) * std::sqrt(0.6), cells_tolerance, 0.0);
    EXPECT_CLOSE(e.l2_80, (f - r) * std::sqrt((1.0 - cut * cut * cut) / (3.0 * (1.0 - cut))), cut_tolerance, 0.0);
    const auto log = [&](double mu) { return std::log(1.0 + f * mu) - std::log(1.0 + r * mu); };
    const auto cube_root = [&](double mu) { return std::cbrt(f * mu) - std::cbrt(r * mu); };
    EXPECT_CLOSE(e.log, rms(0.0, log), cells_tolerance, 0.0);
    EXPECT_CLOSE(e.log_80, rms(cut, log), cut_tolerance, 0.0);
    EXPECT_CLOSE(e.cube_root_80, rms(cut, cube_root), cut_tolerance, 0.0);
    // The cut is far outside its tolerance.
    EXPECT_GT(e.l2_80, e.l2 * (1.0 + 5.0 * cut_tolerance));
}

TEST(BrdfErrors, ChannelsAreAveragedBeforeTheRoot) {
    const smx_brdf_errors one =
        compare(open("analytic:lambert,albedo=0.55/0.5/0.5"), open("analytic:lambert,albedo=0.5"));
    const smx_brdf_errors all = compare(open("analytic:lambert,albedo=0.55"), open("analytic:lambert,albedo=0.5"));
    EXPECT_CLOSE(one.l2, all.l2 / std::sqrt(3.0), exact, 0.0);
    EXPECT_CLOSE(one.cube_root_80, all.cube_root_80 / std::sqrt(3.0), exact, 0.0);
}

// A table scaled by 1.1: 0.1 times the root mean square of r cos_i, here over angles of wi and wo.
TEST(BrdfErrors, OfAScaledTableAreAnIntegralOverDirections) {
    constexpr int polar = 90, azimuths = 60; // the cut is between two of the polar angles
    double sum = 0.0, sum_80 = 0.0, weight = 0.0, weight_80 = 0.0;
    for (int i = 0; i < polar; ++i)
        for (int o = 0; o < polar; ++o)
            for (int a = 0; a < azimuths; ++a) {
                const double theta_i = (i + 0.5) * oracle::pi / 2 / polar, theta_o = (o + 0.5) * oracle::pi / 2 / polar;
                const Vec wi = oracle::spherical(theta_i, (a + 0.5) * oracle::pi / azimuths);
                const Rgb r = wavy(wi, oracle::spherical(theta_o, 0.0));
                const double w = std::sin(theta_i) * std::sin(theta_o);
                const double square = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) / 3.0 * wi.z * wi.z;
                sum += w * square;
                weight += w;
                if (std::max(theta_i, theta_o) > test::radians(80.0)) continue;
                sum_80 += w * square;
                weight_80 += w;
            }
    for (const int phi_d : {180, 360}) {
        const Table table = oracle::make_table(phi_d, wavy);
        const smx_brdf_errors e =
            compare(test::make_brdf(map(table, [](double v) { return 1.1 * v; })), test::make_brdf(table));
        EXPECT_CLOSE(e.l2, 0.1 * std::sqrt(sum / weight), cells_tolerance, 0.0) << phi_d;
        EXPECT_CLOSE(e.l2_80, 0.1 * std::sqrt(sum_80 / weight_80), cut_tolerance, 0.0) << phi_d;
    }
}

TEST(BrdfErrors, HalfAndFullTurnAreTheSame) {
    const test::Brdf half = test::make_brdf(oracle::make_table(180, wavy));
    const test::Brdf full = test::make_brdf(oracle::make_table(360, wavy));
    const test::Brdf other = open("analytic:lambert,albedo=0.5");
    EXPECT_LT(compare(half, full).l2, exact);
    const smx_brdf_errors a = compare(other, half), b = compare(other, full);
    EXPECT_CLOSE(a.l2, b.l2, horizon_tolerance, 0.0);
    EXPECT_CLOSE(a.log_80, b.log_80, exact, 0.0);
}

// 1 and 3 in turn along phi_d: with the ones invalid, a hole is filled with 3, which is far off.
TEST(BrdfErrors, InvalidCellsDoNotCount) {
    Table striped = oracle::make_table(180, [](const Vec &, const Vec &) { return Rgb{1.0, 1.0, 1.0}; });
    for (std::size_t k = 1; k < striped.values.size(); k += 2) striped.values[k] *= 3.0;
    const auto scaled = [](double v) { return v == 1.0 ? -1.0 : 1.1 * v; };
    const auto with_holes = [](double v) { return v == 1.0 ? -1.0 : v; };
    const double threes = 0.1 * 3.0 / std::sqrt(3.0), both = 0.1 * std::sqrt(5.0 / 3.0);
    const test::Brdf whole = test::make_brdf(striped), holes = test::make_brdf(map(striped, with_holes));
    const test::Brdf scaled_whole = test::make_brdf(map(striped, [](double v) { return 1.1 * v; }));
    EXPECT_CLOSE(compare(scaled_whole, whole).l2, both, cells_tolerance, 0.0);
    EXPECT_CLOSE(compare(test::make_brdf(map(striped, scaled)), whole).l2, threes, cells_tolerance, 0.0);
    EXPECT_CLOSE(compare(scaled_whole, holes).l2, threes, cells_tolerance, 0.0);
}

TEST(BrdfErrors, OfASharedMaterialAgainstItsTableAreZero) {
    const std::vector<oracle::Lobe> lobes{{0.3, 0.05}, {0.5, 0.3}, {0.2, 0.9}};
    const test::Brdf table = test::make_brdf(test::beckmann_table(lobes, oracle::Masking::correlated));
    const smx_brdf_errors e = errors_of(test::make_material(lobes, test::channel_fresnel), table);
    EXPECT_LT(e.l2, zero_tolerance);
    EXPECT_LT(e.cube_root_80, zero_tolerance);
    // One masking for each lobe is another model, and is seen.
    const std::vector<test::Colour> parts{{0.3, 0.15, 0.075}, {0.5, 0.25, 0.125}, {0.2, 0.1, 0.05}};
    EXPECT_GT(errors_of(test::make_per_lobe_material(lobes, parts), table).l2, 1e-3);
}

TEST(BrdfErrors, OfAPerLobeMaterialAgainstItsTableAreZero) {
    const std::vector<oracle::Lobe> lobes{{1.0, 0.002}, {1.0, 0.4}};
    const std::vector<test::Colour> fresnel{{0.04, 0.05, 0.06}, {0.5, 0.2, 0.1}};
    const Table table = oracle::make_table(180, [&](const Vec &wi, const Vec &wo) {
        Rgb f{};
        for (std::size_t k = 0; k < 2; ++k) {
            const double lobe = oracle::brdf(oracle::Mixture{{lobes[k]}, {}}, oracle::Masking::correlated, wi, wo);
            for (std::size_t c = 0; c < 3; ++c) f[c] += fresnel[k][c] * lobe;
        }
        return f;
    });
    const smx_brdf_errors e = errors_of(test::make_per_lobe_material(lobes, fresnel), test::make_brdf(table));
    EXPECT_LT(e.l2, 1e-4); // the peak is 3e3, and its slope's square comes from a cosine near 1
    EXPECT_LT(e.log, zero_tolerance * 1e3);
}

TEST(BrdfErrors, CurvesAreTakenAtThetaD) {
    // Linear from 1 at 0 to 0 at pi/2.
    const std::vector<double> falling{1, 0, 1, 0, 1, 0};
    const test::Material material = test::make_material(SMX_MODEL_SHARED, {{1.0, 0.5}}, falling, 2);
    const Table table = oracle::make_table(180, [](const Vec &wi, const Vec &wo) {
        const double share = 1.0 - oracle::angle(wi, oracle::half_vector(wi, wo)) / (oracle::pi / 2.0);
        const double f = share * oracle::brdf(oracle::Mixture{{{1.0, 0.5}}, {}}, oracle::Masking::correlated, wi, wo);
        return Rgb{f, f, f};
    });
    EXPECT_LT(errors_of(material, test::make_brdf(table)).l2, zero_tolerance);
}
