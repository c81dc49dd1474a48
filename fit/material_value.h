// A material's f in 1/sr on the host, in double, for fits and for figures in BRDF space. The device's form is in
// cl/mixture.clh.
#pragma once

#include <vector>

#include "direction_samples.h"
#include "material.h"

namespace smx {

// At the nodes of a table.
class MaterialValue {
  public:
    explicit MaterialValue(const Material &material);

    // At nodes theta_h and theta_d, for the pair's cosines, both above 0. The shared model has one masking, from the
    // mixture's projected area sum w_k sigma_k.
    Rgb operator()(std::size_t theta_h, std::size_t theta_d, const Cosines &at) const;

  private:
    Model model_;
    std::vector<Lobe> lobes_;
    std::vector<std::vector<double>> ndf_;  // [theta_h][lobe]
    std::vector<std::vector<Rgb>> fresnel_; // [theta_d][set]
};

// At a sample of the fit, its lobes of squared alpha a^2 + the sample's displacement2: the closed form's widening.
Rgb material_at(const Material &material, double theta_d, const DirectionSample &sample);

} // namespace smx
