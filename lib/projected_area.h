// The projected area of a microsurface from its distribution of normals, where there is no closed form.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace smx {

class ProjectedArea {
  public:
    // From the distribution on polar angles: weight[j] = D(theta_j) sin(theta_j) dtheta_j, normalised here so that the
    // area towards the mean normal is 1. With no mass outside the pole it is a mirror's, the cosine.
    ProjectedArea(const std::vector<double> &theta, const std::vector<double> &weight);

    // From the distribution as a function of the cosine, by the midpoint rule on theta = u^2 pi/2.
    explicit ProjectedArea(const std::function<double(double)> &ndf);

    // sigma(k) = integral of <k,h>+ D(h) dh, linear between samples that are denser towards grazing.
    double operator()(double cos_k) const;

  private:
    void sample(const std::vector<double> &theta, const std::vector<double> &weight);

    std::vector<double> samples_;
};

} // namespace smx
