// Progress: shares that rise from 0 to 1 in the caller's thread, a stop that is obeyed, a report that adds up.
#include <gtest/gtest.h>

#include <thread>

#include "support.h"

namespace {

struct Watcher {
    std::vector<double> shares;
    std::thread::id thread;
    int stop_after = -1; // calls; -1: never
};

int watch(void *user, double share) {
    Watcher &w = *static_cast<Watcher *>(user);
    w.shares.push_back(share);
    w.thread = std::this_thread::get_id();
    return w.stop_after >= 0 && static_cast<int>(w.shares.size()) > w.stop_after;
}

smx_render_options watched(Watcher &w, uint32_t spp) {
    smx_render_options options = test::make_options(spp);
    options.progress = watch;
    options.progress_user = &w;
    return options;
}

void expect_shares(const Watcher &w) {
    ASSERT_FALSE(w.shares.empty());
    for (std::size_t k = 0; k < w.shares.size(); ++k) {
        EXPECT_GE(w.shares[k], k == 0 ? 0.0 : w.shares[k - 1]);
        EXPECT_LE(w.shares[k], 1.0);
    }
    EXPECT_EQ(w.thread, std::this_thread::get_id());
}

// Lit from the camera: every pixel on the sphere is evaluated.
const smx_scene scene = test::make_scene(64, 64, test::radians(90.0), {0.25, 0.25, 0.0, 0.0, 0.0});

test::Brdf open_builtin() {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open("builtin:conductor", b.out()));
    return b;
}

} // namespace

TEST(Progress, RisesInTheCallersThread) {
    Watcher w;
    const smx_render_options options = watched(w, 128 * 128);
    smx_scene large = scene;
    large.width = large.height = 128;
    test::Image image;
    ASSERT_SMX_OK(smx_render_reference(test::context(), open_builtin(), &large, &options, image.out(), nullptr));
    expect_shares(w);
    EXPECT_GT(w.shares.size(), 2u);
}

TEST(Progress, StopIsObeyedAtOnce) {
    for (const int stop_after : {0, 1}) {
        Watcher w;
        w.stop_after = stop_after;
        const smx_render_options options = watched(w, 4096);
        smx_image image = nullptr;
        smx_render_report report = SMX_RENDER_REPORT_INIT;
        report.seconds = -1.0;
        EXPECT_SMX_FAILS(SMX_CANCELLED, "",
                         smx_render_reference(test::context(), open_builtin(), &scene, &options, &image, &report));
        EXPECT_EQ(image, nullptr);
        EXPECT_EQ(report.seconds, -1.0);
        EXPECT_EQ(w.shares.size(), static_cast<std::size_t>(stop_after) + 1);
    }
}

// A context that was stopped renders the same afterwards.
TEST(Progress, StoppingLeavesTheContextSound) {
    const test::Brdf brdf = open_builtin();
    const test::Image before = test::render_reference(brdf, scene, test::make_options(256));
    Watcher w;
    w.stop_after = 0;
    const smx_render_options options = watched(w, 4096);
    smx_image none = nullptr;
    EXPECT_EQ(smx_render_reference(test::context(), brdf, &scene, &options, &none, nullptr), SMX_CANCELLED);
    EXPECT_EQ(test::relrmse(test::render_reference(brdf, scene, test::make_options(256)), before), 0.0);
}

TEST(Progress, EveryRendererListens) {
    const test::Material material = test::make_material({{1.0, 0.2}});
    for (const int stop_after : {-1, 0}) {
        const smx_status wanted = stop_after == 0 ? SMX_CANCELLED : SMX_OK;
        Watcher filtered, geometry;
        filtered.stop_after = geometry.stop_after = stop_after;
        smx_image image = nullptr;
        smx_render_options options = watched(filtered, 1);
        EXPECT_EQ(smx_render_filtered(test::context(), material, &scene, &options, &image, nullptr), wanted);
        expect_shares(filtered);
        smx_image_release(image);
        image = nullptr;
        options = watched(geometry, 1);
        EXPECT_EQ(smx_render_geometry(test::context(), &scene, &options, &image, nullptr), wanted);
        expect_shares(geometry);
        smx_image_release(image);
    }
}

TEST(Progress, ReportAddsUp) {
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const smx_render_options options = test::make_options(256);
    test::Image image;
    ASSERT_SMX_OK(smx_render_reference(test::context(), open_builtin(), &scene, &options, image.out(), &report));
    const test::Pixels p = test::pixels(image);
    uint64_t on_sphere = 0;
    for (uint32_t k = 0; k < 64 * 64; ++k) on_sphere += p.rgba[4 * k + 3] > 0.0f;
    EXPECT_EQ(report.evaluations, 256 * on_sphere);
    EXPECT_GT(report.kernel_seconds, 0.0);
    EXPECT_GE(report.seconds, report.kernel_seconds + report.build_seconds - 1e-3);
    // Kernels are kept: the second time nothing is built.
    ASSERT_SMX_OK(smx_render_reference(test::context(), open_builtin(), &scene, &options, image.out(), &report));
    EXPECT_EQ(report.build_seconds, 0.0);
}
