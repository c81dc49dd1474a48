#include "grade.h"

#include "error.h"

namespace smx {

const char *grade_name(Grade grade) {
    return grade == Grade::Fast ? "fast" : grade == Grade::Double ? "double" : "precise";
}

void validate(Grade grade, const Context &context) {
    require(grade == Grade::Precise || grade == Grade::Fast || grade == Grade::Double, "grade is ",
            static_cast<int>(grade), "; it must be 0 (precise), 1 (fast) or 2 (double)");
    require(grade != Grade::Double || context.info().has_double, "grade is 2 (double); ", context.info().name,
            " has no cl_khr_fp64, so it must be 0 (precise) or 1 (fast)");
}

void set_arg(cl::Kernel &kernel, cl_uint index, const Displacement &displacement, Grade grade) {
    with_real(grade, [&](auto real) { kernel.setArg(index, to_device<decltype(real)>(displacement)); });
}

void set_arg(cl::Kernel &kernel, cl_uint index, const Scene &view, Grade grade) {
    with_real(grade, [&](auto real) { kernel.setArg(index, to_device<decltype(real)>(view)); });
}

} // namespace smx
