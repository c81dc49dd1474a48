// The least-squares problem of the per-lobe model, as Ceres holds it: log alphas and all curves together.
//   residuals   (model - f) by the samples' weights; second differences of the curves' coefficients; and, where asked
//               for, what the directional albedo has beyond its bound
//   bounds      coefficients from 0, alphas 1e-4..1e4
#pragma once

#include <memory>
#include <vector>

#include "ceres_solver.h"
#include "compressed_levels.h"
#include "per_lobe_fit.h"

namespace smx {

// The unknowns: a block of log alphas, and one of the lobes' values per channel and coefficient.
struct Unknowns {
    std::vector<double> log_alphas;
    std::array<std::vector<std::vector<double>>, 3> values; // [channel][coefficient][lobe]

    explicit Unknowns(const PerLobeFit &fit);
    PerLobeFit fit() const;
};

// A bound of the directional albedo at one theta_o: of the lobes' shares (DirectionalAlbedo::shares), by channel.
struct EnergyBound {
    Eigen::MatrixXd shares;
    Rgb bound;
};

class PerLobeProblem : private ceres::EvaluationCallback {
  public:
    // `levels` must outlive the problem. Where there are bounds of the energy the alphas, which the shares are of, are
    // held.
    PerLobeProblem(const std::vector<DirectionLevel> &levels, const PerLobeFit &start,
                   const std::vector<EnergyBound> &energy = {});

    ceres::Problem &problem() { return *problem_; }
    Unknowns &unknowns() { return unknowns_; }

  private:
    void PrepareForEvaluation(bool, bool new_point) override;
    void add(std::unique_ptr<ceres::CostFunction> residuals, const std::vector<double *> &blocks);
    void add_levels(std::size_t channel);
    void add_roughness(std::size_t channel);
    void add_energy(const EnergyBound &energy, std::size_t channel);
    void add_bounds();

    Unknowns unknowns_;
    CompressedLevels levels_;
    std::vector<std::unique_ptr<ceres::CostFunction>> residuals_; // not Ceres's, which loses one where memory ends
    std::unique_ptr<ceres::Problem> problem_;
};

} // namespace smx
