/* smx_evaluator_* with every bad argument. */
#include "c_objects.h"

static const float up[3] = {0.0f, 0.0f, 1.0f};
static const smx_vectors v = {up, up + 1, up + 2, 3};
static float values[3] = {-1.0f, -1.0f, -1.0f};
static const smx_vectors_out rgb = {values, values + 1, values + 2, 3};
static const smx_scalars_out one = {values, 1};

static void check_create(smx_context context, smx_material material) {
    const size_t sizes[] = WRONG_SIZES(smx_render_options);
    const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
    smx_displacement bad_x = x;
    smx_render_options bad = SMX_RENDER_OPTIONS_INIT;
    smx_evaluator e = (smx_evaluator)UNTOUCHED;
    size_t k;
    INVALID("context", smx_evaluator_create(NULL, material, &x, SMX_G2_CORRELATED, NULL, &e));
    INVALID("material", smx_evaluator_create(context, NULL, &x, SMX_G2_CORRELATED, NULL, &e));
    INVALID("displacement", smx_evaluator_create(context, material, NULL, SMX_G2_CORRELATED, NULL, &e));
    INVALID("evaluator", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, NULL, NULL));
    INVALID("masking", smx_evaluator_create(context, material, &x, (smx_masking)9, NULL, &e));
    bad_x.rho = 1.0;
    INVALID("rho", smx_evaluator_create(context, material, &bad_x, SMX_G2_CORRELATED, NULL, &e));
    for (k = 0; k < 5; ++k) {
        bad.size = sizes[k];
        INVALID("size", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, &bad, &e));
    }
    bad.size = sizeof bad;
    bad.widening_order = SMX_WIDENING_AUTO;
    INVALID("auto", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, &bad, &e));
    bad.widening_order = 9;
    INVALID("widening_order", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, &bad, &e));
    bad.widening_order = 0;
    bad.effects = SMX_EFFECT_INTERREFLECTION;
    INVALID("interreflection", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, &bad, &e));
    bad.effects = SMX_EFFECTS_ALL;
    bad.grade = (smx_grade)5;
    INVALID("grade", smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, &bad, &e));
    CHECK(e == (smx_evaluator)UNTOUCHED);
    INVALID("evaluator", smx_evaluator_retain(NULL));
    smx_evaluator_release(NULL);
}

static void check_arrays(smx_evaluator e) {
    const smx_vectors no_y = {up, NULL, up, 3}, no_stride = {up, up, up, 0};
    const smx_vectors_out no_z = {values, values, NULL, 3}, flat = {values, values, values, 0};
    const smx_scalars_out nowhere = {NULL, 1}, no_step = {values, 0};
    INVALID("evaluator", smx_evaluator_eval(NULL, 1, &v, &v, &rgb));
    INVALID("wi is null", smx_evaluator_eval(e, 1, NULL, &v, &rgb));
    INVALID("wi->x, y or z", smx_evaluator_eval(e, 1, &no_y, &v, &rgb));
    INVALID("wi->stride", smx_evaluator_eval(e, 1, &no_stride, &v, &rgb));
    INVALID("wo is null", smx_evaluator_eval(e, 1, &v, NULL, &rgb));
    INVALID("fcos is null", smx_evaluator_eval(e, 1, &v, &v, NULL));
    INVALID("fcos->x, y or z", smx_evaluator_eval(e, 1, &v, &v, &no_z));
    INVALID("fcos->stride", smx_evaluator_eval(e, 1, &v, &v, &flat));
    INVALID("evaluator", smx_evaluator_pdf(NULL, 1, &v, &v, &one));
    INVALID("wo", smx_evaluator_pdf(e, 1, &v, NULL, &one));
    INVALID("pdf->values", smx_evaluator_pdf(e, 1, &v, &v, &nowhere));
    INVALID("pdf->stride", smx_evaluator_pdf(e, 1, &v, &v, &no_step));
    INVALID("g2", smx_evaluator_g2(e, 1, &v, &v, NULL));
    INVALID("u is null", smx_evaluator_sample(e, 1, NULL, &v, &rgb, &rgb, &one));
    INVALID("wo is null", smx_evaluator_sample(e, 1, &v, NULL, &rgb, &rgb, &one));
    INVALID("wi is null", smx_evaluator_sample(e, 1, &v, &v, NULL, &rgb, &one));
    INVALID("fcos->stride", smx_evaluator_sample(e, 1, &v, &v, &rgb, &flat, &one));
    INVALID("pdf->values", smx_evaluator_sample(e, 1, &v, &v, &rgb, &rgb, &nowhere));
    INVALID("evaluator", smx_evaluator_sample(NULL, 1, &v, &v, &rgb, NULL, NULL));
    INVALID("wh", smx_evaluator_ndf(e, 1, NULL, &one));
    INVALID("ndf", smx_evaluator_ndf(e, 1, &v, NULL));
    INVALID("k is null", smx_evaluator_sigma(e, 1, NULL, &one));
    INVALID("sigma", smx_evaluator_sigma(e, 1, &v, &nowhere));
    INVALID("g1", smx_evaluator_g1(e, 1, &v, &no_step));
    CHECK(values[0] == -1.0f);
}

static void check_others(smx_evaluator e, smx_material material) {
    double bound = -1.0;
    float words[4];
    size_t count = 4;
    INVALID("evaluator", smx_evaluator_sample_bound(NULL, &bound));
    INVALID("bound", smx_evaluator_sample_bound(e, NULL));
    CHECK(bound == -1.0);
    OK(smx_evaluator_sample_bound(e, &bound));
    CHECK(bound > 0.0);
    INVALID("evaluator", smx_evaluator_build(NULL, SMX_QUANTITY_ALL));
    INVALID("quantities is 0", smx_evaluator_build(e, 0));
    INVALID("quantities is 128", smx_evaluator_build(e, 128));
    OK(smx_evaluator_build(e, SMX_QUANTITY_SIGMA));
    INVALID("material", smx_material_pack(NULL, words, &count));
    INVALID("count", smx_material_pack(material, words, NULL));
    INVALID("*count is 4", smx_material_pack(material, words, &count));
    CHECK(smx_device_header() != NULL && smx_device_header() == smx_device_header());
}

int main(void) {
    const smx_displacement x = {0.1, 0.1, 0.0, 0.0, 0.0};
    smx_context context = NULL;
    smx_material material = c_material();
    smx_evaluator e = NULL;
    OK(smx_context_create(NULL, &context));
    check_create(context, material);
    OK(smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, NULL, &e));
    check_arrays(e);
    check_others(e, material);
    OK(smx_evaluator_eval(e, 1, &v, &v, &rgb));
    CHECK(values[0] > 0.0f);
    OK(smx_evaluator_retain(e));
    smx_evaluator_release(e);
    smx_evaluator_release(e);
    smx_material_release(material);
    smx_context_release(context);
    return c_check_result();
}
