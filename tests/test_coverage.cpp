// Standard errors are honest: Student's interval about a pixel, with as many degrees of freedom as scrambles but one,
// holds the converged value as often as it says. Every trial has a scene and a seed of its own, and is one pixel of it.
//
// Student asks for means of scrambles that are normal. Equal strata of X's slopes would skew them, most on a line: the
// outermost, with all of the tail, would leave most of the error (draw_grid in cl/draw_facets.cl). Over a plane a
// little of it is left, which 8 scrambles would show (92.9 % of 95) and 16 do not. Dark pixels, carried by few samples,
// are left out.
#include <gtest/gtest.h>

#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <optional>

#include "random.h"
#include "support.h"

namespace {

constexpr int scrambles = 16;
constexpr uint32_t spp = 4096, truth_spp = 1 << 16;
constexpr std::size_t wanted_trials = 2000;
constexpr uint32_t resolution = 3;
// Of the image's brightest pixel; darker ones are in X's tail, and carried by few samples.
constexpr float dark_share = 0.25f;
// A Lambertian on a line is constant but for roundings.
constexpr double rounding = 1e-7;
// An honest estimate is refused by one run in a thousand.
constexpr double significance = 1e-3;

// Red of a pixel.
struct Trial {
    double value, error, truth;
};

struct Estimate {
    test::Image image;
    const float *value(std::size_t pixel) const { return smx_image_pixels(image) + 4 * pixel; }
    double error(std::size_t pixel) const { return smx_image_errors(image)[4 * pixel]; }
};

Estimate render(smx_brdf brdf, const smx_scene &scene, smx_sampler sampler, uint32_t samples, uint64_t seed) {
    smx_render_options options = test::make_options(samples, seed);
    options.sampler = sampler;
    options.scrambles = scrambles;
    options.errors = 1;
    Estimate e;
    EXPECT_SMX_OK(smx_render_reference(test::context(), brdf, &scene, &options, e.image.out(), nullptr));
    return e;
}

const std::vector<test::Brdf> &bases() {
    static const std::vector<test::Brdf> list = [] {
        std::vector<test::Brdf> opened;
        for (const char *name : {"analytic:lambert,albedo=0.5", "builtin:conductor",
                                 "analytic:beckmann,alpha=0.1,f0=0.9", "analytic:ggx,alpha=0.2,f0=0.5"}) {
            opened.emplace_back();
            EXPECT_SMX_OK(smx_brdf_open(name, opened.back().out()));
        }
        return opened;
    }();
    return list;
}

// Half of the surfaces are smooth along an axis.
smx_scene random_scene(test::Random &random) {
    smx_displacement x{random.log_uniform(0.05, 0.6), random.log_uniform(0.05, 0.6), random.uniform(-0.8, 0.8),
                       random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)};
    const std::size_t kind = random.below(4);
    if (kind == 2) x.alpha_x = 0.0;
    if (kind == 3) x.alpha_y = 0.0;
    return test::make_scene(resolution, resolution, random.uniform(-0.5, oracle::pi + 0.5), x);
}

// A pixel that is not dark, if the image has one.
std::optional<std::size_t> random_pixel(const Estimate &image, test::Random &random) {
    constexpr std::size_t count = resolution * resolution;
    float brightest = 0.0f;
    for (std::size_t p = 0; p < count; ++p) brightest = std::max(brightest, *image.value(p));
    std::vector<std::size_t> bright;
    for (std::size_t p = 0; p < count; ++p)
        if (*image.value(p) > dark_share * brightest) bright.push_back(p);
    if (bright.empty()) return {};
    return bright[random.below(bright.size())];
}

constexpr smx_sampler samplers[] = {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS};
constexpr double levels[] = {0.5, 0.95};

// Of both samplers, in that order, in the same scenes.
std::array<std::vector<Trial>, 2> make_trials() {
    test::Random random(5);
    std::array<std::vector<Trial>, 2> trials;
    for (uint64_t seed = 1; trials[0].size() < wanted_trials; ++seed) {
        const smx_scene scene = random_scene(random);
        const smx_brdf brdf = bases()[random.below(bases().size())];
        const Estimate truth = render(brdf, scene, SMX_SAMPLER_SOBOL, truth_spp, seed << 32);
        const std::optional<std::size_t> pixel = random_pixel(truth, random);
        if (!pixel || truth.error(*pixel) < rounding * *truth.value(*pixel)) continue;
        // The truth is the better of both samplers' estimates: each has scenes where the other leaves more error.
        const Estimate other = render(brdf, scene, SMX_SAMPLER_MIS, truth_spp, seed << 32);
        const Estimate &best = other.error(*pixel) < truth.error(*pixel) ? other : truth;
        for (std::size_t s = 0; s < 2; ++s) {
            const Estimate got = render(brdf, scene, samplers[s], spp, seed);
            trials[s].push_back({*got.value(*pixel), got.error(*pixel), *best.value(*pixel)});
        }
    }
    return trials;
}

// Trials whose interval of this level, its half width times `scale`, holds the truth.
int covered(const std::vector<Trial> &trials, double level, double scale = 1.0) {
    const double width = boost::math::quantile(boost::math::students_t(scrambles - 1), (1.0 + level) / 2.0) * scale;
    return static_cast<int>(std::count_if(trials.begin(), trials.end(), [width](const Trial &t) {
        return std::abs(t.value - t.truth) <= width * t.error;
    }));
}

// Exact, two-sided: the lesser tail, doubled.
double binomial_p_value(std::size_t trials, int successes, double level) {
    const boost::math::binomial distribution(static_cast<double>(trials), level);
    const double below = boost::math::cdf(distribution, successes);
    const double above = boost::math::cdf(boost::math::complement(distribution, successes - 1));
    return 2.0 * std::min(below, above);
}

} // namespace

TEST(Coverage, IntervalsHoldTheTruthAsOftenAsTheySay) {
    const auto trials = make_trials();
    for (std::size_t s = 0; s < 2; ++s) {
        SCOPED_TRACE(::testing::Message() << "sampler " << samplers[s]);
        const std::size_t count = trials[s].size();
        for (std::size_t k = 0; k < 2; ++k) {
            const int held = covered(trials[s], levels[k]);
            EXPECT_GT(binomial_p_value(count, held, levels[k]), significance)
                << "intervals of " << levels[k] << " hold " << held << " of " << count;
            // Errors a fifth too small are seen.
            EXPECT_LT(binomial_p_value(count, covered(trials[s], levels[k], 0.8), levels[k]), significance);
        }
    }
}
