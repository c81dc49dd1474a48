// Energy of the shading: reciprocity, and white furnaces against the single-scattering loss computed another way.
#include <gtest/gtest.h>

#include "close.h"
#include "random.h"
#include "support.h"

using oracle::Lobe;
using oracle::Masking;
using oracle::Mixture;
using oracle::Vec;

namespace {

// No more energy may leave than came: float32 sums of 10^5 values, quadrature error.
constexpr double energy_excess = 1e-4;
// The hemisphere's grid (600 x 1200) against the plane's grid, for lobes of 0.1 and wider.
constexpr double furnace_tolerance = 1e-3;
constexpr double reciprocity_tolerance = 3e-5;

struct Furnace {
    std::vector<Lobe> lobes;
    smx_displacement x;
};

const std::vector<Furnace> &furnaces() {
    static const std::vector<Furnace> list{
        {{{1.0, 0.1}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 1.0}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{0.4, 0.1}, {0.6, 0.7}}, {0.25, 0.25, 0.0, 0.0, 0.0}},
        {{{1.0, 0.1}}, {0.5, 0.0, 0.0, 0.0, 0.0}},
        {{{1.0, 0.2}}, {0.3, 0.6, 0.7, 0.0, 0.0}},
    };
    return list;
}

constexpr std::size_t rings = 600, spokes = 1200;

// Directions at the midpoints of a grid over the hemisphere, [rings][spokes][3].
const std::vector<float> &hemisphere() {
    static const std::vector<float> grid = [] {
        std::vector<float> list;
        for (std::size_t j = 0; j < rings; ++j)
            for (std::size_t k = 0; k < spokes; ++k) {
                const Vec d = oracle::spherical((static_cast<double>(j) + 0.5) * oracle::pi / 2.0 / rings,
                                                (static_cast<double>(k) + 0.5) * 2.0 * oracle::pi / spokes);
                list.insert(list.end(), {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
            }
        return list;
    }();
    return grid;
}

// Share of the light that leaves towards wo when it comes evenly from all sides: integral of f cos over wi.
double library_energy(const Furnace &furnace, smx_masking g, const Vec &wo) {
    constexpr std::size_t count = rings * spokes;
    std::vector<float> wos, fcos(3 * count);
    for (std::size_t k = 0; k < count; ++k)
        for (const double v : {wo.x, wo.y, wo.z}) wos.push_back(static_cast<float>(v));
    EXPECT_SMX_OK(smx_material_eval(test::context(), test::make_material(furnace.lobes), &furnace.x, g, nullptr, count,
                                    hemisphere().data(), wos.data(), fcos.data()));
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const double sine = std::hypot(hemisphere()[3 * k], hemisphere()[3 * k + 1]);
        sum += static_cast<double>(fcos[3 * k]) * sine;
    }
    return sum * (oracle::pi / 2.0 / rings) * (2.0 * oracle::pi / spokes);
}

// The same from the facets' side: integral over slopes of p22 <o,m>+ / (co m.z) times G2 of the
// pair that the facet makes, with i the mirror image of o.
double facet_energy(const Furnace &furnace, Masking g, const Vec &wo) {
    const Mixture m{furnace.lobes, test::gaussian(furnace.x)};
    double sum = 0.0;
    for (const Lobe &lobe : m.lobes) {
        const oracle::Gaussian z = oracle::widened(m.x, lobe.alpha);
        constexpr int n = 350;
        const double rx = 7.0 * std::sqrt(z.cov_xx), ry = 7.0 * std::sqrt(z.cov_yy);
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k) {
                const double sx = rx * ((j + 0.5) * 2.0 / n - 1.0), sy = ry * ((k + 0.5) * 2.0 / n - 1.0);
                const double scale = std::sqrt(1.0 + sx * sx + sy * sy);
                const Vec wm = (1.0 / scale) * Vec{-sx, -sy, 1.0};
                const Vec wi = oracle::reflect(wo, wm);
                const double seen = oracle::dot(wo, wm);
                if (seen <= 0.0 || wi.z <= 0.0) continue;
                sum += lobe.weight * oracle::p22(z, sx, sy) * seen * scale / wo.z * oracle::g2(g, m, wi, wo) * 4.0 *
                       rx * ry / n / n;
            }
    }
    return sum;
}

} // namespace

TEST(Energy, FurnaceIsTheSingleScatteringShare) {
    for (const Furnace &f : furnaces())
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE})
            for (const double theta : {0.0, 0.9, 1.4}) {
                const Vec wo = oracle::spherical(theta, 0.4);
                const double library = library_energy(f, g, wo), facets = facet_energy(f, test::masking(g), wo);
                EXPECT_LE(library, 1.0 + energy_excess);
                EXPECT_CLOSE(library, facets, furnace_tolerance, 0.0)
                    << "alpha " << f.lobes[0].alpha << ", X " << f.x.alpha_x << " " << f.x.alpha_y << ", theta_o "
                    << theta << ", g " << g;
            }
}

// A smooth enough surface seen from above hides nothing: all the energy comes back.
TEST(Energy, GentleSurfaceLosesNothing) {
    const Furnace gentle{{{1.0, 0.1}}, {0.05, 0.05, 0.0, 0.0, 0.0}};
    EXPECT_CLOSE(library_energy(gentle, SMX_G2_CORRELATED, {0.0, 0.0, 1.0}), 1.0, energy_excess, 0.0);
}

// The furnace walks the whole azimuth and can fail: a masking of the other kind is outside its tolerance.
TEST(Energy, FurnaceSeesWrongMasking) {
    const Furnace rough = furnaces()[1];
    const Vec wo = oracle::spherical(1.4, 0.4);
    const double library = library_energy(rough, SMX_G2_CORRELATED, wo);
    EXPECT_FALSE(test::is_close(library, facet_energy(rough, Masking::separable, wo), furnace_tolerance, 0.0));
    EXPECT_LT(library, 0.99);
}

TEST(Energy, ShadingIsReciprocal) {
    test::Random random(13);
    for (const Furnace &f : furnaces())
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
            const test::Material material = test::make_material(f.lobes);
            constexpr std::size_t count = 500;
            std::vector<float> wi, wo, there(3 * count), back(3 * count);
            for (std::size_t k = 0; k < count; ++k)
                for (std::vector<float> *list : {&wi, &wo}) {
                    const Vec d = random.direction(1e-3);
                    list->insert(list->end(),
                                 {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
                }
            ASSERT_SMX_OK(smx_material_eval(test::context(), material, &f.x, g, nullptr, count, wi.data(), wo.data(),
                                            there.data()));
            ASSERT_SMX_OK(smx_material_eval(test::context(), material, &f.x, g, nullptr, count, wo.data(), wi.data(),
                                            back.data()));
            for (std::size_t k = 0; k < count; ++k)
                ASSERT_TRUE(test::is_close(static_cast<double>(there[3 * k]) / wi[3 * k + 2],
                                           static_cast<double>(back[3 * k]) / wo[3 * k + 2], reciprocity_tolerance,
                                           1e-35))
                    << "wi.z " << wi[3 * k + 2] << ", wo.z " << wo[3 * k + 2] << ", there " << there[3 * k] << ", back "
                    << back[3 * k];
        }
}
