/* smx_material_* with every bad argument, but for its evaluation. */
#include "c_objects.h"

/* A right description, whose fields the checks spoil one at a time. */
static smx_material_desc good_desc(const smx_lobe *lobe) {
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.name = "x";
    desc.lobes = lobe;
    desc.lobe_count = 1;
    desc.fresnel = c_fresnel;
    desc.knots = 2;
    return desc;
}

static void refuse(const char *needle, const smx_material_desc *desc) {
    smx_material material = (smx_material)UNTOUCHED;
    INVALID(needle, smx_material_create(desc, &material));
    CHECK(material == (smx_material)UNTOUCHED);
}

static void check_desc(void) {
    const size_t sizes[] = WRONG_SIZES(smx_material_desc);
    const smx_lobe lobe = {1.0, 0.1};
    const smx_material_desc good = good_desc(&lobe);
    smx_material_desc bad = good;
    size_t k;
    refuse("desc", NULL);
    INVALID("material", smx_material_create(&good, NULL));
    for (k = 0; k < 5; ++k) {
        bad.size = sizes[k];
        refuse("size", &bad);
    }
    bad = good;
    bad.name = NULL;
    refuse("name", &bad);
    bad = good;
    bad.model = (smx_model)2;
    refuse("model", &bad);
    bad = good;
    bad.lobes = NULL;
    refuse("lobes", &bad);
    bad = good;
    bad.fresnel = NULL;
    refuse("fresnel", &bad);
    bad = good;
    bad.lobe_count = 0;
    refuse("0", &bad);
    bad.lobe_count = 65;
    refuse("65", &bad);
    bad = good;
    bad.knots = 1;
    refuse("knots", &bad);
    bad.knots = 4097;
    refuse("4097", &bad);
}

static void check_values(void) {
    static const smx_lobe bad_lobes[] = {{0.0, 0.1},  {-1.0, 0.1}, {NAN, 0.1},   {INFINITY, 0.1}, {1.0, 0.0},
                                         {1.0, -0.1}, {1.0, 9e-5}, {1.0, 1.1e4}, {1.0, NAN},      {1.0, INFINITY}};
    static const double bad_values[] = {-0.1, NAN, INFINITY};
    static const double bad_angles[][3] = {{0.0, 0.0, 1.5707963267948966},
                                           {0.1, 0.2, 1.5707963267948966},
                                           {0.0, 0.5, 1.0},
                                           {0.0, NAN, 1.5707963267948966}};
    const smx_lobe lobe = {1.0, 0.1};
    const double ones[9] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    smx_material_desc bad = good_desc(&lobe);
    size_t k;
    for (k = 0; k < sizeof bad_lobes / sizeof *bad_lobes; ++k) {
        bad.lobes = &bad_lobes[k];
        refuse(k < 4 ? "weight" : "alpha", &bad);
    }
    for (k = 0; k < 3; ++k) {
        double fresnel[6] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
        fresnel[3] = bad_values[k];
        bad = good_desc(&lobe);
        bad.fresnel = fresnel;
        refuse("fresnel", &bad);
    }
    bad = good_desc(&lobe);
    bad.fresnel = ones;
    bad.knots = 3;
    for (k = 0; k < 4; ++k) {
        bad.theta_d = bad_angles[k];
        refuse("theta_d", &bad);
    }
}

static void check_most_lobes(void) {
    smx_lobe many[64];
    smx_material_desc desc = good_desc(many);
    smx_material material = NULL;
    size_t k;
    for (k = 0; k < 64; ++k) {
        many[k].weight = 1.0;
        many[k].alpha = 0.1;
    }
    desc.lobe_count = 64;
    OK(smx_material_create(&desc, &material));
    smx_material_release(material);
}

static void check_fit(void) {
    const size_t sizes[] = WRONG_SIZES(smx_fit_options);
    const smx_fit_options good = SMX_FIT_OPTIONS_INIT;
    smx_fit_options bad = good;
    const double tolerances[] = {0.0, -1e-9, NAN, INFINITY};
    smx_material material = (smx_material)UNTOUCHED;
    smx_density density = NULL;
    smx_brdf brdf = c_brdf();
    size_t k;
    OK(smx_density_create(brdf, NULL, &density));
    INVALID("density", smx_material_fit(NULL, NULL, &material));
    INVALID("material", smx_material_fit(density, NULL, NULL));
    for (k = 0; k < sizeof sizes / sizeof *sizes; ++k) {
        bad.size = sizes[k];
        INVALID("size", smx_material_fit(density, &bad, &material));
    }
    bad = good;
    bad.lobes = 66;
    INVALID("lobes", smx_material_fit(density, &bad, &material));
    bad.lobes = 65;
    INVALID("65", smx_material_fit(density, &bad, &material));
    bad = good;
    bad.model = (smx_model)2;
    INVALID("model", smx_material_fit(density, &bad, &material));
    for (k = 0; k < 4; ++k) {
        bad = good;
        bad.tolerance = tolerances[k];
        INVALID("tolerance", smx_material_fit(density, &bad, &material));
    }
    bad = good;
    bad.max_iterations = 0;
    INVALID("max_iterations", smx_material_fit(density, &bad, &material));
    bad.max_iterations = 1000001;
    INVALID("1000001", smx_material_fit(density, &bad, &material));
    CHECK(material == (smx_material)UNTOUCHED);
    smx_density_release(density);
    smx_brdf_release(brdf);
}

static void check_getters(smx_material material) {
    const size_t info_sizes[] = WRONG_SIZES(smx_material_info), report_sizes[] = WRONG_SIZES(smx_fit_report);
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    smx_lobe lobes[2] = {{-7.0, -7.0}, {-7.0, -7.0}};
    double fresnel[6] = {-7.0, 0.0, 0.0, 0.0, 0.0, 0.0}, theta_d[2] = {-7.0, 0.0};
    size_t k;
    INVALID("material", smx_material_get_info(NULL, &info));
    INVALID("info", smx_material_get_info(material, NULL));
    INVALID("material", smx_material_get_report(NULL, &report));
    INVALID("report", smx_material_get_report(material, NULL));
    for (k = 0; k < 5; ++k) {
        info.size = info_sizes[k];
        report.size = report_sizes[k];
        INVALID("size", smx_material_get_info(material, &info));
        INVALID("size", smx_material_get_report(material, &report));
    }
    CHECK(info.lobes == 0 && info.name[0] == '\0');
    INVALID("material", smx_material_get_lobes(NULL, lobes, 2));
    INVALID("lobes", smx_material_get_lobes(material, NULL, 2));
    INVALID("3", smx_material_get_lobes(material, lobes, 3));
    INVALID("1", smx_material_get_lobes(material, lobes, 1));
    INVALID("material", smx_material_get_fresnel(NULL, theta_d, fresnel, 6));
    INVALID("5", smx_material_get_fresnel(material, theta_d, fresnel, 5));
    INVALID("2", smx_material_get_fresnel(material, theta_d, fresnel, 2));
    CHECK(lobes[0].alpha == -7.0 && fresnel[0] == -7.0 && theta_d[0] == -7.0);
    OK(smx_material_get_fresnel(material, NULL, fresnel, 6));
    OK(smx_material_get_fresnel(material, theta_d, NULL, 6));
}

/* Figures of the fit: `made` is from arrays and has none. */
static void check_fit_figures(smx_material made) {
    smx_brdf brdf = c_brdf();
    smx_density density = NULL;
    smx_material fitted = NULL;
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    double alpha[SMX_MAX_LOBES] = {-7.0}, curves[SMX_MAX_LOBES * 3 * SMX_CURVE_COEFFICIENTS] = {-7.0};
    double theta_o[SMX_ALBEDO_ANGLES] = {-7.0}, table[SMX_ALBEDO_ANGLES * 3] = {-7.0},
           fit[SMX_ALBEDO_ANGLES * 3] = {-7.0};
    FAILS(SMX_NO_SOLUTION, "deviations", smx_material_get_deviations(made, alpha, curves, 2));
    FAILS(SMX_NO_SOLUTION, "albedo", smx_material_get_albedo(made, theta_o, table, fit));
    OK(smx_density_create(brdf, NULL, &density));
    OK(smx_material_fit(density, NULL, &fitted));
    OK(smx_material_get_info(fitted, &info));
    INVALID("material", smx_material_get_deviations(NULL, alpha, curves, info.lobes));
    INVALID("count", smx_material_get_deviations(fitted, alpha, curves, info.lobes + 1));
    INVALID("material", smx_material_get_albedo(NULL, theta_o, table, fit));
    CHECK(alpha[0] == -7.0 && curves[0] == -7.0 && theta_o[0] == -7.0 && table[0] == -7.0 && fit[0] == -7.0);
    OK(smx_material_get_deviations(fitted, alpha, NULL, info.lobes));
    OK(smx_material_get_deviations(fitted, NULL, curves, info.lobes));
    CHECK(alpha[0] > 0.0 && curves[0] != -7.0);
    OK(smx_material_get_albedo(fitted, theta_o, NULL, NULL));
    OK(smx_material_get_albedo(fitted, NULL, table, fit));
    CHECK(theta_o[0] == 0.0 && table[0] > 0.0 && fit[0] > 0.0 && fit[0] <= 1.001);
    smx_material_release(fitted);
    smx_density_release(density);
    smx_brdf_release(brdf);
}

static void check_files(smx_material material) {
    smx_material loaded = (smx_material)UNTOUCHED;
    INVALID("path", smx_material_load(NULL, &loaded));
    INVALID("material", smx_material_load("x.json", NULL));
    FAILS(SMX_CANNOT_READ, "no/such", smx_material_load("no/such/file.json", &loaded));
    INVALID("material", smx_material_save(NULL, "x.json"));
    INVALID("path", smx_material_save(material, NULL));
    FAILS(SMX_CANNOT_WRITE, "no/such", smx_material_save(material, "no/such/file.json"));
    CHECK(loaded == (smx_material)UNTOUCHED);
}

int main(void) {
    smx_material material = c_material();
    check_desc();
    check_values();
    check_most_lobes();
    check_fit();
    check_getters(material);
    check_fit_figures(material);
    check_files(material);
    smx_material_release(material);
    return c_check_result();
}
