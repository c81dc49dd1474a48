// Launch of shading_builtin.cl.
#include "shading.h"

ShadingResult ShadingBuiltin::shade(const ShadingCase &what) {
    ShadingResult result{0.0, std::vector<float>(4 * shading_side * shading_side)};
    std::vector<ShadingLobe> lobes = what.lobes;
    const cl::Buffer rgba(kernel_.context(), CL_MEM_WRITE_ONLY, result.rgba.size() * sizeof(float));
    const cl::Buffer lobe_buffer(kernel_.context(), lobes.begin(), lobes.end(), true);
    kernel_.kernel().setArg(0, rgba);
    kernel_.kernel().setArg(1, cl_int{shading_side});
    kernel_.kernel().setArg(2, shading_alpha_x);
    kernel_.kernel().setArg(3, shading_alpha_y);
    kernel_.kernel().setArg(4, lobe_buffer);
    kernel_.kernel().setArg(5, static_cast<cl_int>(lobes.size()));
    kernel_.kernel().setArg(6, cl_int{what.per_lobe});
    result.seconds = kernel_.run(cl::NDRange(shading_side, shading_side));
    kernel_.queue().enqueueReadBuffer(rgba, CL_TRUE, 0, result.rgba.size() * sizeof(float), result.rgba.data());
    return result;
}
