// slopemix sheet: 90 images, the contact sheet and sheet.json with the fields that are promised.
#include <gtest/gtest.h>

#include <png.h>

#include <cstring>
#include <map>
#include <set>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

Arguments sheet(const std::string &out) {
    return {"sheet", "builtin:two-layer", "--out", out, "--res", "16", "--spp", "16"};
}

// Some images of a sheet, and the sheet of these; what --collect said.
test::CliResult part(const Arguments &arguments) {
    const test::CliResult images = test::cli(arguments);
    return images.status == 0 ? test::cli(test::with(arguments, {"--collect"})) : images;
}

test::Image read(const std::string &path) {
    test::Image image;
    EXPECT_SMX_OK(smx_image_read_exr(path.c_str(), image.out()));
    return image;
}

constexpr std::array<double, 3> radii{0.1, 0.25, 0.5}, lights{90.0, 0.0, -25.0};

// What the page of the experiment says of table t, row r, column c.
void expect_documented(const json &image, int t, int r, int c) {
    const double radius = radii[static_cast<std::size_t>(r - 1)];
    EXPECT_EQ(image.at("column"), c);
    EXPECT_EQ(image.at("alpha_x").get<double>(), t == 3 ? 0.0 : radius);
    EXPECT_EQ(image.at("alpha_y").get<double>(), t == 2 ? 0.0 : radius);
    EXPECT_TRUE(image.at("seconds").is_number());
    const int kind = c == 1 ? -1 : (c - 2) % 3;
    EXPECT_EQ(image.at("integrator"), kind < 0 ? "geometry" : kind == 0 ? "reference" : "filtered");
    if (kind >= 0) {
        EXPECT_EQ(image.at("light_phi_deg").get<double>(), lights[static_cast<std::size_t>(c - 2) / 3]);
    }
    if (kind == 0) {
        EXPECT_EQ(image.at("spp"), 16);
    }
    if (kind > 0) {
        EXPECT_EQ(image.at("lobes"), kind == 1 ? 1 : 8);
        EXPECT_TRUE(image.at("model").is_string());
        for (const char *error : {"relrmse", "max_error", "bias"})
            EXPECT_GT(image.at(error).get<double>(), 0.0) << error;
    }
}

std::vector<std::string> all_files() {
    std::set<std::string> names{"sheet.json", "sheet.png"};
    for (int t = 1; t <= 3; ++t)
        for (int r = 1; r <= 3; ++r)
            for (int c = 1; c <= 10; ++c)
                names.insert(std::to_string(t) + "." + std::to_string(r) + "." + std::to_string(c) + ".exr");
    return {names.begin(), names.end()};
}

} // namespace

TEST(CliSheet, NinetyImagesAndWhatTheyAre) {
    const test::TempDir dir;
    ASSERT_CLI_OK(test::cli(sheet(dir.path())));
    EXPECT_EQ(dir.names(), all_files());
    const json document = json::parse(test::read_file(dir / "sheet.json"));
    EXPECT_EQ(document.at("material"), "two-layer");
    ASSERT_EQ(document.at("images").size(), 90u);
    std::set<std::string> ids;
    for (const json &image : document.at("images")) {
        const std::string id = image.at("id");
        ids.insert(id);
        int t = 0, r = 0, c = 0;
        ASSERT_EQ(std::sscanf(id.c_str(), "%d.%d.%d", &t, &r, &c), 3);
        SCOPED_TRACE(id);
        expect_documented(image, t, r, c);
        test::pixels(read(dir / (id + ".exr")));
    }
    EXPECT_EQ(ids.size(), 90u);
}

// The errors in sheet.json are those of the images beside it.
TEST(CliSheet, ErrorsAreThoseOfTheImages) {
    const test::TempDir dir;
    ASSERT_CLI_OK(part(test::with(sheet(dir.path()), {"--only", "1.2.5,1.2.6,1.2.7"})));
    const json document = json::parse(test::read_file(dir / "sheet.json"));
    ASSERT_EQ(document.at("images").size(), 3u);
    for (const json &image : document.at("images")) {
        if (image.at("integrator") != "filtered") continue;
        smx_comparison wanted = SMX_COMPARISON_INIT;
        ASSERT_SMX_OK(smx_image_compare(read(dir / (image.at("id").get<std::string>() + ".exr")),
                                        read(dir / "1.2.5.exr"), &wanted));
        EXPECT_CLOSE(image.at("relrmse").get<double>(), wanted.relrmse, 1e-6, 0.0);
        EXPECT_CLOSE(image.at("max_error").get<double>(), wanted.max_error, 1e-6, 0.0);
        EXPECT_CLOSE(image.at("bias").get<double>(), wanted.bias, 1e-6, 0.0);
    }
}

TEST(CliSheet, ContactSheetIsAPicture) {
    const test::TempDir dir;
    ASSERT_CLI_OK(part(test::with(sheet(dir.path()), {"--only", "1.1.1,1.1.2"})));
    png_image png;
    std::memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    ASSERT_NE(png_image_begin_read_from_file(&png, (dir / "sheet.png").c_str()), 0) << png.message;
    EXPECT_GT(png.width, 32u);
    EXPECT_GT(png.height, 16u);
    png_image_free(&png);
}

TEST(CliSheet, RadiiAndLobesAreTheCallers) {
    const test::TempDir dir;
    const Arguments chosen{"--radii", "0.3", "--lobes", "2", "--only", "2.1.2,2.1.3,3.1.1"};
    const test::CliResult run = part(test::with(sheet(dir.path()), test::with(chosen, {"--json"})));
    ASSERT_CLI_OK(run);
    const json images = run.json().at("images");
    ASSERT_EQ(images.size(), 3u);
    EXPECT_EQ(images[1].at("alpha_x").get<double>(), 0.3);
    EXPECT_EQ(images[1].at("alpha_y").get<double>(), 0.0);
    EXPECT_EQ(images[1].at("lobes"), 2);
    EXPECT_GT(images[1].at("relrmse").get<double>(), 0.0);
    EXPECT_EQ(run.json(), json::parse(test::read_file(dir / "sheet.json")));
}

// Three columns per order behind the ten of the shared model, the closed form first.
TEST(CliSheet, WideningOrdersAreColumns) {
    const test::TempDir dir;
    const Arguments chosen{
        "--radii", "0.5", "--widening-order", "1,0,auto", "--only", "1.1.2,1.1.4,1.1.11,1.1.14,1.1.17", "--json"};
    const test::CliResult run = part(test::replaced(test::with(sheet(dir.path()), chosen), "--spp", "1024"));
    ASSERT_CLI_OK(run);
    const json document = run.json();
    EXPECT_EQ(document.at("model"), "both");
    EXPECT_EQ(document.at("per_lobe_orders"), json::parse(R"([0, 1, "auto"])"));
    EXPECT_EQ(document.at("widening_tolerance").get<double>(), 0.02);
    const json &images = document.at("images");
    ASSERT_EQ(images.size(), 5u);
    EXPECT_TRUE(images[0].at("widening_order").is_null());
    EXPECT_TRUE(images[0].at("widening_orders").is_null());
    EXPECT_TRUE(images[0].at("unsettled").is_null());
    EXPECT_EQ(images[1].at("model"), "shared");
    EXPECT_EQ(images[1].at("widening_order"), 0);

    std::map<std::string, std::size_t> fitted;
    for (const json &fit : document.at("fits")) fitted[fit.at("model")] = fit.at("fitted_lobes");
    std::vector<double> errors;
    for (const auto &[k, word] : {std::pair{2, "0"}, {3, "1"}, {4, "auto"}}) {
        SCOPED_TRACE(word);
        const json &image = images[static_cast<std::size_t>(k)];
        EXPECT_EQ(image.at("column"), 11 + 3 * (k - 2));
        EXPECT_EQ(image.at("model"), "per-lobe");
        EXPECT_EQ(image.at("light_phi_deg").get<double>(), 90.0);
        EXPECT_EQ(image.at("widening_order"), k == 4 ? json("auto") : json(k - 2));
        ASSERT_EQ(image.at("widening_orders").size(), fitted.at("per-lobe"));
        for (const json &order : image.at("widening_orders")) {
            EXPECT_TRUE(k == 4 || order == k - 2) << order;
        }
        EXPECT_GE(image.at("unsettled").get<double>(), 0.0);
        EXPECT_LE(image.at("unsettled").get<double>(), 1.0);
        const test::Image exr = read(dir / (image.at("id").get<std::string>() + ".exr"));
        EXPECT_STREQ(smx_image_get_attribute(exr, "slopemix.widening_order"), word);
        errors.push_back(image.at("relrmse"));
    }
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LT(errors[2], errors[0]);
}

// The same columns by other flags are the same sheet.
TEST(CliSheet, TheClosedFormIsModelBoth) {
    const test::TempDir dir;
    const auto arguments = [&](const Arguments &more) {
        return test::with(test::with(sheet(dir.path()), {"--radii", "0.5", "--lobes", "1", "--json"}), more);
    };
    const test::CliResult both = test::cli(arguments({"--model", "both", "--widening-order", "2"}));
    ASSERT_CLI_OK(both);
    EXPECT_TRUE(both.json().at("widening_tolerance").is_null());
    const test::CliResult again =
        test::cli(arguments({"--widening-order", "2,0", "--widening-tolerance", "0.1", "--resume"}));
    ASSERT_CLI_OK(again);
    EXPECT_EQ(again.json(), both.json());
    EXPECT_NE(again.err.find("--widening-tolerance has no effect"), std::string::npos) << again.err;
    EXPECT_CLI_FAILS(1, "made with per_lobe_orders", arguments({"--widening-order", "0,3", "--resume"}));
}

TEST(CliSheet, BadListsOfOrdersAreRefused) {
    const test::TempDir dir;
    for (const auto &[list, reason] :
         {std::pair{"1,,2", "0..8"}, {"9", "0..8"}, {"0,0", "names 0 twice"}, {"1,", "not a list of orders"}}) {
        SCOPED_TRACE(list);
        EXPECT_CLI_FAILS(2, "--widening-order", test::with(sheet(dir / "s"), {"--widening-order", list}));
        EXPECT_CLI_FAILS(2, reason, test::with(sheet(dir / "s"), {"--widening-order", list}));
    }
    EXPECT_TRUE(dir.names().empty());
}

TEST(CliSheet, FailuresKeepWhatWasThere) {
    const test::TempDir dir;
    test::write_file(dir / "sheet.json", "precious");
    EXPECT_CLI_FAILS(1, "no-such.binary", test::with({"sheet", "no-such.binary", "--out", dir.path()}, {}));
    const test::CliSetting no_device{{{"OCL_ICD_VENDORS", dir / "no-vendors"}}, 0};
    EXPECT_CLI_FAILS(1, "no OpenCL device", sheet(dir.path()), no_device);
    EXPECT_CLI_FAILS(1, "sheet.json", sheet(dir / "sheet.json"));
    EXPECT_EQ(test::read_file(dir / "sheet.json"), "precious");
    EXPECT_EQ(dir.names(), Arguments{"sheet.json"});
}
