// A material at the nodes of a table, on the host in double, for figures in BRDF space. The device's form, which also
// widens the lobes, is in cl/mixture.clh.
#pragma once

#include <vector>

#include "brdf.h"
#include "material.h"

namespace smx {

class MaterialValue {
  public:
    explicit MaterialValue(const Material &material);

    // f in 1/sr at nodes theta_h and theta_d, for the pair's cosines, both above 0. The shared model has one masking,
    // from the mixture's projected area sum w_k sigma_k.
    Rgb operator()(std::size_t theta_h, std::size_t theta_d, const Cosines &at) const;

  private:
    Rgb shared(std::size_t theta_h, std::size_t theta_d, const Cosines &at) const;
    Rgb per_lobe(std::size_t theta_h, std::size_t theta_d, const Cosines &at) const;

    Model model_;
    std::vector<Lobe> lobes_;
    std::vector<std::vector<double>> ndf_;  // [theta_h][lobe]
    std::vector<std::vector<Rgb>> fresnel_; // [theta_d][set]
};

} // namespace smx
