// Contexts: the device by default, by number and by name; the caller's own OpenCL objects; many threads.
#include <gtest/gtest.h>

#include <CL/cl.h>

#include <cctype>
#include <chrono>
#include <cstring>
#include <thread>

#include "support.h"

namespace {

smx_device_info first_device() {
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    EXPECT_SMX_OK(smx_device_get_info(0, &info));
    return info;
}

smx_status create(const char *device, smx_context *context) {
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.device = device;
    return smx_context_create(&options, context);
}

const smx_scene scene = test::make_scene(31, 31, test::radians(60.0), {0.25, 0.25, 0.0, 0.0, 0.0});

test::Image render(smx_context context) {
    return test::render_filtered(test::make_material({{1.0, 0.2}}), scene, context);
}

// A context and queue of the caller's, made with OpenCL alone on slopemix's first device.
struct Foreign {
    cl_context context = nullptr;
    cl_command_queue queue = nullptr;

    Foreign() {
        cl_platform_id platform = nullptr;
        cl_device_id device = nullptr;
        EXPECT_EQ(clGetPlatformIDs(1, &platform, nullptr), CL_SUCCESS);
        EXPECT_EQ(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr), CL_SUCCESS);
        context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
        queue = clCreateCommandQueueWithProperties(context, device, nullptr, nullptr);
    }
    Foreign(const Foreign &) = delete;
    Foreign &operator=(const Foreign &) = delete;
    ~Foreign() {
        clReleaseCommandQueue(queue);
        clReleaseContext(context);
    }

    cl_uint queue_references() const {
        cl_uint count = 0;
        EXPECT_EQ(clGetCommandQueueInfo(queue, CL_QUEUE_REFERENCE_COUNT, sizeof count, &count, nullptr), CL_SUCCESS);
        return count;
    }
};

} // namespace

TEST(Context, DevicesDescribeThemselves) {
    uint32_t count = 0;
    ASSERT_SMX_OK(smx_device_count(&count));
    ASSERT_GT(count, 0u);
    for (uint32_t k = 0; k < count; ++k) {
        smx_device_info info = SMX_DEVICE_INFO_INIT;
        ASSERT_SMX_OK(smx_device_get_info(k, &info));
        EXPECT_EQ(info.index, k);
        EXPECT_STRNE(info.name, "");
        EXPECT_STRNE(info.platform, "");
        EXPECT_EQ(std::string(info.version).rfind("OpenCL", 0), 0u) << info.version;
        EXPECT_GT(info.compute_units, 0u);
        EXPECT_GT(info.global_memory, 0u);
        EXPECT_TRUE(info.vector_width == 1 || info.vector_width == 4 || info.vector_width == 8 ||
                    info.vector_width == 16);
    }
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    EXPECT_SMX_FAILS(SMX_NO_DEVICE, std::to_string(count), smx_device_get_info(count, &info));
}

TEST(Context, DeviceByNumberAndByName) {
    std::string upper = first_device().name;
    for (char &c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    for (const std::string &choice : {std::string("0"), std::string(first_device().name), upper, upper.substr(1, 4)}) {
        test::Context context;
        ASSERT_SMX_OK(create(choice.c_str(), context.out())) << choice;
        smx_device_info info = SMX_DEVICE_INFO_INIT;
        ASSERT_SMX_OK(smx_context_get_info(context, &info));
        EXPECT_STREQ(info.name, first_device().name);
    }
}

TEST(Context, UnknownDevicesAreRefused) {
    smx_context context = nullptr;
    for (const char *choice : {"no such device", "9999", "99999999999999999999"})
        EXPECT_SMX_FAILS(SMX_NO_DEVICE, choice, create(choice, &context));
    EXPECT_EQ(context, nullptr);
}

TEST(Context, TakesTheCallersContextAndQueue) {
    const Foreign foreign;
    const cl_uint before = foreign.queue_references();
    {
        smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
        options.cl_context = foreign.context;
        options.cl_queue = foreign.queue;
        test::Context context;
        ASSERT_SMX_OK(smx_context_create(&options, context.out()));
        EXPECT_GT(foreign.queue_references(), before);
        EXPECT_EQ(test::relrmse(render(context), render(test::context())), 0.0);
    }
    EXPECT_EQ(clFinish(foreign.queue), CL_SUCCESS);
    // PoCL's own threads may hold the queue for a moment after its last command.
    for (int wait = 0; wait < 200 && foreign.queue_references() != before; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(foreign.queue_references(), before);
}

TEST(Context, HalfOfTheCallersPairIsRefused) {
    const Foreign foreign;
    smx_context context = nullptr;
    smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
    options.cl_context = foreign.context;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "cl_queue", smx_context_create(&options, &context));
    options.cl_context = nullptr;
    options.cl_queue = foreign.queue;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "cl_context", smx_context_create(&options, &context));
    options.cl_context = foreign.context;
    options.device = "0";
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "device", smx_context_create(&options, &context));
    // A queue of another context is not a pair.
    const Foreign other;
    options.device = nullptr;
    options.cl_queue = other.queue;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "cl_queue", smx_context_create(&options, &context));
    EXPECT_EQ(context, nullptr);
}

TEST(Context, ThreadsMayShareOne) {
    const test::Image wanted = render(test::context());
    std::vector<double> errors(4, -1.0);
    std::vector<std::thread> threads;
    for (double &error : errors)
        threads.emplace_back([&error, &wanted] {
            for (int k = 0; k < 5; ++k) error = test::relrmse(render(test::context()), wanted);
        });
    for (std::thread &t : threads) t.join();
    for (const double e : errors) EXPECT_EQ(e, 0.0);
}

TEST(Context, ErrorsBelongToTheirThread) {
    ASSERT_EQ(smx_device_count(nullptr), SMX_INVALID_ARGUMENT);
    const std::string here = smx_last_error();
    EXPECT_FALSE(here.empty());
    std::string there = "unset";
    std::thread([&there] { there = smx_last_error(); }).join();
    EXPECT_EQ(there, "");
    EXPECT_EQ(smx_last_error(), here);
}
