#include "evaluator.h"

#include <algorithm>

#include "choose_effects.h"
#include "device_buffer.h"
#include "error.h"
#include "packed_material.h"
#include "widening.h"

namespace smx {

namespace {

// Elements of one launch: kernels count in int, and copies, where arrays are copied, stay small.
constexpr std::size_t part_size = std::size_t{1} << 22;

struct KernelName {
    const char *name;
    LobeWeight weights;
};

// Of cl/evaluate.cl.
KernelName kernel_name(Quantity quantity) {
    switch (quantity) {
        case Quantity::Pdf:
            return {"evaluate_pdf", LobeWeight::Drawn};
        case Quantity::Sample:
            return {"evaluate_sample", LobeWeight::Drawn};
        case Quantity::Ndf:
            return {"evaluate_ndf", LobeWeight::Surface};
        case Quantity::Sigma:
            return {"evaluate_sigma", LobeWeight::Surface};
        case Quantity::G1:
            return {"evaluate_g1", LobeWeight::Surface};
        case Quantity::G2:
            return {"evaluate_g2", LobeWeight::Surface};
        case Quantity::Fcos:
            break;
    }
    fail(Fault::Internal, "no kernel of cl/evaluate.cl for quantity ", static_cast<int>(quantity));
}

// Arguments of a quantity's arrays, and their number of elements.
cl_uint array_arguments(Quantity quantity) {
    switch (quantity) {
        case Quantity::Fcos:
            return 3 * 4 + 1;
        case Quantity::Sample:
            return 4 + 2 + 2 * 4 + 1;
        case Quantity::Pdf:
        case Quantity::G2:
            return 2 + 2 * 4 + 1;
        default:
            return 2 + 4 + 1;
    }
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
    if (const auto found = built_.find(quantity); found != built_.end()) return found->second;
    // f cos takes the curves too, and where lobes are widened by an order, its nodes.
    const bool fcos = quantity == Quantity::Fcos;
    const KernelName named = fcos ? KernelName{"", LobeWeight::Model} : kernel_name(quantity);
    Defines defines = kernels_.defines;
    for (const char *only_of_fcos : {"FRESNEL", "WIDENING"}) defines.erase(only_of_fcos);
    cl::Kernel kernel = fcos ? kernels_.kernel(context_, "pairs") : context_.kernel("evaluate.cl", named.name, defines);
    cl_uint next = array_arguments(quantity);
    set_arg(kernel, next++, displacement_, grade_);
    kept_.push_back(lobe_buffer(context_, material_, displacement_, grade_, named.weights));
    kernel.setArg(next++, kept_.back());
    kernel.setArg(next++, static_cast<cl_int>(material_.lobes.size()));
    if (fcos) {
        kept_.push_back(buffer_from(context_, packed(material_)));
        kernel.setArg(next++, kept_.back());
        if (kernels_.widened)
            for (const cl::Buffer &b : set_widening(context_, kernel, next, material_, displacement_, orders_, grade_))
                kept_.push_back(b);
    }
    return built_.emplace(quantity, kernel).first->second;
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
    const Context::Lock lock(context_);
    kernel(quantity);
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
