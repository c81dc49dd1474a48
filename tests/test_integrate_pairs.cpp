// smx_brdf_integrate: the reference for pairs of directions, against the oracle's integral and the sphere's pixels; and
// the sphere with the whole table against the one with the slice.
#include <gtest/gtest.h>

#include <vector>

#include "close.h"
#include "oracle_reference.h"
#include "oracle_sphere.h"
#include "random.h"
#include "support.h"

using oracle::Masking;
using oracle::Vec;

namespace {

// The accuracy of 2^17 samples of mis; the oracle's own error is asserted to be a tenth of it.
constexpr double pair_tolerance = 0.01;
// Float32 angles of a pair against those of the image: 1e-5 of a cell in a table that changes tenfold within one.
constexpr double rounding = 2e-4;
constexpr float canary = -7.25f;

const test::Brdf &brdf() {
    static const test::Brdf b = test::make_brdf(test::beckmann_table({{0.3, 0.05}, {0.7, 0.4}}, Masking::correlated));
    return b;
}

// Planes, [3][count].
struct Pairs {
    std::vector<Vec> wi, wo;

    void add(const Vec &i, const Vec &o) {
        wi.push_back(i);
        wo.push_back(o);
    }
    std::size_t count() const { return wi.size(); }
    static std::vector<float> planes(const std::vector<Vec> &list) {
        std::vector<float> out;
        for (const Vec &v : list) out.push_back(static_cast<float>(v.x));
        for (const Vec &v : list) out.push_back(static_cast<float>(v.y));
        for (const Vec &v : list) out.push_back(static_cast<float>(v.z));
        return out;
    }
};

struct Result {
    std::size_t count;
    std::vector<float> fcos, errors; // with a canary behind each
    smx_render_report report = SMX_RENDER_REPORT_INIT;

    double at(std::size_t k, std::size_t c) const { return fcos[c * count + k]; }
    double error_at(std::size_t k, std::size_t c) const { return errors[c * count + k]; }
};

Result integrate(const Pairs &pairs, const smx_displacement &x, const smx_render_options &options,
                 smx_context context = test::context(), smx_masking g = SMX_G2_CORRELATED) {
    Result r{pairs.count(), std::vector<float>(3 * pairs.count() + 1, canary),
             std::vector<float>(3 * pairs.count() + 1, canary)};
    const bool estimate = options.sampler != SMX_SAMPLER_GRID;
    EXPECT_SMX_OK(smx_brdf_integrate(context, brdf(), &x, g, &options, pairs.count(), Pairs::planes(pairs.wi).data(),
                                     Pairs::planes(pairs.wo).data(), r.fcos.data(),
                                     estimate ? r.errors.data() : nullptr, &r.report));
    EXPECT_EQ(r.fcos.back(), canary);
    EXPECT_EQ(r.errors.back(), canary);
    return r;
}

smx_render_options options_of(smx_sampler sampler, uint32_t spp) {
    smx_render_options options = test::make_options(spp, 5);
    options.sampler = sampler;
    return options;
}

Vec direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Pairs random_pairs(std::size_t count) {
    test::Random random(3);
    Pairs pairs;
    for (std::size_t k = 0; k < count; ++k)
        pairs.add(direction(random.uniform(0.0, 1.4), random.uniform(0.0, 6.28)),
                  direction(random.uniform(0.0, 1.4), random.uniform(0.0, 6.28)));
    return pairs;
}

} // namespace

TEST(IntegratePairs, AreTheIntegral) {
    const oracle::Table table = test::filled_table(brdf());
    const oracle::FacetBrdf f = oracle::table_brdf(table, oracle::Lookup::linear);
    const Pairs pairs = random_pairs(12);
    const smx_displacement xs[] = {
        {0.3, 0.3, 0.0, 0.0, 0.0}, {0.4, 0.2, 0.5, 0.1, -0.1}, {0.3, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.1, 0.0}};
    for (const smx_displacement &x : xs)
        for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
            const Result got = integrate(pairs, x, options_of(SMX_SAMPLER_MIS, 1 << 17), test::context(), g);
            int bright = 0;
            double peak = 0.0;
            for (std::size_t k = 0; k < pairs.count(); ++k) peak = std::max(peak, got.at(k, 0));
            for (std::size_t k = 0; k < pairs.count(); ++k) {
                const oracle::Integral wanted =
                    oracle::reference(f, test::masking(g), test::gaussian(x), pairs.wi[k], pairs.wo[k]);
                if (wanted.rgb[0] < 1e-3 * peak) continue;
                ++bright;
                EXPECT_LT(wanted.error, 0.1 * pair_tolerance);
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_CLOSE(got.at(k, c), wanted.rgb[c], pair_tolerance, 1e-4 * peak);
            }
            EXPECT_GT(bright, 4);
        }
}

// The same facets of X are drawn: pixel and pair differ by rounding. (Those of mis about wh are not the same: they are
// fitted to an image's one theta_d, or to all that pairs may have.)
TEST(IntegratePairs, AreTheSpheresPixels) {
    const smx_scene scene = test::make_scene(9, 9, test::radians(30.0), {0.3, 0.2, 0.0, 0.1, 0.0});
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL}) {
        smx_render_options options = options_of(sampler, 1024);
        options.errors = sampler != SMX_SAMPLER_GRID;
        const test::Image image = test::render_reference(brdf(), scene, options);
        const float *pixels = smx_image_pixels(image), *errors = smx_image_errors(image);
        Pairs pairs;
        std::vector<std::size_t> at;
        for (uint32_t k = 0; k < 81; ++k) {
            const oracle::Pixel p = oracle::sphere_pixel(9, 9, k % 9, k / 9, scene.light_phi);
            if (!p.on_sphere || p.wi.z < 0.05) continue;
            pairs.add(p.wi, p.wo);
            at.push_back(k);
        }
        ASSERT_GT(at.size(), 20u);
        const Result got = integrate(pairs, scene.displacement, options);
        for (std::size_t k = 0; k < at.size(); ++k)
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_CLOSE(got.at(k, c), pixels[4 * at[k] + c], rounding, 1e-6);
                if (!errors) continue;
                EXPECT_CLOSE(got.error_at(k, c), errors[4 * at[k] + c], 20 * rounding, 1e-6);
            }
    }
}

TEST(IntegratePairs, AnyNumberOnAnyDevices) {
    const smx_displacement x{0.3, 0.3, 0.0, 0.0, 0.0};
    smx_context_options two = SMX_CONTEXT_OPTIONS_INIT;
    two.sub_devices = 2;
    test::Context context;
    ASSERT_SMX_OK(smx_context_create(&two, context.out()));
    const Pairs all = random_pairs(9001);
    const smx_render_options options = options_of(SMX_SAMPLER_MIS, 32);
    const Result wanted = integrate(all, x, options);
    EXPECT_EQ(wanted.report.evaluations, 32u * 9001u);
    const Result shared = integrate(all, x, options, context);
    EXPECT_EQ(wanted.fcos, shared.fcos);
    EXPECT_EQ(wanted.errors, shared.errors);
    EXPECT_EQ(wanted.report.standard_error, shared.report.standard_error);
    for (const std::size_t count : {1u, 7u, 93u}) {
        Pairs some = all;
        some.wi.resize(count);
        some.wo.resize(count);
        const Result got = integrate(some, x, options);
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(got.at(k, c), wanted.at(k, c));
                EXPECT_EQ(got.error_at(k, c), wanted.error_at(k, c));
            }
    }
}

TEST(IntegratePairs, BelowTheSurfaceIsNothing) {
    Pairs pairs;
    pairs.add(direction(0.5, 0.0), direction(0.5, 1.0));
    pairs.add(direction(2.0, 0.0), direction(0.5, 1.0));
    pairs.add(direction(0.5, 0.0), direction(2.0, 1.0));
    pairs.add(direction(0.5, 0.0), direction(oracle::pi - 0.5, oracle::pi)); // opposite
    // A mean plane so steep that all but the opposite directions are above it.
    const Result got = integrate(pairs, {0.3, 0.3, 0.0, -2.0, -2.0}, options_of(SMX_SAMPLER_MIS, 64));
    EXPECT_GT(got.at(0, 0), 0.0);
    EXPECT_EQ(got.report.evaluations, 64u);
    for (std::size_t k = 1; k < 4; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(got.at(k, c), 0.0);
            EXPECT_EQ(got.error_at(k, c), 0.0);
        }
}

TEST(IntegratePairs, ErrorsAreTheErrors) {
    const smx_displacement x{0.3, 0.3, 0.0, 0.0, 0.0};
    const Pairs pairs = random_pairs(400);
    const Result truth = integrate(pairs, x, options_of(SMX_SAMPLER_MIS, 1 << 17));
    for (const smx_sampler sampler : {SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS}) {
        const Result got = integrate(pairs, x, options_of(sampler, 256));
        double error2 = 0.0, estimate2 = 0.0, value2 = 0.0;
        for (std::size_t k = 0; k < pairs.count(); ++k) {
            error2 += std::pow(got.at(k, 0) - truth.at(k, 0), 2);
            estimate2 += std::pow(got.error_at(k, 0), 2);
            value2 += std::pow(truth.at(k, 0), 2);
        }
        EXPECT_CLOSE(std::sqrt(error2 / estimate2), 1.0, 0.6, 0.0) << sampler;
        EXPECT_CLOSE(got.report.standard_error, std::sqrt(estimate2 / value2), 0.3, 0.0); // red's and all three's
    }
    smx_render_options target = options_of(SMX_SAMPLER_MIS, 2);
    target.target_error = 0.01;
    const Result reached = integrate(pairs, x, target);
    EXPECT_LE(reached.report.standard_error, 0.01);
    EXPECT_GT(reached.report.spp, 2u);
}

TEST(WholeTable, IsTheSlice) {
    const smx_displacement xs[] = {{0.25, 0.25, 0.0, 0.0, 0.0}, {0.5, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0}};
    for (const smx_displacement &x : xs)
        for (const double light : {90.0, 41.3, 0.0, -60.0})
            for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
                for (const smx_lookup lookup : {SMX_LOOKUP_LINEAR, SMX_LOOKUP_NEAREST}) {
                    const smx_scene scene = test::make_scene(24, 24, test::radians(light), x);
                    smx_render_options options = options_of(sampler, 256);
                    options.lookup = lookup;
                    const test::Image slice = test::render_reference(brdf(), scene, options);
                    options.whole_table = 1;
                    const test::Image whole = test::render_reference(brdf(), scene, options);
                    EXPECT_LT(test::relrmse(whole, slice), 1e-6)
                        << "light " << light << ", sampler " << sampler << ", lookup " << lookup;
                }
}
