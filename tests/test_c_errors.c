/* Errors in BRDF space and baselines with every bad argument. */
#include "c_objects.h"

static void check_compare(smx_brdf brdf, smx_brdf below_horizon) {
    const size_t sizes[] = WRONG_SIZES(smx_brdf_errors);
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    size_t k;
    errors.l2 = -7.0;
    INVALID("brdf", smx_brdf_compare(NULL, brdf, &errors));
    INVALID("reference", smx_brdf_compare(brdf, NULL, &errors));
    INVALID("errors", smx_brdf_compare(brdf, brdf, NULL));
    FAILS(SMX_NO_SOLUTION, "80 degrees", smx_brdf_compare(brdf, below_horizon, &errors));
    FAILS(SMX_NO_SOLUTION, "80 degrees", smx_brdf_compare(below_horizon, brdf, &errors));
    for (k = 0; k < 5; ++k) {
        errors.size = sizes[k];
        INVALID("size", smx_brdf_compare(brdf, brdf, &errors));
    }
    CHECK(errors.l2 == -7.0);
    errors.size = sizeof errors;
    OK(smx_brdf_compare(brdf, brdf, &errors));
    CHECK(errors.l2 == 0.0 && errors.size == sizeof errors);
}

static void check_material(smx_brdf brdf, smx_brdf below_horizon) {
    const size_t sizes[] = WRONG_SIZES(smx_brdf_errors);
    smx_material material = c_material();
    smx_brdf_errors errors = SMX_BRDF_ERRORS_INIT;
    size_t k;
    errors.log_80 = -7.0;
    INVALID("material", smx_material_brdf_errors(NULL, brdf, &errors));
    INVALID("reference", smx_material_brdf_errors(material, NULL, &errors));
    INVALID("errors", smx_material_brdf_errors(material, brdf, NULL));
    FAILS(SMX_NO_SOLUTION, "80 degrees", smx_material_brdf_errors(material, below_horizon, &errors));
    for (k = 0; k < 5; ++k) {
        errors.size = sizes[k];
        INVALID("size", smx_material_brdf_errors(material, brdf, &errors));
    }
    CHECK(errors.log_80 == -7.0);
    errors.size = sizeof errors;
    OK(smx_material_brdf_errors(material, brdf, &errors));
    CHECK(errors.l2 > 0.0 && errors.log_80 > 0.0);
    smx_material_release(material);
}

static void check_baseline(smx_brdf brdf, smx_brdf below_horizon) {
    const size_t sizes[] = WRONG_SIZES(smx_baseline_report), inner[] = WRONG_SIZES(smx_brdf_errors);
    smx_baseline_report report = SMX_BASELINE_REPORT_INIT;
    size_t k;
    report.alpha = -7.0;
    INVALID("brdf", smx_baseline_fit(NULL, SMX_BASELINE_GGX, &report));
    INVALID("report", smx_baseline_fit(brdf, SMX_BASELINE_GGX, NULL));
    INVALID("kind is 3", smx_baseline_fit(brdf, (smx_baseline)3, &report));
    INVALID("kind", smx_baseline_fit(brdf, (smx_baseline)-1, &report));
    FAILS(SMX_NO_SOLUTION, "reflected", smx_baseline_fit(below_horizon, SMX_BASELINE_GGX, &report));
    for (k = 0; k < 5; ++k) {
        report.size = sizes[k];
        INVALID("report->size", smx_baseline_fit(brdf, SMX_BASELINE_GGX, &report));
    }
    report.size = sizeof report;
    for (k = 0; k < 5; ++k) {
        report.errors.size = inner[k];
        INVALID("report->errors->size", smx_baseline_fit(brdf, SMX_BASELINE_GGX, &report));
    }
    CHECK(report.alpha == -7.0 && report.errors.l2 == 0.0);
    report.errors.size = sizeof report.errors;
    OK(smx_baseline_fit(brdf, SMX_BASELINE_BECKMANN, &report));
    CHECK(report.alpha > 0.0 && report.size == sizeof report && report.errors.size == sizeof report.errors);
}

/* A table of which only a cell below the horizon is valid: the last. */
static smx_brdf only_below_horizon(void) {
    const size_t cells = (size_t)90 * 90 * 180;
    double *values = malloc(3 * cells * sizeof *values);
    smx_brdf brdf = NULL;
    size_t k;
    for (k = 0; k < 3 * cells; ++k) values[k] = k % cells == cells - 1 ? 0.5 : -1.0;
    OK(smx_brdf_create("below", 180, values, &brdf));
    free(values);
    return brdf;
}

int main(void) {
    smx_brdf brdf = c_brdf(), below_horizon = only_below_horizon();
    check_compare(brdf, below_horizon);
    check_material(brdf, below_horizon);
    check_baseline(brdf, below_horizon);
    smx_brdf_release(below_horizon);
    smx_brdf_release(brdf);
    return c_check_result();
}
