// smx_evaluator_*: every quantity against the oracle, and arrays as callers have them.
#include <gtest/gtest.h>

#include <numeric>

#include "close.h"
#include "directions.h"
#include "random.h"
#include "support.h"

using oracle::Lobe;
using oracle::Vec;

namespace {

using Evaluator = test::Handle<smx_evaluator, smx_evaluator_release>;

// Float32 evaluations of well-conditioned surfaces: alphas from 0.1 on, directions off the horizon.
constexpr double tolerance = 3e-5;

struct Surface {
    std::vector<Lobe> lobes; // weights sum to 1
    smx_displacement x;
};

const std::vector<Surface> &surfaces() {
    static const std::vector<Surface> list{
        {{{1.0, 0.3}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {{{0.25, 0.1}, {0.75, 0.6}}, {0.25, 0.25, 0.0, 0.0, 0.0}},
        {{{0.5, 0.2}, {0.3, 0.4}, {0.2, 1.5}}, {0.5, 0.1, 0.6, 0.0, 0.0}},
        {{{0.6, 0.15}, {0.4, 0.5}}, {0.2, 0.3, -0.4, 0.3, -0.2}},
    };
    return list;
}

// Curves of lobe k in the per-lobe model: constants, of luminance 1 / (k + 1)^2.
test::Colour colour_of_lobe(std::size_t k) {
    const double f = 1.0 / static_cast<double>((k + 1) * (k + 1));
    return {f, f, f};
}

// What a lobe counts among the directions drawn: its luminance's share, at least a tenth of an equal one.
std::vector<double> drawn_shares(std::size_t lobes) {
    std::vector<double> shares;
    for (std::size_t k = 0; k < lobes; ++k) shares.push_back(colour_of_lobe(k)[0]);
    for (int floored = 0; floored < 2; ++floored) {
        const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
        for (double &s : shares) s = std::max(s / sum, floored ? 0.0 : 0.1 / static_cast<double>(lobes));
    }
    return shares;
}

test::Material material_of(const Surface &s, smx_model model) {
    if (model == SMX_MODEL_SHARED) return test::make_material(s.lobes, test::channel_fresnel);
    std::vector<test::Colour> colours;
    for (std::size_t k = 0; k < s.lobes.size(); ++k) colours.push_back(colour_of_lobe(k));
    return test::make_per_lobe_material(s.lobes, colours);
}

Evaluator make_evaluator(smx_material material, const smx_displacement &x, smx_context where = nullptr,
                         int32_t order = 0) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.widening_order = order;
    Evaluator e;
    EXPECT_SMX_OK(
        smx_evaluator_create(where ? where : test::context(), material, &x, SMX_G2_CORRELATED, &options, e.out()));
    return e;
}

smx_vectors from(const std::vector<float> &v) { return SMX_PACKED(v.data()); }
smx_vectors_out into(std::vector<float> &v) { return SMX_PACKED(v.data()); }

test::Directions directions_of(const Surface &s, std::size_t count, uint64_t seed) {
    test::Random random(seed);
    const oracle::Gaussian x = test::gaussian(s.x);
    test::Directions d;
    while (d.count() < count) {
        const Vec wi = random.direction(0.05), wo = random.direction(0.05);
        if (oracle::plane(x, wi) > 0.05 && oracle::plane(x, wo) > 0.05) d.add(wi, wo);
    }
    return d;
}

// The density by its definition: the mixture's, or of each lobe by its share.
double oracle_pdf(const Surface &s, smx_model model, const Vec &wi, const Vec &wo) {
    const Vec wh = oracle::normalised(wi + wo);
    if (wh.z <= 0.0) return 0.0;
    const oracle::Mixture mixture{s.lobes, test::gaussian(s.x)};
    if (model == SMX_MODEL_SHARED) return oracle::ndf(mixture, wh) / (4.0 * oracle::sigma(mixture, wo));
    const std::vector<double> shares = drawn_shares(s.lobes.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        const oracle::Gaussian lobe = oracle::widened(test::gaussian(s.x), s.lobes[k].alpha);
        sum += shares[k] * oracle::ndf(lobe, wh) / (4.0 * oracle::sigma(lobe, wo));
    }
    return sum;
}

} // namespace

TEST(Evaluator, DensityIsTheOraclesInBothModels) {
    for (const Surface &s : surfaces())
        for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
            const test::Directions d = directions_of(s, 500, 1);
            const test::Material material = material_of(s, model);
            const Evaluator e = make_evaluator(material, s.x);
            std::vector<float> pdf(d.count());
            const smx_vectors wi = from(d.wi), wo = from(d.wo);
            const smx_scalars_out out = {pdf.data(), 1};
            ASSERT_SMX_OK(smx_evaluator_pdf(e, d.count(), &wi, &wo, &out));
            for (std::size_t k = 0; k < d.count(); ++k)
                EXPECT_CLOSE(pdf[k], oracle_pdf(s, model, d.at(d.wi, k), d.at(d.wo, k)), tolerance, 1e-12);
        }
}

TEST(Evaluator, MicrosurfaceIsTheOracles) {
    for (const Surface &s : surfaces()) {
        const test::Directions d = directions_of(s, 500, 2);
        const oracle::Mixture mixture{s.lobes, test::gaussian(s.x)};
        const test::Material material = material_of(s, SMX_MODEL_SHARED);
        const Evaluator e = make_evaluator(material, s.x);
        const smx_vectors wi = from(d.wi), wo = from(d.wo);
        std::vector<float> ndf(d.count()), sigma(d.count()), g1(d.count()), g2(d.count());
        const smx_scalars_out to[] = {{ndf.data(), 1}, {sigma.data(), 1}, {g1.data(), 1}, {g2.data(), 1}};
        ASSERT_SMX_OK(smx_evaluator_ndf(e, d.count(), &wi, &to[0]));
        ASSERT_SMX_OK(smx_evaluator_sigma(e, d.count(), &wi, &to[1]));
        ASSERT_SMX_OK(smx_evaluator_g1(e, d.count(), &wi, &to[2]));
        ASSERT_SMX_OK(smx_evaluator_g2(e, d.count(), &wi, &wo, &to[3]));
        for (std::size_t k = 0; k < d.count(); ++k) {
            const Vec i = d.at(d.wi, k), o = d.at(d.wo, k);
            const double area = oracle::sigma(mixture, i), plane = oracle::plane(mixture.x, i);
            EXPECT_CLOSE(ndf[k], oracle::ndf(mixture, i), tolerance, 1e-12);
            EXPECT_CLOSE(sigma[k], area, tolerance, 0.0);
            EXPECT_CLOSE(g1[k], plane / area, tolerance, 0.0);
            EXPECT_CLOSE(g2[k], oracle::g2(oracle::Masking::correlated, mixture, i, o), tolerance, 0.0);
        }
    }
}

// The per-lobe model's microsurface has the lobes' shares of the energy, which smx_lobe calls weights.
TEST(Evaluator, MicrosurfaceOfThePerLobeModelHasItsLobesWeights) {
    const Surface s = surfaces()[2];
    const test::Material material = material_of(s, SMX_MODEL_PER_LOBE);
    std::vector<Lobe> lobes;
    for (const smx_lobe &l : test::lobes_of(material)) lobes.push_back({l.weight, l.alpha});
    const oracle::Mixture mixture{lobes, test::gaussian(s.x)};
    const Evaluator e = make_evaluator(material, s.x);
    const test::Directions d = directions_of(s, 100, 3);
    const smx_vectors k_in = from(d.wi);
    std::vector<float> sigma(d.count());
    const smx_scalars_out out = {sigma.data(), 1};
    ASSERT_SMX_OK(smx_evaluator_sigma(e, d.count(), &k_in, &out));
    for (std::size_t k = 0; k < d.count(); ++k)
        EXPECT_CLOSE(sigma[k], oracle::sigma(mixture, d.at(d.wi, k)), tolerance, 0.0);
}

TEST(Evaluator, WhatIsBelowTheSurfaceIsZero) {
    const test::Material material = test::make_material({{1.0, 0.3}});
    const smx_displacement x = {0.2, 0.2, 0.0, 0.0, 0.0};
    const Evaluator e = make_evaluator(material, x);
    const float down[] = {0.6f, 0.0f, -0.8f}, up[] = {0.0f, 0.6f, 0.8f};
    const smx_vectors below = SMX_PACKED(down), above = SMX_PACKED(up);
    float value[3] = {-1.0f, -1.0f, -1.0f};
    const smx_vectors_out rgb = SMX_PACKED(value);
    const smx_scalars_out out = {value, 1};
    for (const auto &[wi, wo] : {std::pair{&below, &above}, {&above, &below}, {&below, &below}}) {
        ASSERT_SMX_OK(smx_evaluator_eval(e, 1, wi, wo, &rgb));
        EXPECT_EQ(value[0], 0.0f);
        ASSERT_SMX_OK(smx_evaluator_g2(e, 1, wi, wo, &out));
        EXPECT_EQ(value[0], 0.0f);
    }
    ASSERT_SMX_OK(smx_evaluator_pdf(e, 1, &above, &below, &out));
    EXPECT_EQ(value[0], 0.0f);
    ASSERT_SMX_OK(smx_evaluator_ndf(e, 1, &below, &out));
    EXPECT_EQ(value[0], 0.0f);
    ASSERT_SMX_OK(smx_evaluator_g1(e, 1, &below, &out));
    EXPECT_EQ(value[0], 0.0f);
    // A density of drawing is not 0 there: facets mirror wo to below the surface.
    const float slightly[] = {0.98f, 0.0f, -0.199f};
    const smx_vectors slightly_below = SMX_PACKED(slightly);
    ASSERT_SMX_OK(smx_evaluator_pdf(e, 1, &slightly_below, &above, &out));
    EXPECT_GT(value[0], 0.0f);
}

TEST(Evaluator, SamplesCarryTheirDensityAndValue) {
    for (const Surface &s : surfaces())
        for (const int32_t order : {0, 2}) {
            const test::Directions d = directions_of(s, 300, 4);
            const test::Material material = material_of(s, SMX_MODEL_PER_LOBE);
            const Evaluator e = make_evaluator(material, s.x, nullptr, order);
            test::Random random(5);
            std::vector<float> u, wi(3 * d.count()), fcos(wi), pdf(d.count()), again_fcos(wi), again_pdf(pdf);
            for (std::size_t k = 0; k < wi.size(); ++k) u.push_back(static_cast<float>(random.uniform()));
            const smx_vectors uniform = from(u), wo = from(d.wo), drawn = from(wi);
            const smx_vectors_out to = into(wi), fcos_to = into(fcos), again_to = into(again_fcos);
            const smx_scalars_out pdf_to = {pdf.data(), 1}, again_pdf_to = {again_pdf.data(), 1};
            ASSERT_SMX_OK(smx_evaluator_sample(e, d.count(), &uniform, &wo, &to, &fcos_to, &pdf_to));
            ASSERT_SMX_OK(smx_evaluator_eval(e, d.count(), &drawn, &wo, &again_to));
            ASSERT_SMX_OK(smx_evaluator_pdf(e, d.count(), &drawn, &wo, &again_pdf_to));
            EXPECT_EQ(fcos, again_fcos);
            EXPECT_EQ(pdf, again_pdf);
            std::size_t above = 0;
            for (std::size_t k = 0; k < d.count(); ++k) {
                EXPECT_NEAR(oracle::dot(d.at(wi, k), d.at(wi, k)), 1.0, 1e-5);
                EXPECT_GT(pdf[k], 0.0f);
                above += wi[3 * k + 2] > 0.0f;
            }
            EXPECT_GT(above, d.count() / 2);

            // Either may be left out, and the directions are the same.
            std::vector<float> alone(wi.size());
            const smx_vectors_out alone_to = into(alone);
            ASSERT_SMX_OK(smx_evaluator_sample(e, d.count(), &uniform, &wo, &alone_to, nullptr, nullptr));
            EXPECT_EQ(alone, wi);
        }
}

namespace {

// Everything of a pair in one struct, as a renderer may have it.
struct Pair {
    float wi[3], unused, wo[3], fcos[3], pdf;
};

std::vector<Pair> evaluated_pairs(const Evaluator &e, const test::Directions &d) {
    std::vector<Pair> pairs(d.count());
    for (std::size_t k = 0; k < d.count(); ++k)
        for (std::size_t c = 0; c < 3; ++c)
            pairs[k] = Pair{{d.wi[3 * k], d.wi[3 * k + 1], d.wi[3 * k + 2]},
                            77.0f,
                            {d.wo[3 * k], d.wo[3 * k + 1], d.wo[3 * k + 2]},
                            {-1.0f, -1.0f, -1.0f},
                            -1.0f};
    const std::size_t stride = sizeof(Pair) / sizeof(float);
    Pair &p = pairs.front();
    const smx_vectors wi = {&p.wi[0], &p.wi[1], &p.wi[2], stride}, wo = {&p.wo[0], &p.wo[1], &p.wo[2], stride};
    const smx_vectors_out fcos = {&p.fcos[0], &p.fcos[1], &p.fcos[2], stride};
    const smx_scalars_out pdf = {&p.pdf, stride};
    EXPECT_SMX_OK(smx_evaluator_eval(e, d.count(), &wi, &wo, &fcos));
    EXPECT_SMX_OK(smx_evaluator_pdf(e, d.count(), &wi, &wo, &pdf));
    return pairs;
}

// The same from planes with room behind each.
void expect_planes_are(const std::vector<Pair> &pairs, const Evaluator &e) {
    const std::size_t count = pairs.size(), plane = count + 3;
    std::vector<float> wi(3 * plane, 0.5f), wo(wi), fcos(3 * plane, -7.0f);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) wi[c * plane + k] = pairs[k].wi[c], wo[c * plane + k] = pairs[k].wo[c];
    const smx_vectors i = SMX_PLANES(wi.data(), plane), o = SMX_PLANES(wo.data(), plane);
    const smx_vectors_out f = SMX_PLANES(fcos.data(), plane);
    ASSERT_SMX_OK(smx_evaluator_eval(e, count, &i, &o, &f));
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(fcos[c * plane + k], pairs[k].fcos[c]) << k << " " << c;
        for (std::size_t k = count; k < plane; ++k) EXPECT_EQ(fcos[c * plane + k], -7.0f) << "behind plane " << c;
    }
}

} // namespace

// The same bits from structs, planes and packed arrays, in place and copied, and nothing written beside.
TEST(Evaluator, ArraysMayLieAsTheyDo) {
    const Surface s = surfaces()[2];
    const test::Material material = material_of(s, SMX_MODEL_PER_LOBE);
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.copy_arrays = 1;
    test::Context copying;
    ASSERT_SMX_OK(smx_context_create(&options, copying.out()));
    const Evaluator in_place = make_evaluator(material, s.x), copied = make_evaluator(material, s.x, copying);
    for (const std::size_t count : {1u, 7u, 16u, 17u, 93u, 1000u}) {
        const test::Directions d = directions_of(s, count, 6);
        const std::vector<Pair> a = evaluated_pairs(in_place, d), b = evaluated_pairs(copied, d);
        std::vector<float> packed_fcos(3 * count);
        ASSERT_SMX_OK(smx_material_eval(test::context(), material, &s.x, SMX_G2_CORRELATED, nullptr, count, d.wi.data(),
                                        d.wo.data(), packed_fcos.data()));
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_GT(a[k].fcos[c], 0.0f);
                EXPECT_EQ(a[k].fcos[c], b[k].fcos[c]);
                EXPECT_EQ(a[k].fcos[c], packed_fcos[3 * k + c]);
                EXPECT_EQ(a[k].wi[c], d.wi[3 * k + c]);
                EXPECT_EQ(a[k].wo[c], d.wo[3 * k + c]);
            }
            EXPECT_EQ(a[k].pdf, b[k].pdf);
            EXPECT_EQ(a[k].unused, 77.0f);
            EXPECT_EQ(b[k].unused, 77.0f);
        }
        expect_planes_are(a, in_place);
        expect_planes_are(a, copied);
    }
}

// More than one launch takes.
TEST(Evaluator, TakesAnyNumberOfPairs) {
    const std::size_t count = (std::size_t{1} << 22) + 21, period = 97;
    const Surface s = surfaces()[0];
    const test::Material material = material_of(s, SMX_MODEL_SHARED);
    const Evaluator e = make_evaluator(material, s.x);
    const test::Directions d = directions_of(s, period, 8);
    std::vector<float> k(3 * count), sigma(count, -1.0f);
    for (std::size_t j = 0; j < k.size(); ++j) k[j] = d.wi[j % d.wi.size()];
    const smx_vectors directions = from(k);
    const smx_scalars_out out = {sigma.data(), 1};
    ASSERT_SMX_OK(smx_evaluator_sigma(e, count, &directions, &out));
    std::size_t wrong = 0;
    for (std::size_t j = period; j < count; ++j) wrong += sigma[j] != sigma[j - period];
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(sigma[0], 0.0f);

    // And none.
    EXPECT_SMX_OK(smx_evaluator_sigma(e, 0, &directions, &out));
}

TEST(Evaluator, OutlivesItsParents) {
    test::Context context;
    ASSERT_SMX_OK(smx_context_create(nullptr, context.out()));
    test::Material material = test::make_material({{1.0, 0.3}});
    const smx_displacement x = {0.2, 0.2, 0.0, 0.0, 0.0};
    const Evaluator e = make_evaluator(material, x, context);
    context = test::Context();
    material = test::Material();
    const float up[] = {0.0f, 0.0f, 1.0f};
    float fcos[3];
    const smx_vectors v = SMX_PACKED(up);
    const smx_vectors_out out = SMX_PACKED(fcos);
    ASSERT_SMX_OK(smx_evaluator_eval(e, 1, &v, &v, &out));
    EXPECT_NEAR(fcos[0], 1.0 / (4.0 * oracle::pi * (0.09 + 0.04)), 1e-5);
}
