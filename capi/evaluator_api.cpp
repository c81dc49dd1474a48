// smx_evaluator_*
#include "evaluator_handle.h"
#include "render_arguments.h"

using namespace smx;

namespace {

void require_stride(std::size_t stride, const char *name) {
    require(stride >= 1, name, "->stride is 0; it must be at least 1");
}

HostArray read(const smx_vectors *v, const char *name) {
    require_pointer(v, name);
    require(v->x && v->y && v->z, name, "->x, y or z is null");
    require_stride(v->stride, name);
    return read_vectors(v->x, v->y, v->z, v->stride);
}

HostArray written(const smx_vectors_out *v, const char *name) {
    require_pointer(v, name);
    require(v->x && v->y && v->z, name, "->x, y or z is null");
    require_stride(v->stride, name);
    return written_vectors(v->x, v->y, v->z, v->stride);
}

HostArray written(const smx_scalars_out *s, const char *name) {
    require_pointer(s, name);
    require(s->values, name, "->values is null");
    require_stride(s->stride, name);
    return written_scalars(s->values, s->stride);
}

// A quantity of pairs of directions.
template <typename Out>
smx_status of_pairs(smx_evaluator evaluator, Quantity quantity, size_t count, const smx_vectors *wi,
                    const smx_vectors *wo, const Out *out, const char *out_name) {
    return guarded([&] {
        require_pointer(evaluator, "evaluator");
        const HostArray to_light = read(wi, "wi"), to_viewer = read(wo, "wo");
        evaluator->object->evaluate(quantity, count, {written(out, out_name), to_light, to_viewer});
    });
}

// A quantity of directions.
smx_status of_directions(smx_evaluator evaluator, Quantity quantity, size_t count, const smx_vectors *k,
                         const char *k_name, const smx_scalars_out *out, const char *out_name) {
    return guarded([&] {
        require_pointer(evaluator, "evaluator");
        const HostArray directions = read(k, k_name);
        evaluator->object->evaluate(quantity, count, {written(out, out_name), directions});
    });
}

} // namespace

extern "C" {

smx_status smx_evaluator_create(smx_context context, smx_material material, const smx_displacement *displacement,
                                smx_masking masking, const smx_render_options *options, smx_evaluator *evaluator) {
    return guarded([&] {
        require_pointer(context, "context");
        require_pointer(material, "material");
        require_pointer(displacement, "displacement");
        require_pointer(evaluator, "evaluator");
        const RenderOptions o = to_cpp(checked(options, SMX_RENDER_OPTIONS_INIT, "options"));
        auto made = std::make_shared<Evaluator>(*context->object, *material->object, to_cpp(*displacement),
                                                static_cast<Masking>(masking), o);
        *evaluator = new smx_evaluator_s(context->object, std::move(made));
    });
}

smx_status smx_evaluator_retain(smx_evaluator evaluator) { return retain(evaluator, "evaluator"); }
void smx_evaluator_release(smx_evaluator evaluator) { release(evaluator); }

smx_status smx_evaluator_build(smx_evaluator evaluator, uint32_t quantities) {
    return guarded([&] {
        require_pointer(evaluator, "evaluator");
        require(quantities != 0 && (quantities & ~SMX_QUANTITY_ALL) == 0, "quantities is ", quantities,
                "; it must be a sum of smx_quantity, 1..", SMX_QUANTITY_ALL);
        for (const auto &[bit, quantity] : quantity_bits)
            if (quantities & bit) evaluator->object->build(quantity);
    });
}

smx_status smx_evaluator_eval(smx_evaluator evaluator, size_t count, const smx_vectors *wi, const smx_vectors *wo,
                              const smx_vectors_out *fcos) {
    return of_pairs(evaluator, Quantity::Fcos, count, wi, wo, fcos, "fcos");
}

smx_status smx_evaluator_pdf(smx_evaluator evaluator, size_t count, const smx_vectors *wi, const smx_vectors *wo,
                             const smx_scalars_out *pdf) {
    return of_pairs(evaluator, Quantity::Pdf, count, wi, wo, pdf, "pdf");
}

smx_status smx_evaluator_g2(smx_evaluator evaluator, size_t count, const smx_vectors *wi, const smx_vectors *wo,
                            const smx_scalars_out *g2) {
    return of_pairs(evaluator, Quantity::G2, count, wi, wo, g2, "g2");
}

smx_status smx_evaluator_sample(smx_evaluator evaluator, size_t count, const smx_vectors *u, const smx_vectors *wo,
                                const smx_vectors_out *wi, const smx_vectors_out *fcos, const smx_scalars_out *pdf) {
    return guarded([&] {
        require_pointer(evaluator, "evaluator");
        const HostArray uniform = read(u, "u"), to_viewer = read(wo, "wo"), drawn = written(wi, "wi");
        // The kernel writes densities in any case.
        const HostArray densities = pdf ? written(pdf, "pdf") : written_scalars(nullptr, 1);
        const std::vector<HostArray> arrays = {drawn, densities, uniform, to_viewer};
        if (fcos)
            evaluator->object->sample(count, arrays, written(fcos, "fcos"));
        else
            evaluator->object->evaluate(Quantity::Sample, count, arrays);
    });
}

smx_status smx_evaluator_sample_bound(smx_evaluator evaluator, double *bound) {
    return guarded([&] {
        require_pointer(evaluator, "evaluator");
        require_pointer(bound, "bound");
        *bound = evaluator->object->drawn_bound();
    });
}

smx_status smx_evaluator_ndf(smx_evaluator evaluator, size_t count, const smx_vectors *wh, const smx_scalars_out *ndf) {
    return of_directions(evaluator, Quantity::Ndf, count, wh, "wh", ndf, "ndf");
}

smx_status smx_evaluator_sigma(smx_evaluator evaluator, size_t count, const smx_vectors *k,
                               const smx_scalars_out *sigma) {
    return of_directions(evaluator, Quantity::Sigma, count, k, "k", sigma, "sigma");
}

smx_status smx_evaluator_g1(smx_evaluator evaluator, size_t count, const smx_vectors *k, const smx_scalars_out *g1) {
    return of_directions(evaluator, Quantity::G1, count, k, "k", g1, "g1");
}
}
