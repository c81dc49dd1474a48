// Materials and densities as tables: the oracle's formulas at the nodes, and what an inversion gives back.
#include <gtest/gtest.h>

#include <cstring>

#include "close.h"
#include "support.h"

using oracle::Rgb;
using oracle::Table;
using oracle::Vec;

namespace {

// Of closed forms in double, from cosines on one side and from directions on the other.
constexpr double formula_tolerance = 1e-9;
// Of the density's projected area, which is integrated numerically and interpolated, and of its nodes' quadrature.
constexpr double area_tolerance = 1e-3;
// The same for a distribution that goes on past the last node: what is missing there is a part of the area at grazing
// directions.
constexpr double tail_tolerance = 0.02;
// Of an inversion of a table made with the same formula: numerical areas on both sides.
constexpr double inversion_tolerance = 1e-4;
// Grazing cosines below which a node may be on either side of the horizon.
constexpr double horizon = 1e-9;

test::Brdf tabulated(smx_material material) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_material_tabulate(material, brdf.out()));
    return brdf;
}

test::Brdf tabulated(smx_density density) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_density_tabulate(density, brdf.out()));
    return brdf;
}

using Formula = std::function<Rgb(const Vec &wi, const Vec &wo)>;

// Every node of theta_h and theta_d above the horizon, and every seventh of phi_d, from all of them in turn.
void expect_nodes(smx_brdf brdf, const Formula &formula, double tolerance) {
    const Table table = test::filled_table(brdf);
    ASSERT_EQ(table.phi_d, 180);
    for (int th = 0; th < oracle::table_theta_h; ++th)
        for (int td = 0; td < oracle::table_theta_d; ++td)
            for (int pd = (th + td) % 7; pd < 180; pd += 7) {
                const oracle::Pair pair = oracle::node_directions(th, td, pd);
                if (std::min(pair.wi.z, pair.wo.z) < horizon) continue;
                const Rgb wanted = formula(pair.wi, pair.wo);
                for (int c = 0; c < 3; ++c)
                    ASSERT_PRED_FORMAT4(test::close_to, table.at(c, th, td, pd), wanted[static_cast<std::size_t>(c)],
                                        tolerance, 1e-12)
                        << "channel " << c << ", node " << th << ' ' << td << ' ' << pd;
            }
}

Rgb scaled(const test::Colour &colour, double f) { return {colour[0] * f, colour[1] * f, colour[2] * f}; }

double lobe(const std::vector<oracle::Lobe> &lobes, const Vec &wi, const Vec &wo) {
    return oracle::brdf(oracle::Mixture{lobes, {}}, oracle::Masking::correlated, wi, wo);
}

// A density from samples of a distribution of normals.
test::Density density_of(const std::function<double(double cos_h)> &ndf) {
    constexpr int samples = 20001;
    std::vector<double> theta, values;
    for (int k = 0; k < samples; ++k) {
        const double u = static_cast<double>(k) / samples; // dense towards 0, as the nodes are
        theta.push_back(u * u * oracle::pi / 2.0);
        values.push_back(ndf(std::cos(theta.back())));
    }
    test::Density density;
    EXPECT_SMX_OK(
        smx_density_from_samples("made", SMX_DENSITY_NDF, theta.size(), theta.data(), values.data(), density.out()));
    return density;
}

} // namespace

TEST(Tabulate, SharedMaterialIsTheOracles) {
    const std::vector<oracle::Lobe> lobes{{0.3, 0.05}, {0.5, 0.3}, {0.2, 0.9}};
    expect_nodes(
        tabulated(test::make_material(lobes, test::channel_fresnel)),
        [&](const Vec &wi, const Vec &wo) { return scaled(test::channel_fresnel, lobe(lobes, wi, wo)); },
        formula_tolerance);
}

TEST(Tabulate, PerLobeMaterialIsTheOracles) {
    const std::vector<oracle::Lobe> lobes{{1.0, 0.1}, {1.0, 0.6}};
    const std::vector<test::Colour> fresnel{{0.04, 0.05, 0.06}, {0.5, 0.2, 0.1}};
    const auto f = [&](const Vec &wi, const Vec &wo) {
        const Rgb gloss = scaled(fresnel[0], lobe({lobes[0]}, wi, wo)),
                  body = scaled(fresnel[1], lobe({lobes[1]}, wi, wo));
        return Rgb{gloss[0] + body[0], gloss[1] + body[1], gloss[2] + body[2]};
    };
    expect_nodes(tabulated(test::make_per_lobe_material(lobes, fresnel)), f, formula_tolerance);
}

TEST(Tabulate, CurvesAreTakenAtThetaD) {
    const std::vector<double> falling{1, 0, 1, 0, 0.5, 0}; // linear from theta_d = 0 to pi/2
    const auto f = [](const Vec &wi, const Vec &wo) {
        const double share = 1.0 - oracle::angle(wi, oracle::half_vector(wi, wo)) / (oracle::pi / 2.0);
        return scaled({1.0, 1.0, 0.5}, share * lobe({{1.0, 0.5}}, wi, wo));
    };
    // The oracle's theta_d comes from directions: good to 1e-8 near 0.
    expect_nodes(tabulated(test::make_material(SMX_MODEL_SHARED, {{1.0, 0.5}}, falling, 2)), f, 1e-7);
}

TEST(Tabulate, DensityIsItsOwnDistribution) {
    for (const double alpha : {0.1, 0.5}) {
        const auto beckmann = [&](double c) {
            return std::exp(-(1.0 / (c * c) - 1.0) / (alpha * alpha)) / std::pow(c, 4);
        };
        expect_nodes(
            tabulated(density_of(beckmann)),
            [&](const Vec &wi, const Vec &wo) {
                return scaled({1, 1, 1}, lobe({{1.0, alpha}}, wi, wo));
            },
            area_tolerance);
    }
}

// No mixture of a few lobes has GGX's tail.
TEST(Tabulate, DensityNeedsNoLobes) {
    constexpr double alpha = 0.3;
    const auto ndf = [](double c) {
        return alpha * alpha / oracle::pi / std::pow(c * c * (alpha * alpha - 1.0) + 1.0, 2);
    };
    const auto sigma = [](const Vec &k) {
        return (k.z + std::sqrt(k.z * k.z + alpha * alpha * (1.0 - k.z * k.z))) / 2.0;
    };
    const auto f = [&](const Vec &wi, const Vec &wo) {
        const double d = ndf(oracle::half_vector(wi, wo).z);
        return scaled({1, 1, 1}, d / (4.0 * (sigma(wi) * wo.z + sigma(wo) * wi.z - wi.z * wo.z)));
    };
    expect_nodes(tabulated(density_of(ndf)), f, tail_tolerance);
}

TEST(Tabulate, InversionOfTheConductorGivesTheTableBack) {
    test::Brdf conductor;
    ASSERT_SMX_OK(smx_brdf_open("builtin:conductor", conductor.out()));
    const test::Brdf back = tabulated(test::make_density(conductor, SMX_MASKING_CORRELATED));
    const Table wanted = test::filled_table(conductor);
    expect_nodes(
        back,
        [&](const Vec &wi, const Vec &wo) {
            return oracle::lookup(wanted, oracle::Lookup::linear, oracle::half_diff(wi, wo, {0.0, 0.0, 1.0}));
        },
        inversion_tolerance);
}

TEST(Tabulate, TablesAreLikeAnyOther) {
    const test::Material material = test::make_material({{1.0, 0.2}});
    test::Brdf brdf = tabulated(material);
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    ASSERT_SMX_OK(smx_brdf_get_info(brdf, &info));
    EXPECT_STREQ(info.name, "test");
    EXPECT_STREQ(info.source, "memory");
    EXPECT_EQ(std::strlen(info.sha256), 64u);
    EXPECT_EQ(info.phi_d, 180u);
    EXPECT_EQ(info.filled_cells, 0u);
    EXPECT_GT(info.invalid_cells, info.cells / 10); // below the horizon
    // The same material is the same table; the exchanged pair is the same value.
    smx_brdf_info again = SMX_BRDF_INFO_INIT;
    ASSERT_SMX_OK(smx_brdf_get_info(tabulated(material), &again));
    EXPECT_STREQ(info.sha256, again.sha256);
    const Table table = test::filled_table(brdf);
    for (int pd = 1; pd < 90; ++pd) EXPECT_EQ(table.at(0, 40, 30, pd), table.at(0, 40, 30, 180 - pd));
    // And it inverts to the lobe that it is made of.
    const std::vector<smx_lobe> back = test::lobes_of(test::fit(test::make_density(brdf, SMX_MASKING_CORRELATED), 1));
    EXPECT_CLOSE(back[0].alpha, 0.2, 0.01, 0.0);
}
