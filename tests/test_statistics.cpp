// The reference is an unbiased estimate, whatever the sampler: over many seeds, the mean of a pixel is the integral,
// and seeds are independent.
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>

#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "support.h"

using oracle::Masking;
using oracle::Table;

namespace {

constexpr uint32_t resolution = 7;
constexpr int seeds = 100;
// Bonferroni: a false alarm in one of a thousand runs of all the tests here. The oracle's and float32's own error is
// added to the deviation of the mean.
constexpr double significance = 1e-3;
constexpr int number_of_tests = 400; // at least as many as there are
constexpr double systematic = 5e-4;
// Darker pixels have rare bright samples: a mean of 100 images is not normally distributed there.
constexpr double dark_share = 0.1;
// Wide enough that a handful of samples sees it.
constexpr double base_alpha = 0.4;

// Student's t of a mean of so many seeds.
double z_limit() {
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

std::vector<Moments> images_over_seeds(smx_brdf brdf, const smx_scene &scene, uint32_t spp,
                                       smx_sampler sampler = SMX_SAMPLER_GRID) {
    std::vector<Moments> pixels(resolution * resolution);
    for (uint64_t seed = 0; seed < seeds; ++seed) {
        smx_render_options options = test::make_options(spp, 1000 + seed);
        options.sampler = sampler;
        const test::Image image = test::render_reference(brdf, scene, options);
        for (std::size_t k = 0; k < pixels.size(); ++k) pixels[k].add(test::pixels(image).rgba[4 * k]);
    }
    return pixels;
}

void expect_unbiased(const smx_displacement &x, double light_deg, uint32_t spp, smx_sampler sampler = SMX_SAMPLER_GRID,
                     double alpha = base_alpha) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, alpha}}, Masking::correlated));
    const Table table = test::filled_table(brdf);
    const oracle::FacetBrdf f = oracle::table_brdf(table, oracle::Lookup::linear);
    const smx_scene scene = test::make_scene(resolution, resolution, test::radians(light_deg), x);
    const std::vector<Moments> pixels = images_over_seeds(brdf, scene, spp, sampler);
    double brightest = 0.0;
    for (const Moments &m : pixels) brightest = std::max(brightest, m.mean());
    int tested = 0;
    for (uint32_t k = 0; k < pixels.size(); ++k) {
        const oracle::Pixel p =
            oracle::sphere_pixel(resolution, resolution, k % resolution, k / resolution, scene.light_phi);
        if (!p.on_sphere) continue;
        const double wanted = oracle::reference(f, Masking::correlated, test::gaussian(x), p.wi, p.wo).rgb[0];
        if (wanted < dark_share * brightest) continue;
        const double z = (pixels[k].mean() - wanted) / (pixels[k].deviation() + systematic * wanted + 1e-12);
        EXPECT_LT(std::abs(z), z_limit())
            << "pixel " << k << ", X " << x.alpha_x << " " << x.alpha_y << ", spp " << spp << ": mean "
            << pixels[k].mean() << " +- " << pixels[k].deviation() << ", wanted " << wanted;
        ++tested;
    }
    EXPECT_GT(tested, alpha < 0.1 ? 3 : 10);
}

} // namespace

TEST(Statistics, FewSamplesAreUnbiasedOnThePlane) {
    expect_unbiased({0.3, 0.3, 0.0, 0.0, 0.0}, 60.0, 9);
    expect_unbiased({0.3, 0.2, 0.5, 0.1, 0.0}, 60.0, 16);
}

TEST(Statistics, FewSamplesAreUnbiasedOnALine) {
    expect_unbiased({0.3, 0.0, 0.0, 0.0, 0.0}, 60.0, 4);
    expect_unbiased({0.0, 0.3, 0.0, 0.0, 0.1}, 60.0, 1);
}

// With and without the rest of a scramble's points; mis with a base that X's own facets would hardly find.
TEST(Statistics, FewScrambledSamplesAreUnbiased) {
    for (const uint32_t spp : {2u, 14u, 16u}) {
        expect_unbiased({0.3, 0.2, 0.5, 0.1, 0.0}, 60.0, spp, SMX_SAMPLER_SOBOL);
        expect_unbiased({0.3, 0.2, 0.5, 0.1, 0.0}, 60.0, spp, SMX_SAMPLER_MIS);
    }
    expect_unbiased({0.3, 0.3, 0.0, 0.0, 0.0}, 60.0, 64, SMX_SAMPLER_MIS, 0.03);
    expect_unbiased({0.3, 0.0, 0.0, 0.0, 0.0}, 60.0, 4, SMX_SAMPLER_MIS);
}

// Stratification pays: the deviation falls faster than with independent samples, whose deviation would halve.
TEST(Statistics, StrataReduceTheDeviation) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, base_alpha}}, Masking::correlated));
    const smx_scene scene = test::make_scene(resolution, resolution, test::radians(90.0), {0.3, 0.3, 0.0, 0.0, 0.0});
    const std::size_t centre = resolution * resolution / 2;
    const double coarse = images_over_seeds(brdf, scene, 64)[centre].deviation();
    const double fine = images_over_seeds(brdf, scene, 256)[centre].deviation();
    EXPECT_GT(fine, 0.0);
    EXPECT_LT(fine, coarse / 2.4);
}
