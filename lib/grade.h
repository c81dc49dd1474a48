// How exact a kernel's arithmetic is (cl/vec.clh), chosen at its build, and the arguments whose type depends on it.
#pragma once

#include "context.h"
#include "scene.h"

namespace smx {

// As GRADE in cl/vec.clh.
enum class Grade { Precise = 0, Fast = 1, Double = 2 };

const char *grade_name(Grade grade);

// Throws InvalidArgument, naming value and range, or the device that has no doubles.
void validate(Grade grade, const Context &context);

// Calls use(0.0f) or use(0.0): the grade's `real`, as a type to build arguments of.
template <typename Use>
auto with_real(Grade grade, Use use) {
    return grade == Grade::Double ? use(0.0) : use(0.0f);
}

void set_arg(cl::Kernel &kernel, cl_uint index, const Displacement &displacement, Grade grade);
void set_arg(cl::Kernel &kernel, cl_uint index, const Scene &view, Grade grade);

} // namespace smx
