// Many threads on one context, and on two: the bits are those of one thread, a thread that cancels stops itself alone.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <thread>

#include "support.h"

namespace {

constexpr std::size_t threads_at_once = 8, rounds = 3;

const smx_scene scene = test::make_scene(24, 24, test::radians(60.0), {0.25, 0.25, 0.0, 0.0, 0.0});

struct Shared {
    test::Brdf brdf;
    test::Material material = test::make_material({{0.5, 0.2}, {0.5, 0.6}});
    test::Handle<smx_evaluator, smx_evaluator_release> evaluator; // on test::context()

    Shared() {
        EXPECT_SMX_OK(smx_brdf_open("builtin:conductor", brdf.out()));
        EXPECT_SMX_OK(smx_evaluator_create(test::context(), material, &scene.displacement, SMX_G2_CORRELATED, nullptr,
                                           evaluator.out()));
    }
};

using Bits = std::vector<float>;
using Work = std::function<smx_status(smx_context, Bits &)>;

Bits bits_of(const test::Image &image) {
    const test::Pixels p = test::pixels(image);
    return {p.rgba, p.rgba + std::size_t{4} * p.width * p.height};
}

int count_calls(void *user, double) {
    ++*static_cast<std::atomic<int> *>(user);
    return 0;
}

smx_status filtered(const Shared &s, smx_context context, Bits &bits) {
    test::Image image;
    std::atomic<int> calls{0};
    smx_render_options options = test::make_options(1);
    options.progress = count_calls;
    options.progress_user = &calls;
    const smx_status status = smx_render_filtered(context, s.material, &scene, &options, image.out(), nullptr);
    if (status == SMX_OK) bits = bits_of(image);
    EXPECT_GT(calls, 0);
    return status;
}

smx_status reference(const Shared &s, smx_context context, Bits &bits) {
    test::Image image;
    const smx_render_options options = test::make_options(64);
    const smx_status status = smx_render_reference(context, s.brdf, &scene, &options, image.out(), nullptr);
    if (status == SMX_OK) bits = bits_of(image);
    return status;
}

smx_status geometric(const Shared &s, smx_context context, Bits &bits) {
    test::Image image;
    const smx_render_options options = test::make_options(4);
    smx_geometric_options paths = SMX_GEOMETRIC_OPTIONS_INIT;
    paths.tile = 64;
    paths.realisations = 2;
    paths.bounces = 1;
    const smx_status status = smx_render_geometric(context, s.brdf, &scene, &options, &paths, image.out(), nullptr);
    if (status == SMX_OK) bits = bits_of(image);
    return status;
}

smx_status evaluated(const Shared &s, smx_context context, Bits &bits) {
    const std::vector<float> wi{0.6f, 0.0f, 0.8f, 0.0f, 0.0f, 1.0f}, wo{0.0f, 0.0f, 1.0f, 0.0f, 0.6f, 0.8f};
    bits.assign(6, -1.0f);
    return smx_material_eval(context, s.material, &scene.displacement, SMX_G2_CORRELATED, nullptr, 2, wi.data(),
                             wo.data(), bits.data());
}

// By one evaluator for all threads, whatever their context.
smx_status drawn(const Shared &s, Bits &bits) {
    const std::vector<float> u{0.1f, 0.5f, 0.7f, 0.9f, 0.2f, 0.4f}, wo{0.0f, 0.0f, 1.0f, 0.0f, 0.6f, 0.8f};
    bits.assign(14, -1.0f);
    const smx_vectors numbers = SMX_PACKED(u.data()), view = SMX_PACKED(wo.data());
    const smx_vectors_out wi = SMX_PACKED(bits.data()), fcos = SMX_PACKED(bits.data() + 6);
    const smx_scalars_out pdf = {bits.data() + 12, 1};
    return smx_evaluator_sample(s.evaluator, 2, &numbers, &view, &wi, &fcos, &pdf);
}

smx_status geometry(smx_context context, Bits &bits) {
    test::Image image;
    const smx_status status = smx_render_geometry(context, &scene, nullptr, image.out(), nullptr);
    if (status == SMX_OK) bits = bits_of(image);
    return status;
}

smx_status cancelled(const Shared &s, smx_context context, Bits &bits) {
    smx_render_options options = test::make_options(4096);
    options.progress = [](void *, double) { return 1; };
    smx_image image = nullptr;
    bits.assign(1, 1.0f);
    const smx_status status = smx_render_reference(context, s.brdf, &scene, &options, &image, nullptr);
    return status == SMX_CANCELLED && image == nullptr ? SMX_OK : SMX_INTERNAL;
}

std::vector<Work> all_work(const Shared &s) {
    return {[&](smx_context c, Bits &b) { return filtered(s, c, b); },
            [&](smx_context c, Bits &b) { return reference(s, c, b); },
            [&](smx_context c, Bits &b) { return geometric(s, c, b); },
            [&](smx_context c, Bits &b) { return evaluated(s, c, b); },
            [&](smx_context, Bits &b) { return drawn(s, b); },
            [&](smx_context c, Bits &b) { return geometry(c, b); },
            [&](smx_context c, Bits &b) { return cancelled(s, c, b); }};
}

// Thread k begins with work k, and does all of it in turn; how many results were not the wanted ones.
std::size_t count_faults(const std::vector<Work> &work, const std::vector<Bits> &wanted,
                         const std::vector<smx_context> &contexts) {
    std::atomic<std::size_t> faults{0};
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < threads_at_once; ++k)
        threads.emplace_back([&, k] {
            for (std::size_t at = k; at < k + rounds * work.size(); ++at) {
                Bits bits;
                const smx_status status = work[at % work.size()](contexts[k % contexts.size()], bits);
                if (status != SMX_OK || bits != wanted[at % work.size()]) ++faults;
            }
        });
    for (std::thread &thread : threads) thread.join();
    return faults;
}

std::vector<Bits> alone(const std::vector<Work> &work) {
    std::vector<Bits> wanted(work.size());
    for (std::size_t k = 0; k < work.size(); ++k) EXPECT_SMX_OK(work[k](test::context(), wanted[k])) << "work " << k;
    return wanted;
}

} // namespace

TEST(Threads, EightOnOneContext) {
    const Shared shared;
    const std::vector<Work> work = all_work(shared);
    const std::vector<Bits> wanted = alone(work);
    EXPECT_EQ(count_faults(work, wanted, {test::context()}), 0u);
    // The count sees what is wrong.
    std::vector<Bits> wrong = wanted;
    wrong[0][0] += 1.0f;
    EXPECT_EQ(count_faults(work, wrong, {test::context()}), threads_at_once * rounds);
}

TEST(Threads, EightOnTwoContexts) {
    const Shared shared;
    const std::vector<Work> work = all_work(shared);
    test::Context other;
    ASSERT_SMX_OK(smx_context_create(nullptr, other.out()));
    EXPECT_EQ(count_faults(work, alone(work), {test::context(), other}), 0u);
}

// Handles are retained and released by many threads.
TEST(Threads, CountsOfReferencesHold) {
    const Shared shared;
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < threads_at_once; ++k)
        threads.emplace_back([&] {
            for (int round = 0; round < 1000; ++round) {
                EXPECT_EQ(smx_brdf_retain(shared.brdf), SMX_OK);
                EXPECT_EQ(smx_material_retain(shared.material), SMX_OK);
                smx_material_release(shared.material);
                smx_brdf_release(shared.brdf);
            }
        });
    for (std::thread &thread : threads) thread.join();
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    EXPECT_SMX_OK(smx_brdf_get_info(shared.brdf, &info));
}
