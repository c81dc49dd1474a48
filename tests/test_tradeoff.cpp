// What tradeoff makes of its measurements, on measurements whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "close.h"
#include "run_statistics.h"
#include "tradeoff_analysis.h"

using namespace slopemix::cli;

namespace {

constexpr double rounding = 1e-12;

TradeoffPoint sampled(Method method, std::uint32_t samples, double error, double seconds) {
    TradeoffPoint point{{method, samples}, {}};
    point.measured.runs = 5;
    point.measured.relrmse = point.measured.noise = error;
    point.measured.mean_relrmse = error / std::sqrt(5.0);
    point.measured.seconds = point.measured.kernel_seconds = {seconds, seconds, seconds};
    return point;
}

TradeoffPoint filtered(std::uint32_t lobes, std::int32_t order, double error, double seconds) {
    TradeoffPoint point = sampled(Method::per_lobe, 0, error, seconds);
    point.configuration.lobes = lobes;
    point.configuration.order = order;
    point.measured.noise = 0.0;
    point.measured.mean_relrmse = error;
    point.measured.widening = error / 4.0;
    return point;
}

Image image_of(const std::vector<float> &rgba) {
    return acquire<Image>(smx_image_create, static_cast<std::uint32_t>(rgba.size() / 4), std::uint32_t{1}, rgba.data());
}

std::vector<std::string> names_of(const std::vector<const TradeoffPoint *> &points) {
    std::vector<std::string> names;
    for (const TradeoffPoint *point : points) names.push_back(name_of(point->configuration));
    return names;
}

} // namespace

TEST(RunStatistics, MeanAndDeviationOfASurface) {
    RunStatistics statistics;
    // Two pixels, of which the second is off the surface; deviations 1, 2 and 0 from means 2, 4 and 7.
    statistics.add(image_of({1, 2, 7, 1, 5, 5, 5, 0}));
    EXPECT_EQ(statistics.deviation(), 0.0);
    statistics.add(image_of({3, 6, 7, 1, 9, 9, 9, 0}));
    EXPECT_CLOSE(statistics.deviation(), std::sqrt((2.0 + 8.0 + 0.0) / 3.0), rounding, 0.0);
    const Image mean = statistics.mean();
    const float *pixels = smx_image_pixels(mean.get());
    EXPECT_EQ(std::vector<float>(pixels, pixels + 4), (std::vector<float>{2, 4, 7, 1}));
    EXPECT_EQ(pixels[7], 0.0f);
}

TEST(Tradeoff, NoiseAndBiasAreTakenApart) {
    GroundTruth truth;
    truth.error = 0.001;
    Measurement measured;
    measured.runs = 5;
    measured.noise = 0.1;
    const double left = 0.1 * 0.1 / 5.0 + 0.001 * 0.001;
    measured.mean_relrmse = std::sqrt(0.3 * 0.3 + left);
    EXPECT_CLOSE(bias_of(measured, truth).value.value_or(0.0), 0.3, rounding, 0.0);
    EXPECT_CLOSE(bias_of(measured, truth).floor, 3.0 * std::sqrt(left), rounding, 0.0);
    measured.mean_relrmse = 2.9 * std::sqrt(left);
    EXPECT_FALSE(bias_of(measured, truth).value);
}

TEST(Tradeoff, TheFloorIsTenTimesTheTruthsError) {
    GroundTruth truth;
    truth.error = 0.001;
    Measurement measured;
    measured.relrmse = 0.0101;
    EXPECT_FALSE(is_at_floor(measured, truth));
    EXPECT_EQ(error_bound(measured, truth), 0.0101);
    measured.relrmse = 0.0099;
    EXPECT_TRUE(is_at_floor(measured, truth));
    EXPECT_CLOSE(error_bound(measured, truth), 0.01, rounding, 0.0);
}

TEST(Tradeoff, PsnrIsOfThePeak) {
    GroundTruth truth;
    truth.rms = 0.5;
    truth.peak = 10.0;
    Measurement measured;
    measured.relrmse = 0.02; // 0.01 of a peak of 10: 60 dB
    EXPECT_CLOSE(psnr(measured, truth), 60.0, rounding, 0.0);
}

TEST(Tradeoff, ParetoSetHasWhatNothingBeats) {
    TradeoffResult result;
    result.truth.error = 1e-4;
    result.points = {sampled(Method::grid, 4, 0.5, 1.0),
                     sampled(Method::grid, 16, 0.2, 4.0),
                     sampled(Method::mis, 4, 0.2, 2.0),
                     filtered(8, 0, 0.05, 0.1),
                     filtered(1, 0, 0.3, 0.05),
                     sampled(Method::mis, 64, 5e-4, 9.0), // at the floor, like the next, which is cheaper
                     sampled(Method::sobol, 64, 9e-4, 8.0)};
    EXPECT_EQ(names_of(pareto_set(result)),
              (std::vector<std::string>{"per-lobe N=1 order 0", "per-lobe N=8 order 0", "sobol 64"}));
}

TEST(Tradeoff, LawsComeBackFromTheirPoints) {
    TradeoffResult result;
    result.truth.error = 1e-5;
    for (std::uint32_t n = 1; n <= 65536; n *= 4)
        result.points.push_back(sampled(Method::sobol, n, 0.7 * std::pow(n, -0.9), 1e-3 + 2e-6 * n));
    // Off the law: below the floor, and a variant.
    result.points.push_back(sampled(Method::sobol, 1u << 18, 5e-5, 1e-3 + 2e-6 * (1u << 18)));
    result.points.push_back(sampled(Method::sobol, 64, 0.9, 7.0));
    result.points.back().configuration.variant = 1;
    const std::vector<SamplerLaw> laws = sampler_laws(result);
    ASSERT_EQ(laws.size(), 1u);
    ASSERT_TRUE(laws[0].noise && laws[0].seconds && laws[0].kernel_seconds);
    EXPECT_CLOSE(laws[0].noise->factor, 0.7, 1e-9, 0.0);
    EXPECT_CLOSE(laws[0].noise->exponent, 0.9, 1e-9, 0.0);
    EXPECT_CLOSE(laws[0].seconds->constant, 1e-3, 1e-9, 0.0);
    EXPECT_CLOSE(laws[0].kernel_seconds->slope, 2e-6, 1e-9, 0.0);
    result.points.resize(1);
    EXPECT_FALSE(sampler_laws(result)[0].noise);
    EXPECT_FALSE(sampler_laws(result)[0].seconds);
}

TEST(Tradeoff, AFilterMeetsTheCheapestReferenceThatIsAsGood) {
    TradeoffResult result;
    result.points = {sampled(Method::mis, 1024, 0.012, 5.0),
                     sampled(Method::grid, 4096, 0.04, 3.0),
                     sampled(Method::mis, 64, 0.04, 2.0),
                     sampled(Method::mis, 4, 0.2, 1.0),
                     filtered(1, 0, 0.3, 0.1),
                     filtered(8, 0, 0.05, 0.5)};
    const std::vector<const TradeoffPoint *> filters = chosen_filters(result);
    ASSERT_EQ(names_of(filters), (std::vector<std::string>{"per-lobe N=8 order 0"}));
    EXPECT_EQ(name_of(duel(result, *filters[0]).reference->configuration), "mis 64");
    EXPECT_CLOSE(duel(result, *filters[0]).ratio(), 4.0, rounding, 0.0);
    EXPECT_EQ(name_of(widening_duel(result, *filters[0]).reference->configuration), "mis 1024");
    result.points[0].measured.relrmse = 0.013;
    EXPECT_EQ(widening_duel(result, *filters[0]).reference, nullptr);
}

TEST(Tradeoff, PlansHaveNoPointTwice) {
    const SweepAxes axes{{Method::mis, Method::geometric, Method::shared}, 64, {1, 16}, {0, SMX_WIDENING_AUTO}};
    std::vector<std::string> names;
    for (const Configuration &configuration : plan_of(axes)) names.push_back(name_of(configuration));
    EXPECT_EQ(names, (std::vector<std::string>{"mis 2",
                                               "mis 4",
                                               "mis 16",
                                               "mis 64",
                                               "geometric 16",
                                               "geometric 64",
                                               "shared N=1 order 0",
                                               "shared N=16 order 0",
                                               "shared N=1 order auto",
                                               "shared N=16 order auto",
                                               "mis 64 fast",
                                               "mis 64 double",
                                               "mis 64 separable",
                                               "mis 64 no-masking",
                                               "mis 64 no-shadowing",
                                               "shared N=1 order 0 fast",
                                               "shared N=1 order 0 double",
                                               "shared N=1 order 0 separable",
                                               "shared N=1 order 0 no-masking",
                                               "shared N=1 order 0 no-shadowing",
                                               "shared N=1 order 0 no-fresnel",
                                               "shared N=1 order 0 effects-auto"}));
    const SweepAxes turned{{Method::per_lobe}, 64, {8}, {1}, true};
    names.clear();
    for (const Configuration &configuration : plan_of(turned)) names.push_back(name_of(configuration));
    EXPECT_EQ(names.size(), 10u);
    for (const char *name : {"per-lobe N=8 order 1 no-lobe-color", "per-lobe N=8 order 1 no-anisotropy"})
        EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    EXPECT_TRUE(plan_of({{Method::mis, Method::geometric}, 1, {1}, {0}}).empty());
}
