#include "fit_error.h"

#include "error.h"

namespace smx {

double predicted_fit_error(const Material &material) {
    if (!(material.report.base_relrmse > 0.0))
        fail(Fault::NoSolution, material.name,
             " was not fitted to a table: nothing is known of its error. Give the table too");
    return material.report.base_relrmse;
}

} // namespace smx
