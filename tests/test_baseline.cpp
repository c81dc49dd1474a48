// Baselines: what a table was made from comes back.
#include <gtest/gtest.h>

#include "close.h"
#include "support.h"

namespace {

// The cells are the truth itself; the solver stops within its relative 1e-6 of the cost.
constexpr double parameter_tolerance = 1e-3;

struct Truth {
    double alpha, f0[3], kd[3];
};

smx_baseline_report fit(smx_brdf brdf, smx_baseline kind) {
    smx_baseline_report report = SMX_BASELINE_REPORT_INIT;
    EXPECT_SMX_OK(smx_baseline_fit(brdf, kind, &report));
    return report;
}

test::Brdf open(const std::string &input) {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open(input.c_str(), b.out()));
    return b;
}

test::Brdf with_body(const std::string &input, const double (&kd)[3]) {
    oracle::Table table = test::filled_table(open(input));
    for (std::size_t k = 0; k < table.values.size(); ++k) table.values[k] += kd[k / table.cells()] / oracle::pi;
    return test::make_brdf(table);
}

std::string digits(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

void expect_truth(const smx_baseline_report &report, const Truth &truth) {
    EXPECT_CLOSE(report.alpha, truth.alpha, parameter_tolerance, 0.0);
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_CLOSE(report.f0[c], truth.f0[c], parameter_tolerance, 1e-3) << c;
        EXPECT_CLOSE(report.f90[c], 1.0, parameter_tolerance, 0.0) << c; // analytic materials have Schlick's curve
        EXPECT_CLOSE(report.kd[c], truth.kd[c], parameter_tolerance, 1e-3) << c;
    }
    EXPECT_GT(report.iterations, 0u);
    EXPECT_GT(report.seconds, 0.0);
    EXPECT_STRNE(report.message, "");
    EXPECT_LT(report.residual, 1e-3);
}

} // namespace

TEST(Baseline, BeckmannComesBack) {
    for (const double alpha : {0.02, 0.25, 0.7})
        expect_truth(
            fit(open("analytic:beckmann,alpha=" + std::to_string(alpha) + ",f0=0.9/0.5/0.04"), SMX_BASELINE_BECKMANN),
            {alpha, {0.9, 0.5, 0.04}, {0.0, 0.0, 0.0}});
}

TEST(Baseline, GgxComesBack) {
    for (const double alpha : {0.02, 0.25, 0.7})
        expect_truth(fit(open("analytic:ggx,alpha=" + std::to_string(alpha) + ",f0=0.9/0.5/0.04"), SMX_BASELINE_GGX),
                     {alpha, {0.9, 0.5, 0.04}, {0.0, 0.0, 0.0}});
}

TEST(Baseline, GgxAndLambertComeBack) {
    const double kd[3] = {0.5, 0.2, 0.0};
    const test::Brdf brdf = with_body("analytic:ggx,alpha=0.15,f0=0.04", kd);
    expect_truth(fit(brdf, SMX_BASELINE_GGX_LAMBERT), {0.15, {0.04, 0.04, 0.04}, {0.5, 0.2, 0.0}});
    // Without the body the same table is far off.
    EXPECT_GT(fit(brdf, SMX_BASELINE_GGX).residual, 0.1);
}

TEST(Baseline, ErrorsAreThoseOfTheModel) {
    const test::Brdf brdf = open("analytic:ggx,alpha=0.3,f0=0.8");
    const smx_baseline_report right = fit(brdf, SMX_BASELINE_GGX), wrong = fit(brdf, SMX_BASELINE_BECKMANN);
    EXPECT_LT(right.errors.l2, 1e-3);
    EXPECT_LT(right.errors.log_80, 1e-3);
    EXPECT_GT(wrong.errors.l2, 10.0 * right.errors.l2);
    EXPECT_GT(wrong.errors.cube_root, 10.0 * right.errors.cube_root);
    // Those of the fitted parameters as a table, from the lobe without Fresnel curve and the one with Schlick's rise.
    const std::string beckmann = "analytic:beckmann,alpha=" + digits(wrong.alpha);
    oracle::Table model = test::filled_table(open(beckmann + ",f0=1"));
    const oracle::Table rise = test::filled_table(open(beckmann + ",f0=0"));
    for (std::size_t k = 0; k < model.values.size(); ++k) {
        const std::size_t c = k / model.cells();
        model.values[k] = wrong.f0[c] * (model.values[k] - rise.values[k]) + wrong.f90[c] * rise.values[k];
    }
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    ASSERT_SMX_OK(smx_brdf_compare(test::make_brdf(model), brdf, &errors));
    EXPECT_CLOSE(wrong.errors.l2, errors.l2, 1e-6, 0.0);
    EXPECT_CLOSE(wrong.errors.log, errors.log, 1e-6, 0.0);
    EXPECT_CLOSE(wrong.errors.cube_root_80, errors.cube_root_80, 1e-6, 0.0);
}

TEST(Baseline, LambertIsTheBodyAlone) {
    const double kd[3] = {0.5, 0.5, 0.5};
    const smx_baseline_report report = fit(with_body("analytic:lambert,albedo=0", kd), SMX_BASELINE_GGX_LAMBERT);
    for (const double body : report.kd) EXPECT_CLOSE(body, 0.5, 1e-3, 0.0);
}

TEST(Baseline, ZerosHaveNoSolution) {
    smx_baseline_report report = SMX_BASELINE_REPORT_INIT;
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "nothing is reflected",
                     smx_baseline_fit(open("analytic:lambert,albedo=0"), SMX_BASELINE_GGX, &report));
    EXPECT_EQ(report.alpha, 0.0);
}
