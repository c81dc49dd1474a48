// Launch of reference_plain.cl.
#include "reference.h"

namespace {

constexpr std::size_t value_count = std::size_t{reference_side} * reference_side * plain_samples;

} // namespace

ReferencePlain::ReferencePlain(unsigned device, std::vector<float> table)
    : kernel_(device, "reference_plain"),
      table_(kernel_.context(), table.begin(), table.end(), true),
      values_(kernel_.context(), CL_MEM_READ_WRITE, value_count * sizeof(cl_float4)) {
    kernel_.kernel().setArg(0, values_);
    kernel_.kernel().setArg(1, reference_side);
    kernel_.kernel().setArg(2, reference_light_phi);
    kernel_.kernel().setArg(3, reference_alpha);
    kernel_.kernel().setArg(4, table_);
}

PlainResult ReferencePlain::integrate(std::uint32_t seed) {
    kernel_.kernel().setArg(5, seed);
    const double seconds = kernel_.run(cl::NDRange(std::size_t{reference_side} * reference_side, plain_samples));
    std::vector<cl_float4> values(value_count);
    kernel_.queue().enqueueReadBuffer(values_, CL_TRUE, 0, value_count * sizeof(cl_float4), values.data());
    double sum = 0.0;
    for (const cl_float4 &value : values) sum += static_cast<double>(value.s[1]);
    return {seconds, sum / static_cast<double>(value_count)};
}
