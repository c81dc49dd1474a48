#include "proposal.h"

#include "fit_material.h"

namespace smx {

const std::vector<Lobe> &Proposal::lobes() {
    std::call_once(fitted_, [&] {
        FitOptions options;
        options.model = Model::Shared;
        lobes_ = fit_material(invert(*brdf_, {}), options).lobes;
    });
    return lobes_;
}

} // namespace smx
