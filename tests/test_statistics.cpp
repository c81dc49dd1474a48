// Estimates are unbiased, whatever the sampler, the light and the number of samples: over many seeds, the mean of a
// pixel is the integral. And seeds are independent.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cstdio>
#include <functional>
#include <string>

#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Masking;
using oracle::Table;

namespace {

constexpr uint32_t resolution = 7, pixels = resolution * resolution;
constexpr int seeds = 100;
// Bonferroni: a false alarm in one of a thousand runs of all the tests here.
constexpr double significance = 1e-3;
constexpr int number_of_tests = 600; // pixels and means that are tested, at least as many as there are
// Darker pixels have rare bright samples: a mean of 100 images is not normally distributed there.
constexpr double dark_share = 0.1;
// Wide enough that a handful of samples sees it.
constexpr double base_alpha = 0.4;

// Of a truth, relative, beside what its own integral says: angles in float32, of a table's cells that differ by a few
// hundredths.
constexpr double arithmetic = 1e-5;
// A truth worse than this would hide a bias.
constexpr double least_truth = 2e-4;

// Student's t of a mean of so many seeds.
double t_limit() {
    const boost::math::students_t distribution(seeds - 1);
    return boost::math::quantile(boost::math::complement(distribution, significance / number_of_tests / 2.0));
}

struct Moments {
    double sum = 0.0, squares = 0.0;

    void add(double v) {
        sum += v;
        squares += v * v;
    }
    double mean() const { return sum / seeds; }
    double deviation() const { return std::sqrt(std::max(0.0, squares / seeds - mean() * mean()) / (seeds - 1)); }
};

struct Truth {
    double value = 0.0, error = 0.0; // the error is relative

    // The part of the difference that the truth's error does not explain, in deviations of the mean.
    double t_of(const Moments &m) const {
        const double unexplained = std::max(0.0, std::abs(m.mean() - value) - error * value);
        return unexplained == 0.0 ? 0.0 : unexplained / m.deviation();
    }
};

void expect_mean(const Moments &got, const Truth &wanted, const std::string &what) {
    ASSERT_LE(wanted.error, least_truth) << what;
    EXPECT_LT(wanted.t_of(got), t_limit()) << what << ": mean " << got.mean() << " +- " << got.deviation()
                                           << ", wanted " << wanted.value << ", to a share " << wanted.error;
}

// A material on a surface, and what every pixel of its image is.
class Case {
  public:
    Case(const smx_displacement &x, double light_deg, double alpha = base_alpha)
        : brdf(test::make_brdf(test::beckmann_table({{1.0, alpha}}, Masking::correlated))),
          scene(test::make_scene(resolution, resolution, test::radians(light_deg), x)) {}

    const std::vector<Truth> &truth() const {
        if (truth_.empty()) truth_ = find_truth();
        return truth_;
    }

    double brightest() const {
        return std::max_element(truth().begin(), truth().end(),
                                [](const Truth &a, const Truth &b) { return a.value < b.value; })
            ->value;
    }

    test::Brdf brdf;
    smx_scene scene;

  private:
    std::vector<Truth> find_truth() const {
        const Table table = test::filled_table(brdf);
        const oracle::FacetBrdf f = oracle::table_brdf(table, oracle::Lookup::linear);
        const oracle::Gaussian x = test::gaussian(scene.displacement);
        std::vector<Truth> truth(pixels);
        for (uint32_t k = 0; k < pixels; ++k) {
            const oracle::Pixel p =
                oracle::sphere_pixel(resolution, resolution, k % resolution, k / resolution, scene.light_phi);
            if (!p.on_sphere) continue;
            const oracle::Integral all = oracle::reference(f, Masking::correlated, x, p.wi, p.wo);
            truth[k] = {all.rgb[0], all.error + arithmetic};
        }
        return truth;
    }
    mutable std::vector<Truth> truth_;
};

// Red of every pixel over the seeds; render(seed) gives an image.
template <typename Render>
std::vector<Moments> over_seeds(const Render &render) {
    std::vector<Moments> all(pixels);
    for (uint64_t seed = 0; seed < seeds; ++seed) {
        const test::Image one = render(1000 + seed);
        for (std::size_t k = 0; k < pixels; ++k) all[k].add(test::pixels(one).rgba[4 * k]);
    }
    return all;
}

std::vector<Moments> images_over_seeds(const Case &c, uint32_t spp, smx_sampler sampler = SMX_SAMPLER_GRID) {
    return over_seeds([&](uint64_t seed) {
        smx_render_options options = test::make_options(spp, seed);
        options.sampler = sampler;
        return test::render_reference(c.brdf, c.scene, options);
    });
}

std::vector<Moments> expect_unbiased(const Case &c, uint32_t spp, smx_sampler sampler = SMX_SAMPLER_GRID) {
    const std::vector<Moments> image = images_over_seeds(c, spp, sampler);
    const smx_displacement &x = c.scene.displacement;
    int tested = 0;
    double largest = 0.0, precision = HUGE_VAL;
    for (std::size_t k = 0; k < image.size(); ++k) {
        if (c.truth()[k].value <= dark_share * c.brightest()) continue;
        expect_mean(image[k], c.truth()[k],
                    "pixel " + std::to_string(k) + ", X " + std::to_string(x.alpha_x) + " " +
                        std::to_string(x.alpha_y) + ", sampler " + std::to_string(sampler) + ", spp " +
                        std::to_string(spp));
        largest = std::max(largest, c.truth()[k].t_of(image[k]));
        precision = std::min(precision, image[k].deviation() / c.truth()[k].value);
        ++tested;
    }
    EXPECT_GT(tested, 3);
    std::printf("X %g %g rho %g, sampler %d, spp %u: %d pixels, known to %.1g at best, t at most %.2f of %.2f\n",
                x.alpha_x, x.alpha_y, x.rho, sampler, spp, tested, precision, largest, t_limit());
    return image;
}

} // namespace

TEST(Statistics, SamplesAreUnbiasedOnThePlane) {
    const Case isotropic({0.3, 0.3, 0.0, 0.0, 0.0}, 60.0);
    for (const uint32_t spp : {9u, 4096u}) expect_unbiased(isotropic, spp);
    const Case slanted({0.3, 0.2, 0.5, 0.1, 0.0}, 60.0);
    expect_unbiased(slanted, 16);
    const std::vector<Moments> image = expect_unbiased(slanted, 1024);
    // An image that were a thousandth too bright would be refused.
    double largest = 0.0;
    for (std::size_t k = 0; k < image.size(); ++k)
        if (slanted.truth()[k].value > dark_share * slanted.brightest())
            largest = std::max(largest, Truth{1.001 * slanted.truth()[k].value, 1e-4}.t_of(image[k]));
    EXPECT_GT(largest, t_limit());
    // With and without the rest of a scramble's points.
    for (const uint32_t spp : {2u, 14u, 16u, 4096u})
        for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) expect_unbiased(slanted, spp, sampler);
}

TEST(Statistics, SamplesAreUnbiasedOnALine) {
    const Case along_x({0.3, 0.0, 0.0, 0.0, 0.0}, 60.0);
    expect_unbiased(along_x, 4);
    expect_unbiased(along_x, 16, SMX_SAMPLER_SOBOL);
    for (const uint32_t spp : {4u, 1024u}) expect_unbiased(along_x, spp, SMX_SAMPLER_MIS);
    const Case along_y({0.0, 0.3, 0.0, 0.0, 0.1}, 60.0);
    for (const uint32_t spp : {1u, 64u}) expect_unbiased(along_y, spp);
}

// Nearly smooth, nearly a line, nearly smooth along a line, and a base that X's own facets would hardly find.
TEST(Statistics, SamplesAreUnbiasedOnHardSurfaces) {
    for (const smx_displacement &x : {smx_displacement{1e-3, 1e-3, 0.0, 0.0, 0.0},
                                      {0.3, 0.3, 0.999, 0.0, 0.0},
                                      {1e-3, 0.0, 0.0, 0.2, 0.0},
                                      {0.0, 1e-3, 0.0, 0.0, 0.0}}) {
        const Case hard(x, 60.0);
        expect_unbiased(hard, 16);
        for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) expect_unbiased(hard, 1024, sampler);
    }
    const Case sharp({0.3, 0.3, 0.0, 0.0, 0.0}, 60.0, 0.03);
    for (const uint32_t spp : {64u, 4096u}) expect_unbiased(sharp, spp, SMX_SAMPLER_MIS);
}

// Stratification pays: the deviation falls faster than with independent samples, whose deviation would halve.
TEST(Statistics, StrataReduceTheDeviation) {
    const Case c({0.3, 0.3, 0.0, 0.0, 0.0}, 90.0);
    const std::size_t centre = resolution * resolution / 2;
    const double coarse = images_over_seeds(c, 64)[centre].deviation();
    const double fine = images_over_seeds(c, 256)[centre].deviation();
    EXPECT_GT(fine, 0.0);
    EXPECT_LT(fine, coarse / 2.4);
}

namespace {

// All light of radiance 1.
smx_scene furnace(const smx_displacement &x) {
    smx_scene scene = test::make_scene(resolution, resolution, 0.0, x);
    scene.light = SMX_LIGHT_UNIFORM;
    return scene;
}

// In the middle, towards the silhouette, and between.
constexpr uint32_t places[] = {24, 22, 9, 31};

oracle::Vec viewer(uint32_t place) {
    return oracle::sphere_pixel(resolution, resolution, place % resolution, place / resolution, 0.0).wo;
}

// Integral over the directions above, by midpoints, and by twice as many for its error.
Truth over_light(const std::function<double(const oracle::Vec &)> &value) {
    const auto by = [&](int polar) {
        double sum = 0.0;
        const double step = oracle::pi / 2.0 / polar;
        for (int j = 0; j < polar; ++j)
            for (int k = 0; k < 4 * polar; ++k) {
                const double theta = (j + 0.5) * step;
                sum += value(oracle::spherical(theta, (k + 0.5) * step)) * std::sin(theta) * step * step;
            }
        return sum;
    };
    const double coarse = by(50), fine = by(100);
    return {fine, std::abs(coarse / fine - 1.0) + 2e-6}; // and a few roundings of floats
}

} // namespace

TEST(Statistics, UniformLightOnLobesIsUnbiased) {
    const std::vector<oracle::Lobe> lobes = {{0.4, 0.3}, {0.6, 0.7}};
    const test::Material material = test::make_material(lobes);
    for (const smx_displacement &x : {smx_displacement{0.3, 0.2, 0.5, 0.1, 0.0}, {0.5, 0.0, 0.0, 0.0, 0.0}}) {
        const oracle::Mixture mixture{lobes, test::gaussian(x)};
        const smx_scene scene = furnace(x);
        for (const uint32_t spp : {16u, 256u}) {
            const std::vector<Moments> image = over_seeds([&](uint64_t seed) {
                smx_render_options options = SMX_RENDER_OPTIONS_INIT;
                options.effects = SMX_EFFECTS_ALL;
                options.spp = spp;
                options.seed = seed;
                test::Image one;
                EXPECT_SMX_OK(smx_render_filtered(test::context(), material, &scene, &options, one.out(), nullptr));
                return one;
            });
            for (const uint32_t place : places) {
                const Truth truth = over_light([&](const oracle::Vec &wi) {
                    return oracle::fcos(mixture, Masking::correlated, wi, viewer(place));
                });
                expect_mean(image[place], truth, "pixel " + std::to_string(place) + ", spp " + std::to_string(spp));
            }
        }
    }
}

// White facets that nothing hides: of the light above the surface a facet's share is (1 + wm.z) / 2, and the viewer's
// mean over facets is by their projected areas.
TEST(Statistics, UniformLightOnATableIsUnbiased) {
    test::Brdf white;
    ASSERT_SMX_OK(smx_brdf_open("analytic:lambert,albedo=1", white.out()));
    const smx_displacement x{0.5, 0.3, 0.0, 0.0, 0.0};
    const smx_scene scene = furnace(x);
    for (const uint32_t spp : {16u, 256u}) {
        const std::vector<Moments> image = over_seeds([&](uint64_t seed) {
            smx_render_options options = SMX_RENDER_OPTIONS_INIT;
            options.effects = SMX_EFFECT_ANISOTROPY;
            options.spp = spp;
            options.seed = seed;
            return test::render_reference(white, scene, options);
        });
        for (const uint32_t place : places) {
            const oracle::Vec wo = viewer(place);
            const auto wanted = [&](int nodes) {
                double sum = 0.0;
                const double step = 10.0 / nodes;
                for (int j = 0; j < nodes; ++j)
                    for (int k = 0; k < nodes; ++k) {
                        const double a = (j + 0.5) * step - 5.0, b = (k + 0.5) * step - 5.0;
                        const double sx = a * x.alpha_x, sy = b * x.alpha_y;
                        const double seen = std::max(0.0, 1.0 - (wo.x * sx + wo.y * sy) / wo.z);
                        const double mz = 1.0 / std::sqrt(1.0 + sx * sx + sy * sy);
                        sum += std::exp(-a * a - b * b) / oracle::pi * step * step * seen * (1.0 + mz) / 2.0;
                    }
                return sum;
            };
            const double coarse = wanted(400), fine = wanted(800);
            expect_mean(image[place], {fine, std::abs(coarse / fine - 1.0) + arithmetic},
                        "pixel " + std::to_string(place) + ", spp " + std::to_string(spp));
        }
    }
}

// Rays that go on from facet to facet in a white furnace bring all light home, however few they are.
TEST(Statistics, GeometricPathsAreUnbiased) {
    test::Brdf white;
    ASSERT_SMX_OK(smx_brdf_open("analytic:lambert,albedo=1", white.out()));
    const smx_scene scene = furnace({0.5, 0.3, 0.0, 0.0, 0.0});
    const std::vector<Moments> image = over_seeds([&](uint64_t seed) {
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.spp = 64;
        options.seed = seed;
        smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;
        geometric.realisations = 1;
        geometric.tile = 64;
        geometric.bounces = 64;
        test::Image one;
        EXPECT_SMX_OK(smx_render_geometric(test::context(), white, &scene, &options, &geometric, one.out(), nullptr));
        return one;
    });
    for (const uint32_t place : places) expect_mean(image[place], {1.0, arithmetic}, "pixel " + std::to_string(place));
}
