// The samplers that scramble say how wrong they are; what they say is compared with how wrong they are.
#include <gtest/gtest.h>

#include "support.h"

namespace {

// An estimate from 16 scrambles, compared with one error: their ratio is rarely beyond these.
constexpr double least_ratio = 0.4, most_ratio = 2.5;

const smx_scene scene = test::make_scene(32, 32, test::radians(60.0), {0.3, 0.3, 0.0, 0.0, 0.0});

const test::Brdf &brdf() {
    static const test::Brdf b =
        test::make_brdf(test::beckmann_table({{0.3, 0.03}, {0.7, 0.3}}, oracle::Masking::correlated));
    return b;
}

struct Estimate {
    test::Image image;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
};

Estimate render(smx_sampler sampler, uint32_t spp, uint64_t seed, double target = 0.0) {
    smx_render_options options = test::make_options(spp, seed);
    options.sampler = sampler;
    options.target_error = target;
    Estimate e;
    EXPECT_SMX_OK(smx_render_reference(test::context(), brdf(), &scene, &options, e.image.out(), &e.report));
    return e;
}

const test::Image &truth() {
    static const Estimate e = render(SMX_SAMPLER_MIS, 1 << 20, 99);
    return e.image;
}

} // namespace

TEST(StandardError, IsTheError) {
    for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
        for (const uint32_t spp : {256u, 4096u}) {
            const Estimate e = render(sampler, spp, 1);
            const double error = test::relrmse(e.image, truth());
            EXPECT_GT(error, least_ratio * e.report.standard_error) << "sampler " << sampler << ", spp " << spp;
            EXPECT_LT(error, most_ratio * e.report.standard_error) << "sampler " << sampler << ", spp " << spp;
        }
}

TEST(StandardError, IsAbsentForTheGrid) {
    EXPECT_LT(render(SMX_SAMPLER_GRID, 256, 1).report.standard_error, 0.0);
    EXPECT_LT(render(SMX_SAMPLER_SOBOL, 250, 1).report.standard_error, 0.0);
}

TEST(StandardError, TargetIsReached) {
    for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
        for (const double target : {0.05, 0.005}) {
            const Estimate e = render(sampler, 2, 2, target);
            EXPECT_LE(e.report.standard_error, target);
            EXPECT_LT(test::relrmse(e.image, truth()), most_ratio * target);
            EXPECT_GT(e.report.spp, 2u);
        }
    EXPECT_GT(render(SMX_SAMPLER_SOBOL, 2, 2, 0.005).report.spp, render(SMX_SAMPLER_SOBOL, 2, 2, 0.05).report.spp);
}

TEST(StandardError, SeedsAndSamplersAgree) {
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
        const Estimate a = render(sampler, 65536, 3), b = render(sampler, 65536, 4);
        EXPECT_LT(test::relrmse(a.image, truth()), 0.01) << "sampler " << sampler;
        EXPECT_GT(test::relrmse(a.image, b.image), 0.0) << "sampler " << sampler;
    }
}
