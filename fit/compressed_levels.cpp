#include "compressed_levels.h"

#include <algorithm>
#include <cmath>

#include "lobe_value.h"

namespace smx {

using Eigen::MatrixXd;

void CompressedLevels::update(const std::vector<double> &log_alphas) {
    lobes_ = static_cast<Eigen::Index>(log_alphas.size());
    std::vector<double> alphas;
    for (double log_alpha : log_alphas) alphas.push_back(std::exp(log_alpha));
    for (std::size_t l = 0; l < levels_.size(); ++l) factors_[l] = factor(levels_[l], alphas);
}

MatrixXd CompressedLevels::factor(const DirectionLevel &level, const std::vector<double> &alphas) const {
    MatrixXd columns = MatrixXd::Zero(std::max(static_cast<Eigen::Index>(level.samples.size()), rows()), rows());
    for (std::size_t s = 0; s < level.samples.size(); ++s) {
        const DirectionSample &sample = level.samples[s];
        const auto row = static_cast<Eigen::Index>(s);
        for (Eigen::Index k = 0; k < lobes_; ++k) {
            const LobeValue lobe = lobe_value(sample, alphas[static_cast<std::size_t>(k)]);
            columns(row, k) = sample.weight * lobe.value;
            columns(row, lobes_ + k) = sample.weight * lobe.derivative;
        }
        for (Eigen::Index c = 0; c < 3; ++c)
            columns(row, 2 * lobes_ + c) = sample.weight * sample.f[static_cast<std::size_t>(c)];
    }
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> in_place(columns);
    return columns.topRows(rows()).triangularView<Eigen::Upper>();
}

} // namespace smx
