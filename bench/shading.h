// What the shading benchmarks compute, three times: by the library, and by the two baselines written plainly, a scalar
// loop on one core and a kernel of built-in functions. All shade the sphere of the experiment, lit from the viewer, so
// that every pixel on it is an evaluation.
#pragma once

#include <vector>

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

// A baseline's time and picture: seconds for the whole image, [row][column][rgba].
struct ShadingResult {
    double seconds;
    std::vector<float> rgba;
};

// The scalar loop on one core: floats, libm, no vectors.
ShadingResult shade_scalar(const ShadingCase &what);

// bench/shading_builtin.cl on the first device: one work-item per pixel, built-in exp and erf. Time from OpenCL's
// event.
ShadingResult shade_builtin(const ShadingCase &what);
