// A material on a displaced surface, ready for many evaluations on a context's first device: f cos, the density of
// drawn directions and the draws themselves, and the microsurface's D, sigma, G1 and G2. The launches of
// cl/shade_filtered.cl's and cl/shade_widened.cl's pairs and of cl/evaluate.cl.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "filtered_kernels.h"
#include "render.h"
#include "strided_arrays.h"

namespace smx {

// What is asked for. In brackets its arrays, in the order that evaluations take: what is written, what is read.
enum class Quantity {
    Fcos,   // [fcos; wi, wo]
    Pdf,    // [pdf; wi, wo]
    Sample, // [wi, pdf; u, wo]
    Ndf,    // [ndf; wh]
    Sigma,  // [sigma; k]
    G1,     // [g1; k]
    G2      // [g2; wi, wo]
};

class Evaluator {
  public:
    // Of the options, the grade, the widening's order and the effects count: auto_effects, which needs an image, is all
    // of them. Throws InvalidArgument, naming value and range.
    Evaluator(Context &context, const Material &material, const Displacement &displacement, Masking masking,
              const RenderOptions &options);

    Context &context() const { return context_; }

    // Bound of fcos / pdf of what Sample draws, in closed form (lobe_weights.h).
    double drawn_bound() const;

    // Builds the kernel of a quantity, where it is not built yet.
    void build(Quantity quantity);

    // On the host's arrays, [count] each; returns when they are written, with the seconds on the device.
    double evaluate(Quantity quantity, std::size_t count, const std::vector<HostArray> &arrays);

    // Sample, and f cos of what it drew: arrays [wi, pdf; u, wo], and fcos.
    double sample(std::size_t count, const std::vector<HostArray> &arrays, const HostArray &fcos);

    // On buffers of the context, after the events of `wait`, where there are any; returns at once, with the event of
    // the end. `count` may be 0.
    cl::Event enqueue(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays,
                      const std::vector<cl::Event> &wait);

  private:
    using Run = std::function<double(const std::vector<DeviceArray> &, std::size_t count)>;

    cl::Kernel &kernel(Quantity quantity);
    cl::Kernel &kernel_of(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays);
    double run(Quantity quantity, std::size_t count, const std::vector<DeviceArray> &arrays);
    double in_parts(std::size_t count, const std::vector<HostArray> &arrays, const Run &run);

    Context &context_;
    Effects on_;
    Material material_; // of what is simulated
    Displacement displacement_;
    Grade grade_;
    std::vector<int> orders_;
    FilteredKernels kernels_;
    std::map<Quantity, cl::Kernel> built_;
    std::vector<cl::Buffer> kept_; // what kernels read: they do not keep it alive
};

} // namespace smx
