// What the shading benchmarks compute, three times: by the library, and by the two baselines written plainly, a scalar
// loop on one core and a kernel of built-in functions. All shade the sphere of the experiment, lit from the viewer, so
// that every pixel on it is an evaluation.
#pragma once

#include <vector>

#include "plain_kernel.h"
#include "slopemix.h"

constexpr int shading_side = 1024;
constexpr float shading_alpha_x = 0.25f, shading_alpha_y = 0.25f; // of the displaced surface

// Lobes with their weights (1 in the per-lobe model), alphas and Fresnel values (rgb; the first in the shared model).
struct ShadingLobe {
    float weight, alpha;
    float fresnel[3];
};

struct ShadingCase {
    bool per_lobe;
    std::vector<ShadingLobe> lobes;
};

// `count` distinct lobes, alphas 0.01 to 1.
ShadingCase shading_case(bool per_lobe, int count);

// The same as the library takes it.
smx_scene shading_scene();
smx_status make_material(const ShadingCase &what, smx_material *material);

// A baseline's time and picture: seconds for the whole image, [row][column][rgba].
struct ShadingResult {
    double seconds;
    std::vector<float> rgba;
};

// The scalar loop on one core: floats, libm, no vectors.
ShadingResult shade_scalar(const ShadingCase &what);

// shading_builtin.cl: one work-item per pixel, built-in exp and erf. Time from OpenCL's event.
class ShadingBuiltin {
  public:
    explicit ShadingBuiltin(unsigned device) : kernel_(device, "shading_builtin") {}
    ShadingResult shade(const ShadingCase &what);

  private:
    PlainKernel kernel_;
};
