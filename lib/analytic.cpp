#include "analytic.h"

#include <algorithm>
#include <numbers>

#include "error.h"
#include "microfacet.h"
#include "parameters.h"
#include "projected_area.h"
#include "table_sampling.h"

namespace smx {

namespace {

constexpr NumberRange alpha_range = {1e-3, 10.0}, exponent_range = {0.0, 1e6}, share_range = {0.0, 1.0};

Rgb with_fresnel(const Rgb &f0, const Cosines &at, double lobe) {
    return {schlick(at.d, f0[0]) * lobe, schlick(at.d, f0[1]) * lobe, schlick(at.d, f0[2]) * lobe};
}

BrdfFormula beckmann(const Parameters &p) {
    p.expect({"alpha", "f0"});
    return [alpha = p.number("alpha", alpha_range), f0 = p.colour("f0", share_range)](const Cosines &at) {
        return with_fresnel(f0, at, beckmann_lobe(at, alpha));
    };
}

BrdfFormula ggx(const Parameters &p) {
    p.expect({"alpha", "f0"});
    return [alpha = p.number("alpha", alpha_range), f0 = p.colour("f0", share_range)](const Cosines &at) {
        const double ndf = ggx_ndf(at.h, alpha);
        return with_fresnel(f0, at, smith_lobe(at, ndf, ggx_sigma(at.i, alpha), ggx_sigma(at.o, alpha)));
    };
}

BrdfFormula blinn_phong(const Parameters &p) {
    p.expect({"exponent", "f0"});
    const double exponent = p.number("exponent", exponent_range);
    const ProjectedArea sigma([exponent](double cos_h) { return blinn_phong_ndf(cos_h, exponent); });
    return [exponent, sigma, f0 = p.colour("f0", share_range)](const Cosines &at) {
        return with_fresnel(f0, at, smith_lobe(at, blinn_phong_ndf(at.h, exponent), sigma(at.i), sigma(at.o)));
    };
}

BrdfFormula lambert(const Parameters &p) {
    p.expect({"albedo"});
    Rgb f = p.colour("albedo", share_range);
    for (double &value : f) value *= std::numbers::inv_pi;
    return [f](const Cosines &) { return f; };
}

BrdfFormula formula_of(const Parameters &p) {
    if (p.kind() == "beckmann") return beckmann(p);
    if (p.kind() == "ggx") return ggx(p);
    if (p.kind() == "blinn-phong") return blinn_phong(p);
    if (p.kind() == "lambert") return lambert(p);
    fail(Fault::InvalidArgument, "no analytic material \"", p.kind(),
         "\"; there are beckmann, ggx, blinn-phong and lambert");
}

} // namespace

Brdf make_analytic(const std::string &specification) {
    std::string name = specification;
    std::replace(name.begin(), name.end(), '/', '_');
    return sample_table(name, std::string(analytic_prefix) + specification, formula_of(Parameters(specification)));
}

} // namespace smx
