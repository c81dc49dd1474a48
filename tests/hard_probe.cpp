#include "hard_probe.h"

#include <cmath>
#include <limits>

#include "device_buffer.h"
#include "device_lobe.h"

namespace test {

namespace {

// Writes out[quantity][stride]. wi's own quantities are asked for where its mean plane is not turned away.
constexpr const char *probe = R"(
__kernel void probe(__global real *out, int stride, __global const float *wi, __global const float *wo, Displacement x,
                    __constant Lobe *lobes, int count, __global const float *values, __global const float *theta_d,
                    int knots, int equidistant) {
    int at = W * (int)get_global_id(0);
    PairsOfDirections d = load_pairs(wi, wo, stride, at);
    realW hx = d.ix + d.ox, hy = d.iy + d.oy, hz = d.iz + d.oz;
    realW angle = difference_angle(d.ix, d.iy, d.iz, d.ox, d.oy, d.oz);
    Curves curves = {values, theta_d, knots, equidistant};
    KnotPosition knot = knot_position(&curves, angle);
    Evaluation e = evaluation(&x, d.ix, d.iy, d.iz, d.ox, d.oy, d.oz, hx, hy, hz);
    realW p_i = fmax(mean_plane(&x, d.ix, d.iy, d.iz), (realW)0.0f);
    Slanted i = slanted(&x, d.ix, d.iy, p_i);
    intW up = hz > (realW)0.0f;
    Tilted h = tilted(&x, selectW((realW)0.0f, hx, up), selectW((realW)0.0f, hy, up), selectW((realW)1.0f, hz, up));
    __global real *to = out + at;
    RgbW f = fcos_of_pair(lobes, count, PER_LOBE, &curves, &knot, &e);
#if MASKING == 0 || SHADOWING == 0
    vstoreW(f.r, 0, to + (24 + MASKING + 2 * (1 - MASKING) * (1 - SHADOWING)) * stride);
    return;
#endif
#if PER_LOBE == 0 && HEIGHT_CORRELATION == 1
    vstoreW(selectW((realW)0.0f, mixture_ndf(lobes, count, &h), up), 0, to);
    vstoreW(mixture_sigma(lobes, count, &i), 0, to + stride);
    vstoreW(mixture_lambda(lobes, count, &i), 0, to + 2 * stride);
    vstoreW(mixture_g1(lobes, count, &i), 0, to + 3 * stride);
    vstoreW(angle, 0, to + 4 * stride);
    LaneColours white = black_lanes();
    add_coloured_by(&white, &curves, 0, &knot, (realW)1.0f);
    RgbW fresnel = rgb_of(&white);
    vstoreW(fresnel.r, 0, to + 5 * stride);
    vstoreW(fresnel.g, 0, to + 6 * stride);
    vstoreW(fresnel.b, 0, to + 7 * stride);
#endif
#if PER_LOBE == 0
    realW g2 = selectW((realW)0.0f, mixture_g2(lobes, count, &e) * e.o.p, e.visible);
    vstoreW(g2, 0, to + (9 - HEIGHT_CORRELATION) * stride);
#endif
#if HEIGHT_CORRELATION == 1
    VectorW light = {d.ix, d.iy, d.iz}, view = {d.ox, d.oy, d.oz};
    Viewer v = viewer(&x, view);
    vstoreW(drawn_density(&x, lobes, count, PER_LOBE, &v, light, view), 0, to + (22 + PER_LOBE) * stride);
#endif
    int shading = 10 + 6 * PER_LOBE + 3 * (1 - HEIGHT_CORRELATION);
    vstoreW(f.r, 0, to + shading * stride);
    vstoreW(f.g, 0, to + (shading + 1) * stride);
    vstoreW(f.b, 0, to + (shading + 2) * stride);
}
)";

const std::vector<std::string> names{"D",
                                     "sigma",
                                     "Lambda",
                                     "G1",
                                     "theta_d",
                                     "F (red)",
                                     "F (0)",
                                     "F (steep)",
                                     "G2 correlated",
                                     "G2 separable",
                                     "f cos, shared, correlated, red",
                                     "f cos, shared, correlated, 0",
                                     "f cos, shared, correlated, steep",
                                     "f cos, shared, separable, red",
                                     "f cos, shared, separable, 0",
                                     "f cos, shared, separable, steep",
                                     "f cos, per-lobe, correlated, red",
                                     "f cos, per-lobe, correlated, 0",
                                     "f cos, per-lobe, correlated, steep",
                                     "f cos, per-lobe, separable, red",
                                     "f cos, per-lobe, separable, 0",
                                     "f cos, per-lobe, separable, steep",
                                     "density of wi, shared",
                                     "density of wi, per-lobe",
                                     "f cos, shared, red: no masking",
                                     "f cos, shared, red: no shadowing",
                                     "f cos, shared, red: neither"};

smx::Material material_of(const HardCase &c, smx::Model model) {
    smx::Material m;
    m.model = model;
    for (const oracle::Lobe &lobe : c.lobes) m.lobes.push_back({lobe.weight, lobe.alpha});
    return m;
}

std::vector<float> curves_of(const HardCase &c) {
    std::vector<float> curves;
    for (std::size_t set = 0; set < c.lobes.size(); ++set)
        for (std::size_t knot = 0; knot < hard_knots; ++knot) {
            for (std::size_t channel = 0; channel < 3; ++channel) curves.push_back(hard_curve(c, set, channel)[knot]);
            curves.push_back(0.0f);
        }
    return curves;
}

} // namespace

const std::vector<std::string> &quantity_names() { return names; }

smx::Displacement displacement_of(const HardSurface &x) { return {x.alpha_x, x.alpha_y, x.rho, x.mean_x, x.mean_y}; }

cl::Kernel &HardProbe::kernel(const HardCase &c, Form form, const Parts &parts) {
    const bool is_least = form == Form::Least;
    const std::string options = smx::build_options({{"W", static_cast<int>(context_.width())},
                                                    {"GRADE", static_cast<int>(grade_)},
                                                    {"PER_LOBE", parts.per_lobe},
                                                    {"MASKING", parts.masking},
                                                    {"SHADOWING", parts.shadowing},
                                                    {"HEIGHT_CORRELATION", parts.correlated},
                                                    {"ANISOTROPY", !(is_least && c.is_isotropic())},
                                                    {"MEAN_SLOPE", !(is_least && !c.has_mean())}});
    cl::Kernel &kernel = kernels_[options];
    if (!kernel()) {
        cl::Program program(context_.cl(), smx::kernel_source("shade_filtered.cl") + smx::kernel_source("pairs.clh") +
                                               smx::kernel_source("visible_normals.clh") + probe);
        program.build(options.c_str());
        kernel = cl::Kernel(program, "probe");
    }
    return kernel;
}

template <typename Real>
void HardProbe::run_as(const HardCase &c, const std::vector<HardPair> &pairs, Form form, Values &values) {
    const std::size_t stride = smx::round_up(pairs.size(), context_.width());
    std::vector<float> planes[2] = {std::vector<float>(3 * stride), std::vector<float>(3 * stride)};
    for (std::size_t k = 0; k < stride; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            planes[0][axis * stride + k] = pairs[std::min(k, pairs.size() - 1)].wi[axis];
            planes[1][axis * stride + k] = pairs[std::min(k, pairs.size() - 1)].wo[axis];
        }
    const cl::Buffer wi = smx::buffer_from(context_, planes[0]), wo = smx::buffer_from(context_, planes[1]);
    const cl::Buffer curves = smx::buffer_from(context_, curves_of(c));
    const HardCurve theta_d = hard_theta_d(c);
    const cl::Buffer knots = smx::buffer_from(context_, std::vector<float>(theta_d.begin(), theta_d.end()));
    std::vector<Real> all(quantities * stride, std::numeric_limits<Real>::quiet_NaN());
    const cl::Buffer out = smx::empty_buffer<Real>(context_, all.size());
    context_.queue().enqueueWriteBuffer(out, CL_TRUE, 0, all.size() * sizeof(Real), all.data());
    cl::Buffer lobes[2];
    for (std::size_t model = 0; model < 2; ++model) {
        const smx::Material material = material_of(c, static_cast<smx::Model>(model));
        lobes[model] = smx::buffer_from(context_, smx::widened_lobes<Real>(material, displacement_of(c.x)));
    }
    for (const Parts &parts :
         {Parts{}, Parts{false, true, true, false}, Parts{true, true, true, true}, Parts{true, true, true, false},
          Parts{false, false, true, true}, Parts{false, true, false, true}, Parts{false, false, false, true}}) {
        cl::Kernel &k = kernel(c, form, parts);
        k.setArg(0, out);
        k.setArg(1, static_cast<cl_int>(stride));
        k.setArg(2, wi);
        k.setArg(3, wo);
        smx::set_arg(k, 4, displacement_of(c.x), grade_);
        k.setArg(5, lobes[parts.per_lobe]);
        k.setArg(6, static_cast<cl_int>(c.lobes.size()));
        k.setArg(7, curves);
        k.setArg(8, knots);
        k.setArg(9, static_cast<cl_int>(hard_knots));
        k.setArg(10, static_cast<cl_int>(c.is_equidistant));
        context_.queue().enqueueNDRangeKernel(k, cl::NullRange, cl::NDRange(stride / context_.width()));
    }
    context_.queue().enqueueReadBuffer(out, CL_TRUE, 0, all.size() * sizeof(Real), all.data());
    for (std::size_t q = 0; q < quantities; ++q)
        values[q].assign(all.begin() + static_cast<std::ptrdiff_t>(q * stride),
                         all.begin() + static_cast<std::ptrdiff_t>(q * stride + pairs.size()));
}

HardProbe::Values HardProbe::run(const HardCase &c, const std::vector<HardPair> &pairs, Form form) {
    Values values(quantities);
    smx::with_real(grade_, [&](auto real) { run_as<decltype(real)>(c, pairs, form, values); });
    return values;
}

} // namespace test
