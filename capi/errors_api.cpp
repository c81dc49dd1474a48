// smx_brdf_compare, smx_material_brdf_errors, smx_baseline_fit
#include <algorithm>

#include "baseline.h"
#include "brdf_errors.h"
#include "handles.h"

using namespace smx;

namespace {

smx_brdf_errors to_c(const BrdfErrors &e) {
    return {sizeof(smx_brdf_errors), e.all.l2, e.all.log, e.all.cube_root, e.within.l2, e.within.log,
            e.within.cube_root};
}

} // namespace

extern "C" {

smx_status smx_brdf_compare(smx_brdf brdf, smx_brdf reference, smx_brdf_errors *errors) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        require_pointer(reference, "reference");
        check_output(errors, "errors");
        *errors = to_c(brdf_errors(*brdf->object, *reference->object));
    });
}

smx_status smx_material_brdf_errors(smx_material material, smx_brdf reference, smx_brdf_errors *errors) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(reference, "reference");
        check_output(errors, "errors");
        *errors = to_c(brdf_errors(*material->object, *reference->object));
    });
}

smx_status smx_baseline_fit(smx_brdf brdf, smx_baseline kind, smx_baseline_report *report) {
    return guarded([&] {
        require_pointer(brdf, "brdf");
        check_output(report, "report");
        check_output(&report->errors, "report->errors");
        const BaselineFit fit = fit_baseline(*brdf->object, static_cast<Baseline>(kind));
        report->alpha = fit.alpha;
        std::copy(fit.f0.begin(), fit.f0.end(), report->f0);
        std::copy(fit.f90.begin(), fit.f90.end(), report->f90);
        std::copy(fit.kd.begin(), fit.kd.end(), report->kd);
        report->residual = fit.residual;
        report->iterations = fit.iterations;
        copy_text(report->message, fit.message);
        report->seconds = fit.seconds;
        report->errors = to_c(fit.errors);
    });
}
}
