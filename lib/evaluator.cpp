#include "evaluator.h"

#include <algorithm>
#include <array>

#include "choose_effects.h"
#include "device_buffer.h"
#include "error.h"
#include "packed_material.h"
#include "widening.h"

namespace smx {

namespace {

// Elements of one launch: kernels count in int, and copies, where arrays are copied, stay small.
constexpr std::size_t part_size = std::size_t{1} << 22;

// A quantity's kernel, what its lobes count, and the coordinates of its arrays in their order.
struct Form {
    const char *kernel; // of cl/evaluate.cl; null: of filtered shading
    LobeWeight weights;
    std::vector<std::size_t> coordinates;
};

const Form &form_of(Quantity quantity) {
    static const std::array<Form, 7> forms = {{{nullptr, LobeWeight::Model, {3, 3, 3}},
                                               {"evaluate_pdf", LobeWeight::Drawn, {1, 3, 3}},
                                               {"evaluate_sample", LobeWeight::Drawn, {3, 1, 3, 3}},
                                               {"evaluate_ndf", LobeWeight::Surface, {1, 3}},
                                               {"evaluate_sigma", LobeWeight::Surface, {1, 3}},
                                               {"evaluate_g1", LobeWeight::Surface, {1, 3}},
                                               {"evaluate_g2", LobeWeight::Surface, {1, 3, 3}}}};
    return forms[static_cast<std::size_t>(quantity)];
}

// Arguments of the arrays, a buffer for each coordinate and their places, and of the number of elements.
cl_uint array_arguments(const Form &form) {
    cl_uint count = 1;
    for (const std::size_t coordinates : form.coordinates) count += static_cast<cl_uint>(coordinates) + 1;
    return count;
}

int checked_order(const RenderOptions &options) {
    validate_widening(options);
    require(options.widening_order != widening_auto, "widening_order is -1 (auto); for pairs it must be 0..",
            max_widening_order);
    return options.widening_order;
}

const Displacement &checked(const Displacement &x) {
    validate(x);
    return x;
}

Effects checked_effects(const Material &material, const RenderOptions &options, Masking masking) {
    validate(masking);
    return everything(material, options.effects, masking).on;
}

} // namespace

Evaluator::Evaluator(Context &context, const Material &material, const Displacement &displacement, Masking masking,
                     const RenderOptions &options)
    : context_(context),
      on_(checked_effects(material, options, masking)),
      material_(simplified(material, on_)),
      displacement_(simplified(checked(displacement), on_)),
      grade_(options.grade),
      orders_(fixed_orders(material_, displacement_, checked_order(options))),
      kernels_(material_, displacement_, on_, orders_, grade_) {
    validate(grade_, context);
}

double Evaluator::drawn_bound() const { return smx::drawn_bound(material_); }

cl::Kernel &Evaluator::kernel(Quantity quantity) {
    if (const auto found = built_.find(quantity); found != built_.end()) return found->second.kernel;
    const Form &form = form_of(quantity);
    Defines defines = kernels_.defines;
    for (const char *only_of_fcos : {"FRESNEL", "WIDENING"}) defines.erase(only_of_fcos);
    cl::Kernel kernel =
        form.kernel ? context_.kernel("evaluate.cl", form.kernel, defines) : kernels_.kernel(context_, "pairs");
    cl_uint next = array_arguments(form);
    set_arg(kernel, next++, displacement_, grade_);
    std::vector<cl::Buffer> buffers = {lobe_buffer(context_, material_, displacement_, grade_, form.weights)};
    kernel.setArg(next++, buffers[0]);
    kernel.setArg(next++, static_cast<cl_int>(material_.lobes.size()));
    if (quantity == Quantity::Fcos) {
        // The curves too, and where lobes are widened by an order, its nodes.
        buffers.push_back(buffer_from(context_, packed(material_)));
        kernel.setArg(next++, buffers[1]);
        if (kernels_.widened)
            for (const cl::Buffer &b : set_widening(context_, kernel, next, material_, displacement_, orders_, grade_))
                buffers.push_back(b);
    }
    return built_.emplace(quantity, Built{kernel, std::move(buffers)}).first->second.kernel;
}

cl::Kernel &Evaluator::kernel_of(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays) {
    cl::Kernel &k = kernel(quantity);
    cl_uint next = 0;
    for (const DeviceArray &array : arrays) next = set_arg(k, next, array);
    k.setArg(next, static_cast<cl_int>(count));
    return k;
}

double Evaluator::run(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays) {
    return launch(context_, kernel_of(quantity, count, arrays), round_up(count, context_.width()) / context_.width(), 1,
                  0);
}

double Evaluator::in_parts(std::size_t count, const std::vector<HostArray> &arrays, const Run &run_part) {
    const Context::Lock lock(context_);
    double seconds = 0.0;
    for (std::size_t first = 0; first < count; first += part_size) {
        const std::size_t here = std::min(part_size, count - first);
        MappedArrays mapped(context_, arrays, first, here);
        seconds += run_part(mapped.on_device(), here);
        mapped.finish();
    }
    return seconds;
}

void Evaluator::build(Quantity quantity) {
    // A float that is neither read nor written, in place of each array.
    const Context::Lock lock(context_);
    const cl::Buffer one = empty_buffer<float>(context_, 1);
    std::vector<DeviceArray> nothing;
    for (const std::size_t coordinates : form_of(quantity).coordinates)
        nothing.push_back({coordinates, {one, one, one}, {0, 0, 0}, 1});
    run(quantity, 0, nothing);
}

double Evaluator::evaluate(Quantity quantity, std::size_t count, const std::vector<HostArray> &arrays) {
    return in_parts(count, arrays, [&](const std::vector<DeviceArray> &on_device, std::size_t here) {
        return run(quantity, here, on_device);
    });
}

double Evaluator::sample(std::size_t count, const std::vector<HostArray> &arrays, const HostArray &fcos) {
    std::vector<HostArray> all = arrays;
    all.push_back(fcos);
    return in_parts(count, all, [&](const std::vector<DeviceArray> &a, std::size_t here) {
        return run(Quantity::Sample, here, {a[0], a[1], a[2], a[3]}) + run(Quantity::Fcos, here, {a[4], a[0], a[3]});
    });
}

cl::Event Evaluator::enqueue(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays,
                             const std::vector<cl::Event> &wait) {
    const Context::Lock lock(context_);
    cl::Event event;
    if (count == 0) {
        context_.queue().enqueueMarkerWithWaitList(&wait, &event);
        context_.queue().flush();
        return event;
    }
    // The queue is in order: what waits is the first part, and the last one ends last.
    for (std::size_t first = 0; first < count; first += part_size) {
        const std::size_t here = std::min(part_size, count - first);
        std::vector<DeviceArray> part;
        for (const DeviceArray &array : arrays) part.push_back(array.from(first));
        event =
            smx::enqueue(context_, kernel_of(quantity, here, part), round_up(here, context_.width()) / context_.width(),
                         1, 0, first == 0 && !wait.empty() ? &wait : nullptr);
    }
    context_.queue().flush();
    return event;
}

} // namespace smx
