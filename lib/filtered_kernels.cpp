#include "filtered_kernels.h"

#include <algorithm>

#include "device_buffer.h"
#include "device_lobe.h"
#include "widening.h"

namespace smx {

FilteredKernels::FilteredKernels(const Material &material, const Displacement &x, Effects on,
                                 const std::vector<int> &orders, Grade grade)
    : widened(std::any_of(orders.begin(), orders.end(), [](int order) { return order > 0; })),
      defines(effect_defines(on)) {
    defines["PER_LOBE"] = material.model == Model::PerLobe;
    defines["GRADE"] = static_cast<int>(grade);
    if (widened) defines["WIDENING"] = rough_axes(x);
}

cl::Kernel FilteredKernels::kernel(Context &device, const std::string &what) const {
    const std::string name = widened ? "shade_widened" : "shade_filtered";
    return device.kernel(name + ".cl", name + '_' + what, defines);
}

cl::Buffer lobe_buffer(const Context &context, const Material &material, const Displacement &x, Grade grade,
                       LobeWeight which) {
    return with_real(
        grade, [&](auto real) { return buffer_from(context, widened_lobes<decltype(real)>(material, x, which)); });
}

} // namespace smx
