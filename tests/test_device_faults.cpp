// A device that refuses: the n-th call of OpenCL in a call of ours fails, for every n. The status says of what kind it
// was, nothing is kept of the device's memory, and the context then works as before.
#include <gtest/gtest.h>

#include <CL/cl.h>
#include <dlfcn.h>

#include <atomic>
#include <functional>

#include "support.h"

namespace {

std::atomic<long> countdown{-1}; // calls until one is refused; negative: none is
std::atomic<long> buffers{0};    // references to buffers that the library holds

bool is_refused() {
    long left = countdown.load();
    while (left >= 0)
        if (countdown.compare_exchange_weak(left, left - 1)) return left == 0;
    return false;
}

template <class Function>
Function *real(const char *name, Function *) {
    return reinterpret_cast<Function *>(dlsym(RTLD_NEXT, name));
}

} // namespace

// These stand before OpenCL's own. The library must find them: they are visible.
extern "C" {
#pragma GCC visibility push(default)

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void *host, cl_int *error) {
    static const auto next = real("clCreateBuffer", &clCreateBuffer);
    if (is_refused()) {
        *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return nullptr;
    }
    cl_mem buffer = next(context, flags, size, host, error);
    if (buffer) ++buffers;
    return buffer;
}

cl_int clRetainMemObject(cl_mem buffer) {
    static const auto next = real("clRetainMemObject", &clRetainMemObject);
    ++buffers;
    return next(buffer);
}

cl_int clReleaseMemObject(cl_mem buffer) {
    static const auto next = real("clReleaseMemObject", &clReleaseMemObject);
    --buffers;
    return next(buffer);
}

cl_kernel clCreateKernel(cl_program program, const char *name, cl_int *error) {
    static const auto next = real("clCreateKernel", &clCreateKernel);
    if (!is_refused()) return next(program, name, error);
    *error = CL_OUT_OF_HOST_MEMORY;
    return nullptr;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t *offset,
                              const size_t *global, const size_t *local, cl_uint waits, const cl_event *list,
                              cl_event *event) {
    static const auto next = real("clEnqueueNDRangeKernel", &clEnqueueNDRangeKernel);
    if (is_refused()) return CL_OUT_OF_RESOURCES;
    return next(queue, kernel, dimensions, offset, global, local, waits, list, event);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t size,
                           void *to, cl_uint waits, const cl_event *list, cl_event *event) {
    static const auto next = real("clEnqueueReadBuffer", &clEnqueueReadBuffer);
    if (is_refused()) return CL_OUT_OF_RESOURCES;
    return next(queue, buffer, blocking, offset, size, to, waits, list, event);
}

void *clEnqueueMapBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, cl_map_flags flags, size_t offset,
                         size_t size, cl_uint waits, const cl_event *list, cl_event *event, cl_int *error) {
    static const auto next = real("clEnqueueMapBuffer", &clEnqueueMapBuffer);
    if (!is_refused()) return next(queue, buffer, blocking, flags, offset, size, waits, list, event, error);
    *error = CL_MAP_FAILURE;
    return nullptr;
}

cl_int clWaitForEvents(cl_uint count, const cl_event *events) {
    static const auto next = real("clWaitForEvents", &clWaitForEvents);
    const cl_int status = next(count, events);
    return is_refused() ? CL_OUT_OF_RESOURCES : status;
}

#pragma GCC visibility pop
}

namespace {

const smx_scene scene = test::make_scene(20, 20, test::radians(60.0), {0.25, 0.25, 0.0, 0.0, 0.0});

using Call = std::function<smx_status()>;

// Calls with the first, the second, ... call of OpenCL refused until one gets through; how many did not.
int expect_refusals(const char *what, const Call &call) {
    EXPECT_SMX_OK(call()) << what; // builds what there is to build
    const long before = buffers;
    for (int n = 0; n < 10000; ++n) {
        countdown = n;
        const smx_status status = call();
        const bool was_refused = countdown < 0;
        countdown = -1;
        EXPECT_EQ(buffers, before) << what << ", call " << n;
        if (!was_refused) {
            EXPECT_SMX_OK(status) << what;
            return n;
        }
        EXPECT_TRUE(status == SMX_OUT_OF_MEMORY || status == SMX_DEVICE_ERROR)
            << what << ", call " << n << ": " << smx_status_name(status) << ", " << smx_last_error();
        EXPECT_STRNE(smx_last_error(), "");
        if (testing::Test::HasFailure()) return n;
    }
    ADD_FAILURE() << what << ": no end";
    return -1;
}

Call render_filtered(smx_material material) {
    return [=] {
        test::Image image;
        return smx_render_filtered(test::context(), material, &scene, nullptr, image.out(), nullptr);
    };
}

Call render_reference(smx_brdf brdf) {
    return [=] {
        test::Image image;
        const smx_render_options options = test::make_options(16);
        return smx_render_reference(test::context(), brdf, &scene, &options, image.out(), nullptr);
    };
}

Call render_geometric(smx_brdf brdf) {
    return [=] {
        test::Image image;
        const smx_render_options options = test::make_options(4);
        smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;
        geometric.tile = 64;
        geometric.realisations = 2;
        geometric.bounces = 1;
        return smx_render_geometric(test::context(), brdf, &scene, &options, &geometric, image.out(), nullptr);
    };
}

Call render_geometry() {
    return [] {
        test::Image image;
        return smx_render_geometry(test::context(), &scene, nullptr, image.out(), nullptr);
    };
}

constexpr float up[] = {0.0f, 0.0f, 1.0f};

// A context that copies the caller's arrays, as for a device with memory of its own.
smx_context copying_context() {
    static const test::Context copying = [] {
        smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
        options.copy_arrays = 1;
        test::Context made;
        EXPECT_SMX_OK(smx_context_create(&options, made.out()));
        return made;
    }();
    return copying;
}

Call evaluate(smx_material material, smx_context where = test::context()) {
    return [=] {
        float fcos[3];
        return smx_material_eval(where, material, &scene.displacement, SMX_G2_CORRELATED, nullptr, 1, up, up, fcos);
    };
}

Call integrate(smx_brdf brdf) {
    return [=] {
        float fcos[3];
        const smx_render_options options = test::make_options(16);
        return smx_brdf_integrate(test::context(), brdf, &scene.displacement, SMX_G2_CORRELATED, &options, 1, up, up,
                                  fcos, nullptr, nullptr);
    };
}

} // namespace

TEST(DeviceFaults, EveryRefusalIsAStatus) {
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open("builtin:conductor", brdf.out()));
    const test::Material material = test::make_material({{0.5, 0.2}, {0.5, 0.6}});
    const test::Image before = test::render_filtered(material, scene);
    EXPECT_GE(expect_refusals("smx_render_filtered", render_filtered(material)), 4);
    EXPECT_GE(expect_refusals("smx_render_reference", render_reference(brdf)), 4);
    EXPECT_GE(expect_refusals("smx_render_geometric", render_geometric(brdf)), 4);
    EXPECT_GE(expect_refusals("smx_render_geometry", render_geometry()), 3);
    EXPECT_GE(expect_refusals("smx_material_eval", evaluate(material)), 4);
    EXPECT_GE(expect_refusals("smx_material_eval, copied", evaluate(material, copying_context())), 4);
    EXPECT_GE(expect_refusals("smx_brdf_integrate", integrate(brdf)), 4);
    EXPECT_EQ(test::relrmse(test::render_filtered(material, scene), before), 0.0);
}

TEST(DeviceFaults, ARefusedBufferIsNamedWithItsSize) {
    const test::Material material = test::make_material({{1.0, 0.2}});
    ASSERT_SMX_OK(evaluate(material)());
    for (const int n : {0, 1, 2, 3}) {
        countdown = n;
        const smx_status status = evaluate(material)();
        countdown = -1;
        if (status != SMX_OUT_OF_MEMORY || std::string(smx_last_error()).find("buffer") == std::string::npos) continue;
        EXPECT_NE(std::string(smx_last_error()).find(" bytes"), std::string::npos) << smx_last_error();
        return;
    }
    FAIL() << "no buffer was refused";
}
