// slopemix_opencl.h: contexts on the caller's queue, evaluations on the caller's buffers, waiting for and giving
// events.
#include <gtest/gtest.h>

#include "directions.h"
#include "random.h"
#include "slopemix_opencl.h"
#include "support.h"

namespace {

using Evaluator = test::Handle<smx_evaluator, smx_evaluator_release>;

// OpenCL objects of a caller who knows nothing of slopemix.
struct Caller {
    cl_device_id device = nullptr;
    cl_context context = nullptr;
    cl_command_queue queue = nullptr;

    Caller() {
        test::Context borrowed; // tells a device
        EXPECT_SMX_OK(smx_context_create(nullptr, borrowed.out()));
        EXPECT_SMX_OK(smx_context_get_opencl(borrowed, nullptr, nullptr, &device));
        cl_int error = CL_SUCCESS;
        context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &error);
        EXPECT_EQ(error, CL_SUCCESS);
        queue = clCreateCommandQueue(context, device, 0, &error);
        EXPECT_EQ(error, CL_SUCCESS);
    }
    ~Caller() {
        clReleaseCommandQueue(queue);
        clReleaseContext(context);
    }
    Caller(const Caller &) = delete;
    Caller &operator=(const Caller &) = delete;

    cl_mem buffer(std::size_t floats, const float *from = nullptr) const {
        cl_int error = CL_SUCCESS;
        const cl_mem b = clCreateBuffer(context, CL_MEM_READ_WRITE | (from ? cl_mem_flags{CL_MEM_COPY_HOST_PTR} : 0),
                                        floats * sizeof(float), const_cast<float *>(from), &error);
        EXPECT_EQ(error, CL_SUCCESS);
        return b;
    }
    std::vector<float> contents(cl_mem b, std::size_t floats, cl_event after) const {
        std::vector<float> values(floats);
        EXPECT_EQ(clEnqueueReadBuffer(queue, b, CL_TRUE, 0, floats * sizeof(float), values.data(), 1, &after, nullptr),
                  CL_SUCCESS);
        return values;
    }
};

cl_int references(cl_mem b) {
    cl_uint count = 0;
    clGetMemObjectInfo(b, CL_MEM_REFERENCE_COUNT, sizeof count, &count, nullptr);
    return static_cast<cl_int>(count);
}

struct Fixture {
    Caller caller;
    test::Context context;
    test::Material material =
        test::make_per_lobe_material({{0.5, 0.1}, {0.5, 0.4}}, {{0.9, 0.5, 0.2}, {0.1, 0.2, 0.3}});
    smx_displacement x = {0.3, 0.2, 0.4, 0.0, 0.1};
    Evaluator evaluator;

    Fixture() {
        smx_context_options options = SMX_CONTEXT_OPTIONS_INIT;
        options.cl_context = caller.context;
        options.cl_queue = caller.queue;
        EXPECT_SMX_OK(smx_context_create(&options, context.out()));
        EXPECT_SMX_OK(smx_evaluator_create(context, material, &x, SMX_G2_CORRELATED, nullptr, evaluator.out()));
    }
};

constexpr std::size_t count = 1001;

test::Directions some_directions() {
    test::Random random(21);
    test::Directions d;
    while (d.count() < count) d.add(random.direction(), random.direction(0.2));
    return d;
}

} // namespace

TEST(Interop, EvaluatesOnTheCallersBuffers) {
    Fixture f;
    const test::Directions d = some_directions();
    std::vector<float> wanted(3 * count), wanted_pdf(count), wanted_g2(count), wanted_ndf(count);
    const smx_vectors i = SMX_PACKED(d.wi.data()), o = SMX_PACKED(d.wo.data());
    const smx_vectors_out fcos_out = SMX_PACKED(wanted.data());
    const smx_scalars_out outs[] = {{wanted_pdf.data(), 1}, {wanted_g2.data(), 1}, {wanted_ndf.data(), 1}};
    ASSERT_SMX_OK(smx_evaluator_eval(f.evaluator, count, &i, &o, &fcos_out));
    ASSERT_SMX_OK(smx_evaluator_pdf(f.evaluator, count, &i, &o, &outs[0]));
    ASSERT_SMX_OK(smx_evaluator_g2(f.evaluator, count, &i, &o, &outs[1]));
    ASSERT_SMX_OK(smx_evaluator_ndf(f.evaluator, count, &i, &outs[2]));

    // wi packed as float4, wo and f cos packed in one buffer with the densities, as structs of 7 floats.
    std::vector<float> fours(4 * count), structs(7 * count + 2, -5.0f);
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
            fours[4 * k + c] = d.wi[3 * k + c];
            structs[2 + 7 * k + c] = d.wo[3 * k + c];
        }
    const cl_mem first = f.caller.buffer(fours.size(), fours.data());
    const cl_mem second = f.caller.buffer(structs.size(), structs.data());
    const cl_mem third = f.caller.buffer(2 * count);
    const smx_cl_vectors wi = SMX_CL_PACKED(first, 4), wo = {second, second, second, 2, 3, 4, 7};
    const smx_cl_vectors fcos = {second, second, second, 5, 6, 7, 7};
    const smx_cl_scalars pdf = {second, 8, 7}, g2 = {third, 0, 1}, ndf = {third, count, 1};
    cl_event done[4] = {};
    ASSERT_SMX_OK(smx_enqueue_eval(f.evaluator, count, &wi, &wo, &fcos, 0, nullptr, &done[0]));
    ASSERT_SMX_OK(smx_enqueue_of_pairs(f.evaluator, SMX_QUANTITY_PDF, count, &wi, &wo, &pdf, 1, &done[0], &done[1]));
    ASSERT_SMX_OK(smx_enqueue_of_pairs(f.evaluator, SMX_QUANTITY_G2, count, &wi, &wo, &g2, 2, done, &done[2]));
    ASSERT_SMX_OK(smx_enqueue_of_directions(f.evaluator, SMX_QUANTITY_NDF, count, &wi, &ndf, 0, nullptr, &done[3]));
    const std::vector<float> got = f.caller.contents(second, structs.size(), done[3]);
    const std::vector<float> got_third = f.caller.contents(third, 2 * count, done[3]);
    for (std::size_t k = 0; k < count; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(got[5 + 7 * k + c], wanted[3 * k + c]) << k;
            EXPECT_EQ(got[2 + 7 * k + c], d.wo[3 * k + c]);
        }
        EXPECT_EQ(got[8 + 7 * k], wanted_pdf[k]);
        EXPECT_EQ(got_third[k], wanted_g2[k]);
        EXPECT_EQ(got_third[count + k], wanted_ndf[k]);
    }
    EXPECT_EQ(got[0], -5.0f);
    for (const cl_event e : done) clReleaseEvent(e);

    // Nothing holds the buffers but the caller, once kernels have other arguments and the evaluator is gone.
    f.evaluator = Evaluator();
    f.context = test::Context();
    clFinish(f.caller.queue);
    for (const cl_mem b : {first, second, third}) {
        EXPECT_EQ(references(b), 1);
        clReleaseMemObject(b);
    }
}

TEST(Interop, WaitsForEventsAndDoesNotBlock) {
    Fixture f;
    ASSERT_SMX_OK(smx_evaluator_build(f.evaluator, SMX_QUANTITY_ALL));
    const test::Directions d = some_directions();
    const cl_mem wi_buffer = f.caller.buffer(3 * count), wo_buffer = f.caller.buffer(3 * count, d.wo.data());
    test::Random random(22);
    std::vector<float> numbers(3 * count);
    for (float &number : numbers) number = static_cast<float>(random.uniform());
    const cl_mem u = f.caller.buffer(3 * count, numbers.data()), drawn_buffer = f.caller.buffer(3 * count);
    const cl_mem values = f.caller.buffer(3 * count), densities = f.caller.buffer(count);
    const smx_cl_vectors wi = SMX_CL_PACKED(wi_buffer, 3), wo = SMX_CL_PACKED(wo_buffer, 3);
    const smx_cl_vectors uniform = SMX_CL_PACKED(u, 3), drawn = SMX_CL_PLANES(drawn_buffer, count);
    const smx_cl_vectors fcos = SMX_CL_PLANES(values, count);
    const smx_cl_scalars pdf = {densities, 0, 1};

    // Held by an event that only the caller sets: the call returns all the same, and what it enqueued has not begun.
    cl_int error = CL_SUCCESS;
    const cl_event gate = clCreateUserEvent(f.caller.context, &error);
    ASSERT_EQ(error, CL_SUCCESS);
    cl_event eval_done = nullptr, sample_done = nullptr;
    ASSERT_SMX_OK(smx_enqueue_eval(f.evaluator, count, &wi, &wo, &fcos, 1, &gate, &eval_done));
    ASSERT_SMX_OK(smx_enqueue_sample(f.evaluator, count, &uniform, &wo, &drawn, &pdf, 0, nullptr, &sample_done));
    cl_int state = CL_COMPLETE;
    clGetEventInfo(eval_done, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state, nullptr);
    EXPECT_NE(state, CL_COMPLETE);

    // The evaluator may go meanwhile.
    f.evaluator = Evaluator();
    clSetUserEventStatus(gate, CL_COMPLETE);
    const std::vector<float> pdfs = f.caller.contents(densities, count, sample_done);
    const std::vector<float> planes = f.caller.contents(drawn_buffer, 3 * count, sample_done);
    for (std::size_t k = 0; k < count; ++k) {
        EXPECT_GT(pdfs[k], 0.0f);
        const oracle::Vec v = {planes[k], planes[count + k], planes[2 * count + k]};
        EXPECT_NEAR(oracle::dot(v, v), 1.0, 1e-5);
    }
    for (const cl_event e : {gate, eval_done, sample_done}) clReleaseEvent(e);
    for (const cl_mem b : {wi_buffer, wo_buffer, u, drawn_buffer, values, densities}) clReleaseMemObject(b);
}

TEST(Interop, RefusesWhatIsNotOfTheContextOrTooSmall) {
    Fixture f;
    const Caller other;
    const cl_mem good = f.caller.buffer(3 * count), foreign = other.buffer(3 * count);
    const smx_cl_vectors v = SMX_CL_PACKED(good, 3), far = SMX_CL_PACKED(foreign, 3), none = SMX_CL_PACKED(nullptr, 3);
    const smx_cl_vectors flat = SMX_CL_PACKED(good, 0), wide = SMX_CL_PACKED(good, 4);
    const smx_cl_vectors late = {good, good, good, 0, 1, 3 * count, 3};
    const smx_cl_vectors huge = SMX_CL_PACKED(good, SIZE_MAX / 2);
    const auto eval = [&](const smx_cl_vectors *wi, const smx_cl_vectors *fcos, cl_uint wait_count = 0,
                          const cl_event *wait = nullptr) {
        return smx_enqueue_eval(f.evaluator, count, wi, &v, fcos, wait_count, wait, nullptr);
    };
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "evaluator", smx_enqueue_eval(nullptr, 1, &v, &v, &v, 0, nullptr, nullptr));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "wi is null", eval(nullptr, &v));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "fcos is null", eval(&v, nullptr));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "another cl_context", eval(&far, &v));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "buffer that is null", eval(&none, &v));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "stride is 0", eval(&flat, &v));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "has 3003 floats; offset 0, stride 4 and count 1001", eval(&v, &wide));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "offset 3003", eval(&v, &late));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "go beyond", eval(&v, &huge));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "wait is null", eval(&v, &v, 1, nullptr));
    const cl_event no_event = nullptr;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "wait[0] is null", eval(&v, &v, 1, &no_event));
    const smx_cl_scalars out = {good, 0, 1};
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "quantity is 8; it must be SMX_QUANTITY_PDF or SMX_QUANTITY_G2",
                     smx_enqueue_of_pairs(f.evaluator, SMX_QUANTITY_NDF, 1, &v, &v, &out, 0, nullptr, nullptr));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "quantity is 2",
                     smx_enqueue_of_directions(f.evaluator, SMX_QUANTITY_PDF, 1, &v, &out, 0, nullptr, nullptr));
    // None at all is legal, and has an end.
    cl_event done = nullptr;
    ASSERT_SMX_OK(smx_enqueue_eval(f.evaluator, 0, &v, &v, &v, 0, nullptr, &done));
    EXPECT_EQ(clWaitForEvents(1, &done), CL_SUCCESS);
    clReleaseEvent(done);
    clReleaseMemObject(good);
    clReleaseMemObject(foreign);
}
