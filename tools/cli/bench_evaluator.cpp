// Evaluators on the host's arrays: the whole call beside the kernel alone, on buffers that are there already.
#include <chrono>
#include <cmath>
#include <random>

#include "bench_job.h"
#include "shading.h"
#include "slopemix_opencl.h"

namespace slopemix::cli {

namespace {

constexpr std::size_t pairs = std::size_t{1} << 20;
constexpr int runs_per_round = 5;

std::vector<float> random_numbers(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> numbers(3 * pairs);
    for (float &number : numbers) number = 0x1p-24f * static_cast<float>(random() >> 8);
    return numbers;
}

// Uniform over the hemisphere but for the last degrees.
std::vector<float> directions(unsigned seed) {
    std::vector<float> d = random_numbers(seed);
    for (std::size_t k = 0; k < pairs; ++k) {
        const float z = 0.02f + 0.98f * d[3 * k], phi = 6.2831853f * d[3 * k + 1], r = std::sqrt(1.0f - z * z);
        d[3 * k] = r * std::cos(phi), d[3 * k + 1] = r * std::sin(phi), d[3 * k + 2] = z;
    }
    return d;
}

// A buffer of a context's, its contents those of `from`.
class Buffer {
  public:
    Buffer(cl_context context, const std::vector<float> &from) {
        cl_int error = CL_SUCCESS;
        buffer_ = clCreateBuffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, from.size() * sizeof(float),
                                 const_cast<float *>(from.data()), &error);
        if (error != CL_SUCCESS) throw CommandError("no buffer: OpenCL error " + std::to_string(error));
    }
    ~Buffer() { clReleaseMemObject(buffer_); }
    Buffer(const Buffer &) = delete;
    Buffer &operator=(const Buffer &) = delete;
    smx_cl_vectors vectors() const { return SMX_CL_PACKED(buffer_, 3); }
    smx_cl_scalars scalars() const { return {buffer_, 0, 1}; }

  private:
    cl_mem buffer_;
};

// Seconds on the device of what an event ends; releases it.
double seconds_of(cl_event event) {
    clWaitForEvents(1, &event);
    cl_ulong start = 0, end = 0;
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr);
    clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr);
    clReleaseEvent(event);
    return 1e-9 * static_cast<double>(end - start);
}

template <typename Call>
double seconds_of_call(Call call) {
    const auto start = std::chrono::steady_clock::now();
    check(call());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Arrays {
    std::vector<float> wi = directions(1), wo = directions(2), u = random_numbers(3), fcos = u, pdf = u;
};

// A row: the call, and what it enqueues alone.
template <typename Call, typename Enqueue>
void add_row(BenchJob &job, const std::string &name, smx_grade grade, Call call, Enqueue enqueue) {
    const auto kernel = [&] {
        cl_event event = nullptr;
        check(enqueue(&event));
        return seconds_of(event);
    };
    seconds_of_call(call), kernel(); // compile
    Times whole, alone;
    for (int run = 0; run < runs_per_round * job.rounds; ++run) {
        whole.add(seconds_of_call(call), pairs);
        alone.add(kernel(), pairs);
    }
    job.rows.push_back({name, grade, whole.median(), "kernel-alone", alone.median()});
}

void bench_grade(BenchJob &job, const Material &material, smx_grade grade, Arrays &a) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    options.grade = grade;
    const smx_displacement x = {0.25, 0.25, 0.0, 0.0, 0.0};
    const Evaluator evaluator =
        acquire<Evaluator>(smx_evaluator_create, job.context.get(), material.get(), &x, SMX_G2_CORRELATED, &options);
    cl_context context = nullptr;
    check(smx_context_get_opencl(job.context.get(), &context, nullptr, nullptr));
    const Buffer wi_buffer(context, a.wi), wo_buffer(context, a.wo), u_buffer(context, a.u), out(context, a.fcos);
    const Buffer values(context, a.pdf);
    const smx_cl_vectors on_wi = wi_buffer.vectors(), on_wo = wo_buffer.vectors(), on_u = u_buffer.vectors();
    const smx_cl_vectors on_out = out.vectors();
    const smx_cl_scalars on_values = values.scalars();
    const smx_vectors wi = SMX_PACKED(a.wi.data()), wo = SMX_PACKED(a.wo.data()), u = SMX_PACKED(a.u.data());
    const smx_vectors_out fcos = SMX_PACKED(a.fcos.data());
    const smx_scalars_out pdf = {a.pdf.data(), 1};
    const smx_evaluator e = evaluator.get();
    add_row(
        job, "evaluator.eval.per-lobe.n8", grade, [&] { return smx_evaluator_eval(e, pairs, &wi, &wo, &fcos); },
        [&](cl_event *end) { return smx_enqueue_eval(e, pairs, &on_wi, &on_wo, &on_out, 0, nullptr, end); });
    add_row(
        job, "evaluator.pdf.per-lobe.n8", grade, [&] { return smx_evaluator_pdf(e, pairs, &wi, &wo, &pdf); },
        [&](cl_event *end) {
            return smx_enqueue_of_pairs(e, SMX_QUANTITY_PDF, pairs, &on_wi, &on_wo, &on_values, 0, nullptr, end);
        });
    add_row(
        job, "evaluator.sample.per-lobe.n8", grade,
        [&] { return smx_evaluator_sample(e, pairs, &u, &wo, &fcos, nullptr, &pdf); },
        [&](cl_event *end) {
            return smx_enqueue_sample(e, pairs, &on_u, &on_wo, &on_out, &on_values, 0, nullptr, end);
        });
}

// A renderer's beginning and one glance: a context, a material, ten directions.
double seconds_to_begin(const ShadingCase &what, smx_context existing, Arrays &a) {
    return seconds_of_call([&] {
        const Context made = existing ? nullptr : acquire<Context>(smx_context_create, nullptr);
        const Material material = acquire<Material>([&](smx_material *m) { return make_material(what, m); });
        const smx_displacement x = {0.25, 0.25, 0.0, 0.0, 0.0};
        const Evaluator evaluator = acquire<Evaluator>(smx_evaluator_create, existing ? existing : made.get(),
                                                       material.get(), &x, SMX_G2_CORRELATED, nullptr);
        const smx_vectors wi = SMX_PACKED(a.wi.data()), wo = SMX_PACKED(a.wo.data());
        const smx_vectors_out fcos = SMX_PACKED(a.fcos.data());
        return smx_evaluator_eval(evaluator.get(), 10, &wi, &wo, &fcos);
    });
}

void bench_beginning(BenchJob &job, const ShadingCase &what, Arrays &a) {
    Times second, same;
    for (int run = 0; run < job.rounds; ++run) {
        second.add(seconds_to_begin(what, nullptr, a), 1.0);
        same.add(seconds_to_begin(what, job.context.get(), a), 1.0);
    }
    job.rows.push_back(
        {"evaluator.second-context.n8", SMX_GRADE_PRECISE, second.median(), "same-context", same.median()});
}

} // namespace

void bench_evaluator(BenchJob &job) {
    const ShadingCase what = shading_case(true, 8);
    const Material material = acquire<Material>([&](smx_material *made) { return make_material(what, made); });
    Arrays arrays;
    bench_beginning(job, what, arrays);
    for (const smx_grade grade : bench_grades) {
        job.progress.start("evaluators", 1.0);
        bench_grade(job, material, grade, arrays);
        job.progress.finish();
    }
}

} // namespace slopemix::cli
