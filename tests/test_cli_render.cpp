// slopemix info, render and compare: images, their attributes, the devices and kernels that are not there.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments render(const std::string &integrator, const std::string &input, const std::string &out) {
    return {"render",  input, "--integrator", integrator, "--alpha", "0.25,0",
            "--light", "0",   "--res",        "24x16",    "--out",   out};
}

Arguments reference(const std::string &out) {
    return test::with(render("reference", "builtin:conductor", out), {"--spp", "64"});
}

test::Image read(const std::string &path) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_read_exr(path.c_str(), image.out()));
    return image;
}

// PoCL builds kernels anew where its cache is empty.
test::CliSetting fresh_kernels(const test::TempDir &dir) { return {{{"POCL_CACHE_DIR", dir.path()}}, 0}; }

} // namespace

TEST(CliRender, InfoListsDevices) {
    const test::CliResult text = test::cli({"info"}), run = test::cli({"info", "--json"});
    ASSERT_CLI_OK(text);
    ASSERT_CLI_OK(run);
    const json info = run.json();
    EXPECT_EQ(info.at("version"), SMX_VERSION_STRING);
    ASSERT_GE(info.at("devices").size(), 1u);
    int defaults = 0;
    for (const json &device : info.at("devices")) {
        EXPECT_NE(text.out.find(device.at("name").get<std::string>()), std::string::npos);
        defaults += device.at("default").get<bool>();
    }
    EXPECT_EQ(defaults, 1);
    EXPECT_GT(info.at("build_seconds").get<double>(), 0.0);
    EXPECT_GT(info.at("run_seconds").get<double>(), 0.0);
}

TEST(CliRender, BothIntegratorsWriteImages) {
    const test::TempDir dir;
    for (const char *integrator : {"filtered", "reference"}) {
        const std::string out = dir / (std::string(integrator) + ".exr");
        Arguments arguments = render(integrator, "builtin:conductor", out);
        if (std::string(integrator) == "reference") arguments = test::with(arguments, {"--spp", "64"});
        const test::CliResult run = test::cli(test::with(arguments, {"--png", "--json"}));
        ASSERT_CLI_OK(run);
        const json report = run.json();
        EXPECT_EQ(report.at("integrator"), integrator);
        EXPECT_EQ(report.at("out"), out);
        EXPECT_GT(report.at("seconds").get<double>(), 0.0);
        const test::Image image = read(out);
        const test::Pixels p = test::pixels(image);
        EXPECT_EQ(p.width, 24u);
        EXPECT_EQ(p.height, 16u);
        EXPECT_EQ(p.at(0, 0)[3], 0.0f);
        EXPECT_EQ(p.at(12, 8)[3], 1.0f);
        EXPECT_GT(p.at(16, 8)[1], 0.0f);
        EXPECT_STREQ(smx_image_get_attribute(image, "slopemix.integrator"), integrator);
    }
    EXPECT_EQ(dir.names(), (Arguments{"filtered.exr", "filtered.png", "reference.exr", "reference.png"}));
    EXPECT_EQ(test::read_file(dir / "filtered.png").substr(1, 3), "PNG");
}

TEST(CliRender, WideningOrdersAreReported) {
    const test::TempDir dir;
    const auto widened = [&](const Arguments &more) {
        return test::cli(
            test::with(render("filtered", "builtin:two-layer", dir / "a.exr"), test::with(more, {"--json"})));
    };
    const test::CliResult fixed = widened({"--widening-order", "2", "--widening-tolerance", "0.1"});
    ASSERT_CLI_OK(fixed);
    const json report = fixed.json();
    EXPECT_EQ(report.at("widening_order"), 2);
    EXPECT_TRUE(report.at("widening_tolerance").is_null());
    ASSERT_GT(report.at("lobes").get<std::size_t>(), 1u);
    EXPECT_EQ(report.at("widening_orders"), json(std::vector<int>(report.at("lobes").get<std::size_t>(), 2)));
    EXPECT_TRUE(report.at("unsettled").is_number());
    const std::string note = "note: --widening-tolerance has no effect";
    EXPECT_NE(fixed.err.find(note), std::string::npos) << fixed.err;

    const test::CliResult chosen = widened({"--widening-order", "auto", "--widening-tolerance", "0.1"});
    ASSERT_CLI_OK(chosen);
    EXPECT_EQ(chosen.json().at("widening_order"), "auto");
    EXPECT_EQ(chosen.json().at("widening_tolerance").get<double>(), 0.1);
    EXPECT_EQ(chosen.err.find(note), std::string::npos) << chosen.err;
}

TEST(CliRender, GradesAreReported) {
    const test::TempDir dir;
    for (const std::string grade : {"fast", "precise"}) {
        const test::CliResult run = test::cli(
            test::with(render("filtered", "builtin:two-layer", dir / (grade + ".exr")), {"--grade", grade, "--json"}));
        ASSERT_CLI_OK(run);
        EXPECT_EQ(run.json().at("grade"), grade);
    }
    const double difference = test::relrmse(read(dir / "fast.exr"), read(dir / "precise.exr"));
    EXPECT_GT(difference, 0.0);
    EXPECT_LT(difference, 1e-3);
    EXPECT_CLI_FAILS(2, "double", test::with(render("filtered", "builtin:two-layer", dir / "a.exr"), {"--grade", "x"}));
}

// The same question through the API has the same bits.
TEST(CliRender, ImageIsTheApis) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(
        test::with(reference(dir / "a.exr"), {"--seed", "5", "--g", "separable", "--rho", "0.5", "--mean-slope",
                                              "0.1,-0.2", "--lookup", "nearest", "--sampler", "grid"})));
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:conductor", brdf.out()));
    const smx_scene scene = test::make_scene(24, 16, 0.0, {0.25, 0.0, 0.5, 0.1, -0.2}, SMX_G2_SEPARABLE);
    const test::Image wanted = test::render_reference(brdf, scene, test::make_options(64, 5, SMX_LOOKUP_NEAREST));
    EXPECT_EQ(test::relrmse(read(dir / "a.exr"), wanted), 0.0);
}

TEST(CliRender, MaterialFilesRender) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli({"fit", "builtin:conductor", "--out", dir.path(), "--lobes", "2"}));
    ASSERT_CLI_OK(test::cli(render("filtered", dir / "conductor.json", dir / "file.exr")));
    ASSERT_CLI_OK(test::cli(test::with(render("filtered", "builtin:conductor", dir / "fit.exr"), {"--lobes", "2"})));
    EXPECT_EQ(test::relrmse(read(dir / "file.exr"), read(dir / "fit.exr")), 0.0);
    EXPECT_CLI_FAILS(2, "conductor.json", render("reference", dir / "conductor.json", dir / "x.exr"));
    test::write_file(dir / "bad.json", "{\"version\": 99}");
    EXPECT_CLI_FAILS(1, "bad.json", render("filtered", dir / "bad.json", dir / "x.exr"));
    EXPECT_FALSE(test::exists(dir / "x.exr"));
}

TEST(CliRender, ErrorsAreChannels) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(reference(dir / "plain.exr")));
    ASSERT_CLI_OK(test::cli(test::with(reference(dir / "errors.exr"), {"--errors"})));
    const test::Image plain = read(dir / "plain.exr"), with = read(dir / "errors.exr");
    EXPECT_EQ(smx_image_errors(plain), nullptr);
    ASSERT_NE(smx_image_errors(with), nullptr);
    EXPECT_EQ(test::relrmse(with, plain), 0.0);
    const std::size_t middle = 4 * (8 * 24 + 16);
    EXPECT_GT(smx_image_errors(with)[middle], 0.0f);
    EXPECT_LT(smx_image_errors(with)[middle], smx_image_pixels(with)[middle]);
    ASSERT_CLI_OK(test::cli({"compare", dir / "errors.exr", dir / "plain.exr"}));
    EXPECT_CLI_FAILS(2, "--errors", test::with(reference(dir / "x.exr"), {"--errors", "--sampler", "grid"}));
    EXPECT_CLI_FAILS(2, "16",
                     test::with(render("reference", "builtin:conductor", dir / "x.exr"), {"--errors", "--spp", "100"}));
    EXPECT_FALSE(test::exists(dir / "x.exr"));
}

TEST(CliRender, SubDevicesWorkTogether) {
    const test::TempDir dir;
    const test::CliResult one = test::cli(test::with(reference(dir / "one.exr"), {"--json"}));
    ASSERT_CLI_OK(one);
    EXPECT_EQ(one.json().at("devices"), 1);
    const test::CliResult two = test::cli(test::with(reference(dir / "two.exr"), {"--json", "--sub-devices", "2"}));
    ASSERT_CLI_OK(two);
    EXPECT_EQ(two.json().at("devices"), 2);
    EXPECT_EQ(test::read_file(dir / "one.exr"), test::read_file(dir / "two.exr"));
    EXPECT_CLI_FAILS(1, "sub_devices is 9999", test::with(reference(dir / "x.exr"), {"--sub-devices", "9999"}));
    EXPECT_CLI_FAILS(1, "no device 77", test::with(reference(dir / "x.exr"), {"--device", "0,77"}));
}

// Peak memory of the largest process that this one has waited for, in bytes.
std::size_t peak_memory_of_children() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

// An image that takes more memory than the process, a compiler's included where no kernel is cached yet.
TEST(CliRender, LargeImagesAreStreamed) {
    constexpr std::size_t side = 6144, image_bytes = side * side * 16;
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli({"fit", "builtin:conductor", "--out", dir.path(), "--lobes", "1", "--model", "shared"}));
    Arguments arguments =
        test::replaced(render("filtered", dir / "conductor.json", dir / "large.exr"), "--res", std::to_string(side));
    ASSERT_CLI_OK(test::cli(arguments));
#ifndef __SANITIZE_ADDRESS__ // which has shadows of what is used, and keeps what was
    EXPECT_LT(peak_memory_of_children(), image_bytes);
#endif
    EXPECT_EQ(test::pixels(read(dir / "large.exr")).width, side);

    // A signal in the middle leaves nothing.
    arguments.back() = dir / "cut.exr";
    const test::CliSetting interrupted = {{}, 0, SIGINT, [&] { return dir.names().size() > 4; }};
    EXPECT_NE(test::cli(arguments, interrupted).status, 0);
    EXPECT_EQ(dir.names(), (Arguments{"conductor.json", "fits.csv", "fits.json", "large.exr"}));
}

TEST(CliRender, CompareReports) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(render("filtered", "builtin:conductor", dir / "a.exr")));
    ASSERT_CLI_OK(test::cli(reference(dir / "b.exr")));
    const test::CliResult run = test::cli({"compare", dir / "a.exr", dir / "b.exr", "--json"});
    ASSERT_CLI_OK(run);
    smx_comparison wanted = SMX_COMPARISON_INIT;
    ASSERT_SMX_OK(smx_image_compare(read(dir / "a.exr"), read(dir / "b.exr"), &wanted));
    const json got = run.json();
    EXPECT_CLOSE(got.at("relrmse").get<double>(), wanted.relrmse, 1e-12, 0.0);
    EXPECT_CLOSE(got.at("rmse").get<double>(), wanted.rmse, 1e-12, 0.0);
    EXPECT_CLOSE(got.at("max_error").get<double>(), wanted.max_error, 1e-12, 0.0);
    EXPECT_CLOSE(got.at("bias").get<double>(), wanted.bias, 1e-12, 0.0);
    EXPECT_EQ(got.at("pixels"), wanted.pixels);
    ASSERT_CLI_OK(test::cli({"compare", dir / "a.exr", dir / "b.exr"}));
    Arguments other = test::replaced(render("filtered", "builtin:conductor", dir / "c.exr"), "--res", "8");
    ASSERT_CLI_OK(test::cli(other));
    EXPECT_CLI_FAILS(1, "24", {"compare", dir / "a.exr", dir / "c.exr"});
}

TEST(CliRender, NoDeviceIsSaid) {
    const test::TempDir dir;
    test::write_file(dir / "a.exr", "precious");
    const test::CliSetting no_device{{{"OCL_ICD_VENDORS", dir / "no-vendors"}}, 0};
    EXPECT_CLI_FAILS(1, "no OpenCL device", reference(dir / "a.exr"), no_device);
    EXPECT_CLI_FAILS(1, "no such device", test::with(reference(dir / "a.exr"), {"--device", "no such device"}));
    EXPECT_EQ(test::read_file(dir / "a.exr"), "precious");
    const test::CliResult info = test::cli({"info", "--json"}, no_device);
    ASSERT_CLI_OK(info);
    EXPECT_TRUE(info.json().at("devices").empty());
}

// PoCL adds the variable's flags to every build; this one makes the compiler fail.
TEST(CliRender, KernelsThatDoNotBuildShowTheLog) {
    const test::TempDir dir, cache;
    test::write_file(dir / "a.exr", "precious");
    test::CliSetting broken = fresh_kernels(cache);
    broken.environment.emplace_back("POCL_EXTRA_BUILD_FLAGS", "-Dfloat=no_such_type");
    EXPECT_CLI_FAILS(1, "no_such_type", reference(dir / "a.exr"), broken);
    EXPECT_EQ(test::read_file(dir / "a.exr"), "precious");
    EXPECT_EQ(dir.names(), Arguments{"a.exr"});
}

TEST(CliRender, FailedWritesKeepWhatWasThere) {
    const test::TempDir dir;
    const Arguments large = test::replaced(render("filtered", "builtin:conductor", dir / "a.exr"), "--res", "1024");
    ASSERT_CLI_OK(test::cli(large));
    const std::string before = test::read_file(dir / "a.exr");
    ASSERT_GT(before.size(), std::size_t{1} << 21);
    // Room for the device's compiler, which writes files too, but not for the image.
    EXPECT_CLI_FAILS(1, "a.exr", test::replaced(large, "--light", "30"), {{}, before.size() / 2});
    EXPECT_EQ(test::read_file(dir / "a.exr"), before);
    EXPECT_CLI_FAILS(1, "a.exr", reference(dir / "a.exr/b.exr"));
    std::filesystem::create_directory(dir / "folder.exr");
    EXPECT_CLI_FAILS(1, "folder.exr", reference(dir / "folder.exr"));
    EXPECT_EQ(dir.names(), (Arguments{"a.exr", "folder.exr"}));
}
