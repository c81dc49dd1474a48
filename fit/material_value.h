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

// At samples of one theta_d on one displaced surface, its lobes of squared alpha a^2 + displacement2: the closed form's
// widening.
class MaterialAtLevel {
  public:
    MaterialAtLevel(const Material &material, double theta_d, double displacement2);

    Rgb operator()(const DirectionSample &sample) const;

  private:
    Model model_;
    double cos_d_;
    std::vector<Lobe> widened_;
    std::vector<Rgb> fresnel_; // by set
};

} // namespace smx
