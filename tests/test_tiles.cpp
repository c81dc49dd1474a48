// One queue of tiles over all devices: the same bits whatever the tiling, the work-group or the number of devices; what
// fails or is cancelled leaves nothing behind; an image that goes to a file is the one that would be in memory.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <thread>

#include "builtin.h"
#include "error.h"
#include "files.h"
#include "integrate_reference.h"
#include "sampling_parts.h"
#include "shade_filtered.h"
#include "support.h"
#include "tile_queue.h"

namespace {

const smx_scene scene = test::make_scene(93, 71, test::radians(40.0), {0.3, 0.2, 0.4, 0.1, 0.0});

test::Context context_of(uint32_t sub_devices, const char *device = nullptr) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.device = device;
    options.sub_devices = sub_devices;
    test::Context c;
    EXPECT_SMX_OK(smx_context_create(&options, c.out()));
    return c;
}

uint32_t devices_of(smx_context context) {
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    EXPECT_SMX_OK(smx_context_get_info(context, &info));
    return info.devices;
}

uint32_t compute_units() {
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    EXPECT_SMX_OK(smx_context_get_info(test::context(), &info));
    return info.compute_units;
}

const test::Brdf &brdf() {
    static const test::Brdf b = [] {
        test::Brdf made;
        EXPECT_SMX_OK(smx_brdf_open("builtin:two-layer", made.out()));
        return made;
    }();
    return b;
}

smx_render_options options_of(smx_sampler sampler, double target = 0.0) {
    smx_render_options options = test::make_options(256, 3);
    options.sampler = sampler;
    options.target_error = target;
    options.errors = sampler != SMX_SAMPLER_GRID;
    return options;
}

struct Estimate {
    test::Image image;
    smx_render_report report = SMX_RENDER_REPORT_INIT;
};

Estimate render(smx_context context, const smx_render_options &options) {
    Estimate e;
    EXPECT_SMX_OK(smx_render_reference(context, brdf(), &scene, &options, e.image.out(), &e.report));
    return e;
}

bool same_bits(const float *a, const float *b, std::size_t count) {
    return (!a && !b) || (a && b && std::memcmp(a, b, count * sizeof(float)) == 0);
}

constexpr std::size_t values = std::size_t{4} * 93 * 71;

::testing::AssertionResult same_images(smx_image a, smx_image b) {
    if (!same_bits(smx_image_pixels(a), smx_image_pixels(b), values))
        return ::testing::AssertionFailure() << "pixels differ";
    if (!same_bits(smx_image_errors(a), smx_image_errors(b), values))
        return ::testing::AssertionFailure() << "errors differ";
    return ::testing::AssertionSuccess();
}

// Rows of a tile, work-items of a work-group, facets of a launch, as the library chooses them and otherwise.
const smx::Tiling tilings[] = {{0, 0, 0}, {1, 1, 256}, {7, 64, 512}, {70, 16, 1024}};

const smx::Scene inner_scene{93, 71, 0.7, {0.3, 0.2, 0.4, 0.1, 0.0}, smx::Masking::Correlated};

smx::RenderOptions inner_options(const smx::Tiling &tiling, std::uint32_t spp = 256) {
    smx::RenderOptions options;
    options.spp = spp;
    options.errors = true;
    options.tiling = tiling;
    return options;
}

const std::vector<smx::Lobe> &some_lobes(std::optional<double> = {}) {
    static const std::vector<smx::Lobe> lobes{{0.5, 0.05}, {0.5, 0.4}};
    return lobes;
}

// A job of `count` tiles of one row each whose work is `work`.
smx::TileJob job_of(std::uint32_t count, const smx::TileWork &work) {
    smx::TileJob job;
    for (std::uint32_t k = 0; k < count; ++k) job.tiles.push_back({k, 1});
    job.start = [work](smx::Context &) { return work; };
    job.take = [](const smx::Tile &) {};
    job.ahead = count;
    return job;
}

int stop_in_the_middle(void *, double share) { return share > 0.3; }

} // namespace

TEST(Tiles, DevicesShareOneImage) {
    ASSERT_GT(compute_units(), 1u) << "one compute unit cannot be cut";
    const test::Context two = context_of(2);
    EXPECT_EQ(devices_of(test::context()), 1u);
    EXPECT_EQ(devices_of(two), 2u);
    EXPECT_EQ(devices_of(context_of(0, "0,0")), 2u);
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_SOBOL, SMX_SAMPLER_MIS})
        for (const int whole : {0, 1}) {
            smx_render_options options = options_of(sampler);
            options.whole_table = whole;
            const Estimate a = render(test::context(), options), b = render(two, options);
            EXPECT_TRUE(same_images(a.image, b.image)) << "sampler " << sampler << ", whole table " << whole;
            EXPECT_EQ(a.report.standard_error, b.report.standard_error);
            EXPECT_EQ(a.report.evaluations, b.report.evaluations);
            EXPECT_GT(b.report.kernel_seconds, 0.0);
        }
    const Estimate a = render(test::context(), options_of(SMX_SAMPLER_MIS, 0.01)),
                   b = render(two, options_of(SMX_SAMPLER_MIS, 0.01));
    EXPECT_TRUE(same_images(a.image, b.image));
    EXPECT_EQ(a.report.spp, b.report.spp);

    const test::Material material = test::make_material({{0.3, 0.02}, {0.7, 0.3}});
    EXPECT_TRUE(same_images(test::render_filtered(material, scene), test::render_filtered(material, scene, two)));
    test::Image one_geometry, two_geometry;
    ASSERT_SMX_OK(smx_render_geometry(test::context(), &scene, nullptr, one_geometry.out(), nullptr));
    ASSERT_SMX_OK(smx_render_geometry(two, &scene, nullptr, two_geometry.out(), nullptr));
    EXPECT_TRUE(same_images(one_geometry, two_geometry));
}

TEST(Tiles, TilingsAndWorkGroupsGiveTheSameBits) {
    smx::Context context("", 0);
    const smx::Brdf table = smx::make_builtin("two-layer");
    const auto reference = [&](const smx::Tiling &tiling, std::uint32_t spp) {
        return *smx::integrate_reference(context, table, some_lobes, inner_scene, inner_options(tiling, spp)).image;
    };
    smx::Material material;
    material.lobes = some_lobes();
    material.theta_d = {0.0, 1.5707963267948966};
    material.fresnel = {{{{1.0, 0.5}, {0.5, 0.5}, {0.2, 0.1}}}};
    const smx::Simulated all = smx::everything(material, smx::all_effects, inner_scene.masking);
    const auto filtered = [&](const smx::Tiling &tiling) {
        return *smx::shade_filtered(context, material, inner_scene, inner_options(tiling), all).image;
    };
    const smx::Image b = filtered(tilings[0]);
    for (const smx::Tiling &tiling : tilings)
        EXPECT_TRUE(same_bits(b.rgba.data(), filtered(tiling).rgba.data(), values)) << tiling.rows;

    // Scrambles of 4, 16 and 640 facets by a technique: several in a vector, several in a launch, one in several.
    for (const std::uint32_t spp : {64u, 256u, 10240u}) {
        const smx::Image a = reference(tilings[0], spp);
        ASSERT_EQ(a.errors.size(), values);
        for (const smx::Tiling &tiling : tilings) {
            const smx::Image other = reference(tiling, spp);
            EXPECT_TRUE(same_bits(a.rgba.data(), other.rgba.data(), values)) << tiling.rows << " " << spp;
            EXPECT_TRUE(same_bits(a.errors.data(), other.errors.data(), values)) << tiling.rows << " " << spp;
            EXPECT_EQ(a.attributes.at("slopemix.standard_error"), other.attributes.at("slopemix.standard_error"));
        }
    }
}

// Every facet of every scramble once, in parts of whole vectors that no buffer is too small for.
TEST(Tiles, PartsAreAllOfTheSamples) {
    const smx::Displacement x{0.3, 0.2, 0.0, 0.0, 0.0};
    for (const smx::Sampler sampler : {smx::Sampler::Grid, smx::Sampler::Sobol, smx::Sampler::Mis})
        for (const std::uint32_t spp : {4u, 16u, 64u, 144u, 1024u, 65536u, 1u << 20})
            for (const std::size_t items : {std::size_t{1}, std::size_t{4096}, std::size_t{1} << 18})
                for (const std::uint32_t lanes : {1u, 4u, 16u}) {
                    const smx::SamplingPlan plan = smx::sampling_plan(x, sampler, spp, spp > 1000 ? 64 : 8);
                    const auto together = static_cast<std::int32_t>(smx::scrambles_per_vector(plan, lanes));
                    std::uint64_t facets = 0;
                    std::int32_t scramble = 0, first = 0;
                    const std::vector<smx::Part> parts = smx::sampling_parts(plan, items, lanes);
                    for (const smx::Part &part : parts) {
                        EXPECT_EQ(part.scramble, scramble);
                        EXPECT_EQ(part.first, first);
                        EXPECT_EQ(part.scrambles % together, 0);
                        EXPECT_EQ(part.slots * together % static_cast<std::int32_t>(lanes), 0);
                        EXPECT_GE(part.slots, part.size);
                        EXPECT_EQ(part.is_last(), &part == &parts.back());
                        facets += static_cast<std::uint64_t>(part.scrambles) * static_cast<std::uint32_t>(part.size);
                        const bool whole = part.first + part.size == part.all_facets;
                        EXPECT_TRUE(whole || part.scrambles == 1);
                        scramble += whole ? part.scrambles : 0;
                        first = whole ? 0 : first + part.size;
                    }
                    EXPECT_EQ(facets * plan.passes.size(), plan.samples()) << spp << " " << items << " " << lanes;
                }
}

TEST(Tiles, AreTakenInTheirOrderAndNotFarAhead) {
    smx::Context context("0,0,0", 0);
    std::atomic<std::uint32_t> begun{0}, taken{0};
    std::array<std::atomic<bool>, 40> done{};
    std::uint32_t most_ahead = 0;
    smx::TileJob job = job_of(40, [&](const smx::Tile &tile, const smx::Step &) {
        ++begun;
        if (tile.first_row % 3 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        done[tile.first_row] = true;
        return 1.0;
    });
    job.ahead = 4;
    job.take = [&](const smx::Tile &tile) {
        EXPECT_EQ(tile.first_row, taken);
        EXPECT_TRUE(done[tile.first_row]);
        most_ahead = std::max(most_ahead, begun - taken);
        ++taken;
    };
    EXPECT_GE(smx::run_tiles(context, job), 40.0 / 3.0);
    EXPECT_EQ(taken, 40u);
    EXPECT_LE(most_ahead, 4u);
}

TEST(Tiles, TheFirstFailureEndsTheJob) {
    smx::Context context("0,0", 0);
    std::atomic<int> begun{0};
    const smx::TileJob job = job_of(1000, [&](const smx::Tile &tile, const smx::Step &) -> double {
        ++begun;
        if (tile.first_row == 5) smx::fail(smx::Fault::DeviceError, "tile five");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return 0.0;
    });
    try {
        smx::run_tiles(context, job);
        FAIL() << "nothing was thrown";
    } catch (const smx::Error &error) {
        EXPECT_STREQ(error.what(), "tile five");
    }
    EXPECT_LT(begun, 500);
}

TEST(Tiles, CoverEveryRowOnce) {
    for (const std::uint32_t rows : {1u, 7u, 93u, 16384u})
        for (const std::uint32_t items : {1u, 257u, 16384u})
            for (const std::size_t devices : {1u, 2u, 5u}) {
                std::uint32_t next = 0;
                for (const smx::Tile &tile : smx::tiles_of(rows, items, devices, {})) {
                    EXPECT_EQ(tile.first_row, next);
                    EXPECT_GT(tile.rows, 0u);
                    EXPECT_LE(std::uint64_t{tile.rows} * items, 1u << 18);
                    next += tile.rows;
                }
                EXPECT_EQ(next, rows);
            }
}

TEST(Tiles, FilesHoldWhatMemoryWould) {
    const test::TempDir dir;
    const test::Context two = context_of(2);
    for (const smx_sampler sampler : {SMX_SAMPLER_GRID, SMX_SAMPLER_MIS}) {
        const std::string path = dir / "streamed.exr";
        smx_render_options options = options_of(sampler, sampler == SMX_SAMPLER_MIS ? 0.02 : 0.0);
        const Estimate wanted = render(test::context(), options);
        options.exr_path = path.c_str();
        smx_render_report report = SMX_RENDER_REPORT_INIT;
        ASSERT_SMX_OK(smx_render_reference(two, brdf(), &scene, &options, nullptr, &report));
        test::Image image;
        ASSERT_SMX_OK(smx_image_read_exr(path.c_str(), image.out()));
        EXPECT_TRUE(same_images(image, wanted.image));
        EXPECT_EQ(report.standard_error, wanted.report.standard_error);
        EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.spp"), std::to_string(report.spp).c_str());
    }
    EXPECT_EQ(dir.names(), std::vector<std::string>{"streamed.exr"});
}

TEST(Tiles, CancelledFilesLeaveNothing) {
    const test::TempDir dir;
    const std::string path = dir / "kept.exr", absent = dir / "absent/a.exr";
    test::write_file(path, "precious");
    const test::Context two = context_of(2);
    const test::Material material = test::make_material({{1.0, 0.2}});
    smx_scene large = scene;
    large.width = large.height = 2048;
    smx_render_options options = options_of(SMX_SAMPLER_MIS);
    options.progress = stop_in_the_middle;
    options.exr_path = path.c_str();
    EXPECT_SMX_FAILS(SMX_CANCELLED, "", smx_render_filtered(two, material, &large, &options, nullptr, nullptr));
    EXPECT_SMX_FAILS(SMX_CANCELLED, "", smx_render_reference(two, brdf(), &scene, &options, nullptr, nullptr));
    EXPECT_EQ(test::read_file(path), "precious");
    options.progress = nullptr;
    options.exr_path = absent.c_str();
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "absent/a.exr",
                     smx_render_filtered(two, material, &large, &options, nullptr, nullptr));
    options.exr_path = path.c_str();
    {
        const test::FileSizeLimit full(4096);
        EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.exr",
                         smx_render_filtered(two, material, &large, &options, nullptr, nullptr));
    }
    EXPECT_EQ(test::read_file(path), "precious");
    EXPECT_EQ(dir.names(), std::vector<std::string>{"kept.exr"});

    // The devices that were stopped render the same afterwards.
    const smx_render_options again = options_of(SMX_SAMPLER_MIS);
    EXPECT_TRUE(same_images(render(two, again).image, render(test::context(), again).image));
}

TEST(Tiles, DevicesThatAreNotThereAreRefused) {
    smx_context context = nullptr;
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.sub_devices = compute_units() + 1;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "sub_devices is " + std::to_string(options.sub_devices),
                     smx_context_create(&options, &context));
    options.sub_devices = 0;
    for (const char *list : {",", "0,", ",0", "0,,0"}) {
        options.device = list;
        EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "commas", smx_context_create(&options, &context));
    }
    options.device = "0,99";
    EXPECT_SMX_FAILS(SMX_NO_DEVICE, "no device 99", smx_context_create(&options, &context));
    EXPECT_EQ(context, nullptr);
}
