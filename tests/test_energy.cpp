// Energy of the shading: reciprocity, and white furnaces against the single-scattering loss computed another way.
#include <gtest/gtest.h>

#include <cstdio>

#include "close.h"
#include "directions.h"
#include "random.h"
#include "slope_grid.h"
#include "support.h"

using oracle::Lobe;
using oracle::Masking;
using oracle::Mixture;
using oracle::Vec;

namespace {

// No more energy may leave than came: float32 sums of 10^5 values, quadrature error.
constexpr double energy_excess = 1e-4;
// What the facets' horizon, a kink, leaves of midpoints' error at the grids below.
constexpr double furnace_tolerance = 3e-4;
// Where a wide lobe hides nearly all, few points are left.
constexpr double furnace_floor = 5e-6;
constexpr int library_grid = 320, oracle_grid = 450;
constexpr double reciprocity_tolerance = 1e-5;
// Widened by nodes, where directions that are nearly opposite have cosines to a facet that cancel: over <wi,wh>. (In
// the grade double all pairs are reciprocal to the roundings of what is returned.)
constexpr double widened_tolerance = 2e-5;
// An integral over samples, whose facets are kept as floats.
constexpr double reference_tolerance = 1e-4;

struct Furnace {
    std::vector<Lobe> lobes;
    smx_displacement x;

    std::vector<test::Colour> colours() const { return {lobes.size(), test::channel_fresnel}; }
};

// Below it a mean plane that slants has lost its digits to the difference of floats.
double least_plane(const Furnace &f) { return f.x.mean_slope_x == 0.0 && f.x.mean_slope_y == 0.0 ? 0.0 : 0.02; }

const std::vector<Furnace> &furnaces() {
    static const std::vector<Furnace> list{
        {{{1.0, 0.1}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 1.0}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{0.4, 0.1}, {0.6, 0.7}}, {0.25, 0.25, 0.0, 0.0, 0.0}},
        {{{1.0, 0.1}}, {0.5, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 0.2}}, {0.3, 0.6, 0.7, 0.0, 0.0}},
        {{{1.0, 1e-4}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{0.3, 1e-4}, {0.7, 1e3}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 1e-4}}, {1.0, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 1e-3}}, {0.5, 0.5, 1.0 - 1e-6, 0.0, 0.0}},
        {{{1.0, 0.1}}, {0.3, 0.2, -0.5, 0.2, -0.3}},
    };
    return list;
}

// The pair of directions whose half vector is the facet of a slope, and what the facet's point on the grid weighs in an
// integral over wi: dwi = 4 <wo,wh> dwh.
struct Mirrored {
    Vec wi;
    double weight; // 0 where there is no such pair above the surface
};

Mirrored mirrored(const test::SlopePoint &point, const Vec &wo) {
    const Vec wm = oracle::normalised({-point.x, -point.y, 1.0});
    const Mirrored m{oracle::reflect(wo, wm), 4.0 * point.weight * oracle::dot(wo, wm) * wm.z * wm.z * wm.z};
    return m.weight > 0.0 && m.wi.z > 0.0 ? m : Mirrored{wo, 0.0};
}

// A grid's points per lobe and axis, and what shades.
struct Shading {
    smx_model model = SMX_MODEL_SHARED;
    int32_t order = 0;
    int grid = library_grid;
};

// Of the per-lobe model a lobe's Fresnel factor is its weight, so that they reflect no more than all.
test::Material material_of(const Furnace &furnace, smx_model model) {
    std::vector<test::Colour> colours;
    for (const Lobe &lobe : furnace.lobes) colours.push_back({lobe.weight, lobe.weight, lobe.weight});
    return model == SMX_MODEL_SHARED ? test::make_material(furnace.lobes)
                                     : test::make_per_lobe_material(furnace.lobes, colours);
}

// Share of the light that leaves towards wo when it comes evenly from all sides: integral of f cos over wi.
double library_energy(const Furnace &furnace, smx_masking g, const Vec &wo, const Shading &shading = {}) {
    const Mixture m{furnace.lobes, test::gaussian(furnace.x)};
    const std::vector<test::SlopePoint> points = test::slope_grid(m, shading.grid);
    test::Directions pairs;
    std::vector<double> weights;
    for (const test::SlopePoint &point : points) {
        const Mirrored at = mirrored(point, wo);
        pairs.add(at.wi, wo);
        weights.push_back(at.weight);
    }
    std::vector<float> fcos(3 * pairs.count());
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.effects = SMX_EFFECTS_ALL;
    options.widening_order = shading.order;
    EXPECT_SMX_OK(smx_material_eval(test::context(), material_of(furnace, shading.model), &furnace.x, g, &options,
                                    pairs.count(), pairs.wi.data(), pairs.wo.data(), fcos.data()));
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * fcos[3 * k];
    return sum;
}

// The same from the facets' side, on a grid of its own: integral over slopes of p22 <o,m>+ / (p_o m.z) times G2 of the
// pair that the facet makes.
double facet_energy(const Furnace &furnace, Masking g, const Vec &wo) {
    const Mixture m{furnace.lobes, test::gaussian(furnace.x)};
    double sum = 0.0;
    for (const test::SlopePoint &point : test::slope_grid(m, oracle_grid)) {
        const Mirrored at = mirrored(point, wo);
        if (at.weight <= 0.0) continue;
        double p22 = 0.0;
        for (const Lobe &lobe : m.lobes)
            p22 += lobe.weight * oracle::p22(oracle::widened(m.x, lobe.alpha), point.x, point.y);
        const double seen = wo.z - wo.x * point.x - wo.y * point.y;
        sum += point.weight * p22 * seen / oracle::plane(m.x, wo) * oracle::g2(g, m, at.wi, wo);
    }
    return sum;
}

// The same of the per-lobe model: every lobe masks by itself.
double facet_energy_per_lobe(const Furnace &furnace, Masking g, const Vec &wo) {
    double sum = 0.0;
    for (const Lobe &lobe : furnace.lobes) sum += lobe.weight * facet_energy({{{1.0, lobe.alpha}}, furnace.x}, g, wo);
    return sum;
}

// Lobes and surfaces from sharp to wide, straight and turned.
std::vector<Furnace> random_furnaces(int count, double least_alpha, double most_alpha) {
    test::Random random(59);
    std::vector<Furnace> list;
    for (int k = 0; k < count; ++k) {
        const double share = random.uniform(0.05, 0.95), slant = k % 2 ? 0.0 : 0.3;
        list.push_back({{{share, random.log_uniform(1e-3, 0.3)}, {1.0 - share, random.log_uniform(0.05, 3.0)}},
                        {random.log_uniform(least_alpha, most_alpha), random.log_uniform(least_alpha, most_alpha),
                         random.uniform(-0.95, 0.95), random.uniform(-slant, slant), random.uniform(-slant, slant)}});
    }
    return list;
}

// Half of the pairs near the mirror direction, down to grazing.
test::Directions random_pairs(double least_z) {
    test::Random random(13);
    test::Directions pairs;
    for (int k = 0; k < 1000; ++k) {
        const auto low = [&] {
            const double z = random.log_uniform(least_z, 1.0), phi = random.uniform(0.0, 2.0 * oracle::pi);
            return Vec{std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
        };
        const Vec i = low();
        const Vec mirror =
            oracle::normalised({random.log_uniform(1e-6, 0.1) - i.x, random.log_uniform(1e-6, 0.1) - i.y, i.z});
        pairs.add(i, k % 2 ? mirror : low());
    }
    return pairs;
}

// [count][3] as [3][count], and back.
std::vector<float> planes(const std::vector<float> &list) {
    std::vector<float> out(list.size());
    for (std::size_t k = 0; k < list.size(); ++k) out[k % 3 * (list.size() / 3) + k / 3] = list[k];
    return out;
}

std::vector<float> packed(const std::vector<float> &planes) {
    std::vector<float> out(planes.size());
    for (std::size_t k = 0; k < planes.size(); ++k) out[k] = planes[k % 3 * (planes.size() / 3) + k / 3];
    return out;
}

// shade(wi, wo) gives f cos of red, green and blue; tolerance(wi, wo) is relative.
template <typename Tolerance, typename Shade>
void expect_reciprocal(const Furnace &f, double least_z, const Tolerance &tolerance, double floor, const Shade &shade) {
    const test::Directions pairs = random_pairs(least_z);
    const std::vector<float> there = shade(pairs.wi, pairs.wo), back = shade(pairs.wo, pairs.wi);
    const oracle::Gaussian x = test::gaussian(f.x);
    int lit = 0;
    for (std::size_t k = 0; k < pairs.count(); ++k) {
        const Vec wi = test::Directions::at(pairs.wi, k), wo = test::Directions::at(pairs.wo, k);
        const double p_i = oracle::plane(x, wi), p_o = oracle::plane(x, wo);
        if (std::min(p_i, p_o) < least_plane(f)) continue;
        lit += there[3 * k] > 0.0f;
        ASSERT_TRUE(test::is_close(there[3 * k] / p_i, back[3 * k] / p_o, tolerance(wi, wo), floor))
            << "alpha " << f.lobes[0].alpha << ", X " << f.x.alpha_x << " " << f.x.alpha_y << ", wi.z " << wi.z
            << ", wo.z " << wo.z << ", there " << there[3 * k] / p_i << ", back " << back[3 * k] / p_o;
    }
    EXPECT_GT(lit, 10);
}

} // namespace

TEST(Energy, FurnaceIsTheSingleScatteringShare) {
    for (const Furnace &f : furnaces())
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE})
            for (const double theta : {0.0, 0.9, 1.4, 1.55}) {
                const Vec wo = oracle::spherical(theta, 0.4);
                if (oracle::plane(test::gaussian(f.x), wo) <= 0.0) continue;
                const double library = library_energy(f, g, wo), facets = facet_energy(f, test::masking(g), wo);
                EXPECT_LE(library, 1.0 + energy_excess);
                EXPECT_CLOSE(library, facets, furnace_tolerance, furnace_floor)
                    << "alpha " << f.lobes[0].alpha << ", X " << f.x.alpha_x << " " << f.x.alpha_y << ", theta_o "
                    << theta << ", g " << g;
            }
}

// On random surfaces, of both models. Where X is nearly a line and turned, the horizon's kink crosses the grids aslant.
TEST(Energy, RandomFurnacesAreTheSingleScatteringShare) {
    constexpr double tolerance = 3.0 * furnace_tolerance;
    for (const Furnace &f : random_furnaces(5, 1e-3, 3.0))
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE})
            for (const double theta : {0.6, 1.5}) {
                const Vec wo = oracle::spherical(theta, 2.1);
                if (oracle::plane(test::gaussian(f.x), wo) <= 0.0) continue;
                const double shared = library_energy(f, g, wo, {SMX_MODEL_SHARED});
                const double per_lobe = library_energy(f, g, wo, {SMX_MODEL_PER_LOBE});
                EXPECT_LE(std::max(shared, per_lobe), 1.0 + energy_excess);
                EXPECT_CLOSE(shared, facet_energy(f, test::masking(g), wo), tolerance, furnace_floor)
                    << "X " << f.x.alpha_x << " " << f.x.alpha_y << ", theta_o " << theta << ", g " << g;
                EXPECT_CLOSE(per_lobe, facet_energy_per_lobe(f, test::masking(g), wo), tolerance, furnace_floor)
                    << "per-lobe, X " << f.x.alpha_x << " " << f.x.alpha_y << ", theta_o " << theta << ", g " << g;
            }
}

// Orders above 0 have the energy of the integral that they converge to (order 8), to their own error; and that may
// bring them above 1, where the integral is not: by 1.6e-4 here.
TEST(Energy, WidenedFurnacesConverge) {
    constexpr double order_error[] = {0.0, 0.04, 0.015, 0.01};
    constexpr double order_excess = 3e-4;
    constexpr int grid = 80;
    double largest[4] = {}, brightest = 0.0;
    for (const Furnace &f : random_furnaces(5, 0.02, 0.6))
        for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
            for (const double theta : {0.0, 0.8, 1.4}) {
                const Vec wo = oracle::spherical(theta, 2.1);
                if (oracle::plane(test::gaussian(f.x), wo) <= 0.0) continue;
                const double wanted = library_energy(f, SMX_G2_CORRELATED, wo, {model, 8, grid});
                EXPECT_LE(wanted, 1.0 + energy_excess);
                for (const int order : {1, 2, 3}) {
                    const double got = library_energy(f, SMX_G2_CORRELATED, wo, {model, order, grid});
                    largest[order] = std::max(largest[order], std::abs(got / wanted - 1.0));
                    brightest = std::max(brightest, got);
                    EXPECT_CLOSE(got, wanted, order_error[order], 0.0)
                        << "order " << order << ", X " << f.x.alpha_x << " " << f.x.alpha_y << ", theta_o " << theta;
                }
            }
    std::printf("orders 1, 2, 3: energy off by at most %.2g, %.2g, %.2g; at most %.6f\n", largest[1], largest[2],
                largest[3], brightest);
    EXPECT_LE(brightest, 1.0 + order_excess);
}

// A smooth enough surface seen from above hides nothing: all the energy comes back.
TEST(Energy, GentleSurfaceLosesNothing) {
    const Furnace gentle{{{1.0, 0.1}}, {0.05, 0.05, 0.0, 0.0, 0.0}};
    EXPECT_CLOSE(library_energy(gentle, SMX_G2_CORRELATED, {0.0, 0.0, 1.0}), 1.0, energy_excess, 0.0);
}

// The furnace can fail: a masking of the other kind is outside its tolerance.
TEST(Energy, FurnaceSeesWrongMasking) {
    const Furnace rough = furnaces()[1];
    const Vec wo = oracle::spherical(1.4, 0.4);
    const double library = library_energy(rough, SMX_G2_CORRELATED, wo);
    EXPECT_FALSE(test::is_close(library, facet_energy(rough, Masking::separable, wo), furnace_tolerance, 0.0));
    EXPECT_LT(library, 0.99);
}

// f(wi, wo) = f(wo, wi): f cos over the mean plane's projected area towards wi, there and back.
TEST(Energy, ShadingIsReciprocal) {
    for (const Furnace &f : furnaces())
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE})
            for (const int order : {0, 1, 3}) {
                smx_render_options options = SMX_RENDER_OPTIONS_INIT;
                options.effects = SMX_EFFECTS_ALL;
                options.widening_order = order;
                const test::Material materials[] = {test::make_material(f.lobes),
                                                    test::make_per_lobe_material(f.lobes, f.colours())};
                const double least_z = order > 0 ? 1e-3 : 1e-6;
                const auto tolerance = [order](const Vec &wi, const Vec &wo) {
                    return order > 0 ? widened_tolerance / (0.5 * oracle::length(wi + wo)) : reciprocity_tolerance;
                };
                for (const test::Material &material : materials) {
                    const auto shade = [&](const std::vector<float> &wi, const std::vector<float> &wo) {
                        std::vector<float> fcos(wi.size());
                        EXPECT_SMX_OK(smx_material_eval(test::context(), material, &f.x, g, &options, wi.size() / 3,
                                                        wi.data(), wo.data(), fcos.data()));
                        return fcos;
                    };
                    expect_reciprocal(f, least_z, tolerance, 1e-30, shade);
                }
            }
}

// The reference too, sample by sample: exchanged directions see the same facets.
TEST(Energy, ReferenceIsReciprocal) {
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:two-layer", brdf.out()));
    for (const Furnace &f : {furnaces()[2], furnaces()[3], furnaces()[4], furnaces().back()})
        for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
            smx_render_options options = test::make_options(256, 5);
            options.sampler = sampler;
            const auto shade = [&](const std::vector<float> &wi, const std::vector<float> &wo) {
                std::vector<float> fcos(wi.size());
                EXPECT_SMX_OK(smx_brdf_integrate(test::context(), brdf, &f.x, SMX_G2_CORRELATED, &options,
                                                 wi.size() / 3, planes(wi).data(), planes(wo).data(), fcos.data(),
                                                 nullptr, nullptr));
                return packed(fcos);
            };
            expect_reciprocal(
                f, 0.01, [](const Vec &, const Vec &) { return reference_tolerance; }, 1e-12, shade);
        }
}
