// What the reference's benchmarks compare it with, twice: the same integral taken plainly, a facet of X by chance, its
// angles by acos and atan2, a trilinear lookup in the whole table, one sample after the other. Once as a scalar loop on
// one core, once as a kernel with a sample of a pixel per work-item.
#pragma once

#include <cstdint>
#include <vector>

#include "plain_kernel.h"
#include "slopemix.h"

constexpr int reference_side = 128, plain_samples = 64; // the baselines' per pixel
constexpr float reference_light_phi = 0.5f, reference_alpha = 0.25f;

// The same as the library takes it.
smx_scene reference_scene();

// [90][90][180] of rgb and a zero.
smx_status plain_table(smx_brdf brdf, std::vector<float> *table);

// A baseline's time for plain_samples of every pixel, and the mean of the green pixels.
struct PlainResult {
    double seconds, mean_green;
};

// The scalar loop on one core: floats, libm, no vectors.
PlainResult reference_scalar(const std::vector<float> &table, std::uint32_t seed);

// reference_plain.cl. Time from OpenCL's event.
class ReferencePlain {
  public:
    ReferencePlain(unsigned device, std::vector<float> table);
    PlainResult integrate(std::uint32_t seed);

  private:
    PlainKernel kernel_;
    cl::Buffer table_, values_;
};
