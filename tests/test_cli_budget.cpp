// slopemix budget: the errors that the API gives for the same renderings, and tables whose split is known.
#include <gtest/gtest.h>

#include "cli.h"
#include "close.h"
#include "files.h"
#include "support.h"

using nlohmann::json;

namespace {

using Arguments = std::vector<std::string>;

constexpr uint32_t samples = 64, resolution = 16;
constexpr uint64_t seed = 5;

Arguments budget(const std::string &input, const Arguments &more = {}) {
    return test::with({"budget", input, "--res", "16", "--spp", "64", "--seed", "5"}, more);
}

json split(const Arguments &arguments) {
    const test::CliResult run = test::cli(test::with(arguments, {"--json"}));
    EXPECT_EQ(run.status, 0) << run.err;
    return run.status == 0 ? run.json() : json();
}

const json &row_of(const json &report, double alpha_x, double alpha_y, const std::string &model) {
    for (const json &row : report.at("rows"))
        if (row.at("alpha_x") == alpha_x && row.at("alpha_y") == alpha_y && row.at("model") == model) return row;
    throw std::out_of_range("no row " + model);
}

// The renderings of one configuration, by the API.
struct View {
    smx_scene scene;
    smx_render_options options;

    View(const smx_displacement &x, double degrees)
        : scene(test::make_scene(resolution, resolution, test::radians(degrees), x)),
          options(test::make_options(samples, seed)) {
        options.sampler = SMX_SAMPLER_MIS;
    }
    test::Image reference(smx_brdf brdf) const { return test::render_reference(brdf, scene, options); }
    test::Image filtered(smx_material material) const { return test::render_filtered(material, scene); }
};

void expect_equal(const json &got, const char *column, smx_image image, smx_image reference) {
    EXPECT_CLOSE(got.at(column).get<double>(), test::relrmse(image, reference), 1e-12, 0.0) << column;
}

} // namespace

TEST(CliBudget, ColumnsAreTheApisErrors) {
    const json report = split(budget("builtin:two-layer", {"--alpha", "0.25,0.1", "--light", "-25", "--lobes", "2"}));
    const View view({0.25, 0.1, 0.0, 0.0, 0.0}, -25.0);
    test::Brdf measured, inverted, base;
    ASSERT_SMX_OK(smx_brdf_open("builtin:two-layer", measured.out()));
    const test::Density density = test::make_density(measured, SMX_MASKING_COINCIDES);
    ASSERT_SMX_OK(smx_density_tabulate(density, inverted.out()));
    const test::Image wanted = view.reference(measured);
    for (const auto &[word, model] :
         {std::pair("shared", SMX_MODEL_SHARED), std::pair("per-lobe", SMX_MODEL_PER_LOBE)}) {
        const json &row = row_of(report, 0.25, 0.1, word);
        const test::Material material = test::fit(density, 2, model);
        ASSERT_SMX_OK(smx_material_tabulate(material, base.out()));
        const test::Image unwidened = view.reference(base), filtered = view.filtered(material);
        if (model == SMX_MODEL_SHARED)
            expect_equal(row, "inversion", view.reference(inverted), wanted);
        else
            EXPECT_TRUE(row.at("inversion").is_null());
        expect_equal(row, "fit", unwidened, wanted);
        expect_equal(row, "widening", filtered, unwidened);
        expect_equal(row, "total", filtered, wanted);
        EXPECT_EQ(row.at("lights").size(), 1u);
        EXPECT_EQ(row.at("lights")[0].at("total"), row.at("total"));
    }
}

// One Beckmann lobe is its own fit: what is left is the widening, and without displacement nothing.
TEST(CliBudget, OfOneLobeIsItsWidening) {
    constexpr double fit_tolerance = 0.02;   // of the inversion's masking kernel, and of cells at grazing angles
    constexpr double table_tolerance = 0.01; // of the table's interpolation
    const Arguments arguments =
        budget("analytic:beckmann,alpha=0.3,f0=0.9",
               {"--alpha", "0,0", "--alpha", "0.5,0.5", "--light", "90", "--light", "0", "--lobes", "1"});
    const json report = split(test::replaced(arguments, "--spp", "1024"));
    for (const char *model : {"shared", "per-lobe"}) {
        const json &flat = row_of(report, 0.0, 0.0, model), &rough = row_of(report, 0.5, 0.5, model);
        EXPECT_LT(flat.at("fit").get<double>(), fit_tolerance) << model;
        EXPECT_LT(flat.at("widening").get<double>(), table_tolerance) << model;
        EXPECT_LT(rough.at("fit").get<double>(), fit_tolerance) << model;
        EXPECT_GT(rough.at("widening").get<double>(), 5.0 * fit_tolerance) << model;
        EXPECT_CLOSE(rough.at("total").get<double>(), rough.at("widening").get<double>(), 0.0, fit_tolerance) << model;
    }
    EXPECT_LT(row_of(report, 0.0, 0.0, "shared").at("inversion").get<double>(), fit_tolerance);
}

TEST(CliBudget, AnOrderTakesTheWideningAway) {
    const auto widened = [](const char *order) {
        return budget("analytic:beckmann,alpha=0.3,f0=0.9",
                      {"--alpha", "0.5,0.5", "--light", "90", "--lobes", "1", "--widening-order", order});
    };
    const json closed_form = split(widened("0")), quadrature = split(widened("3")), chosen = split(widened("auto"));
    EXPECT_EQ(closed_form.at("widening_order"), 0);
    EXPECT_EQ(quadrature.at("widening_order"), 3);
    EXPECT_TRUE(quadrature.at("widening_tolerance").is_null());
    EXPECT_EQ(chosen.at("widening_order"), "auto");
    EXPECT_EQ(chosen.at("widening_tolerance").get<double>(), 0.02);
    for (const char *model : {"shared", "per-lobe"})
        EXPECT_LT(row_of(quadrature, 0.5, 0.5, model).at("widening").get<double>(),
                  row_of(closed_form, 0.5, 0.5, model).at("widening").get<double>())
            << model;
    const test::CliResult text = test::cli(test::with(widened("3"), {"--widening-tolerance", "0.1"}));
    ASSERT_CLI_OK(text);
    EXPECT_NE(text.out.substr(0, text.out.find('\n')).find("widening order 3"), std::string::npos) << text.out;
    EXPECT_NE(text.err.find("--widening-tolerance has no effect"), std::string::npos) << text.err;
}

TEST(CliBudget, RowsAreMeans) {
    const json report =
        split(budget("builtin:conductor", {"--alpha", "0.1,0.1", "--alpha", "0.5,0", "--alpha", "0,0", "--light", "90",
                                           "--light", "0", "--lobes", "1", "--grade", "fast"}));
    EXPECT_EQ(report.at("rows").size(), 6u);
    EXPECT_EQ(report.at("grade"), "fast");
    EXPECT_EQ(report.at("spp"), samples);
    EXPECT_TRUE(report.at("target_error").is_null());
    EXPECT_EQ(report.at("sampler"), "mis");
    EXPECT_GT(report.at("standard_error").get<double>(), 0.0);
    for (const json &row : report.at("rows")) {
        ASSERT_EQ(row.at("lights").size(), 2u);
        const double sum =
            row.at("lights")[0].at("widening").get<double>() + row.at("lights")[1].at("widening").get<double>();
        EXPECT_CLOSE(row.at("widening").get<double>(), sum / 2.0, 1e-12, 0.0);
    }
    // The undisplaced surface has no part in the mean.
    for (const json &mean : report.at("mean")) {
        const std::string model = mean.at("model");
        for (const char *column : {"fit", "widening", "total"}) {
            const double sum = row_of(report, 0.1, 0.1, model).at(column).get<double>() +
                               row_of(report, 0.5, 0.0, model).at(column).get<double>();
            EXPECT_CLOSE(mean.at(column).get<double>(), sum / 2.0, 1e-12, 0.0) << model << ' ' << column;
        }
    }
    EXPECT_EQ(report.at("mean").size(), 2u);
    EXPECT_TRUE(report.at("mean")[1].at("inversion").is_null());
}

TEST(CliBudget, TextHasARowPerRoughnessAndModel) {
    const test::CliResult run = test::cli(test::replaced(budget("builtin:conductor", {"--lobes", "1"}), "--res", "4"));
    ASSERT_CLI_OK(run);
    for (const char *text : {"inversion", "widening", "0.1,0.1", "0.25,0.25", "0.5,0.5", "0.25,0", "0,0.25", "  0,0",
                             "displaced, mean", "largest standard error", "64 samples per pixel"})
        EXPECT_NE(run.out.find(text), std::string::npos) << "no \"" << text << "\" in\n" << run.out;
    // Without displacement there is no mean, and with the grid no standard error.
    const test::CliResult flat = test::cli(test::replaced(
        budget("builtin:conductor", {"--lobes", "1", "--alpha", "0,0", "--light", "0", "--sampler", "grid"}), "--res",
        "4"));
    ASSERT_CLI_OK(flat);
    EXPECT_EQ(flat.out.find("mean"), std::string::npos) << flat.out;
}

TEST(CliBudget, TheTargetIsTheDefault) {
    const json report =
        split({"budget", "builtin:conductor", "--res", "8", "--lobes", "1", "--alpha", "0.1,0.1", "--light", "90"});
    EXPECT_TRUE(report.at("spp").is_null());
    EXPECT_EQ(report.at("target_error"), 0.003);
    EXPECT_LT(report.at("standard_error").get<double>(), 0.003);
}

TEST(CliBudget, WrongUsageIsRefusedByName) {
    const std::vector<std::pair<std::string, Arguments>> bad{
        {"--alpha", {"-0.1,0.1", "nan,0.1", "0.1", "0.1,0.1,0.1", ""}},
        {"--light", {"nan", "east"}},
        {"--lobes", {"0", "65", "2.5"}},
        {"--target-error", {"0", "1", "x"}},
        {"--sampler", {"random"}},
    };
    for (const auto &[flag, values] : bad)
        for (const std::string &value : values) EXPECT_CLI_FAILS(2, flag, budget("builtin:conductor", {flag, value}));
    EXPECT_CLI_FAILS(2, "--alpha", budget("builtin:conductor", {"--alpha", "0.1,0.1", "--alpha", "x,0"}));
    EXPECT_CLI_FAILS(2, "--spp", test::replaced(budget("builtin:conductor"), "--spp", "15"));
    EXPECT_CLI_FAILS(2, "--target-error", budget("builtin:conductor", {"--sampler", "grid", "--target-error", "0.01"}));
    EXPECT_CLI_FAILS(2, "paint.json", budget("paint.json"));
    EXPECT_CLI_FAILS(1, "velvet", budget("builtin:velvet"));
    EXPECT_CLI_FAILS(1, "density", budget("density:x.csv"));
    EXPECT_CLI_FAILS(1, "no such device", budget("builtin:conductor", {"--device", "no such device"}));
}
