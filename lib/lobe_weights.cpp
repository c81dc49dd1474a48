#include "lobe_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace smx {

namespace {

// Of the luminance of linear sRGB, Rec. 709.
constexpr std::array<double, 3> luminance = {0.2126, 0.7152, 0.0722};

// A lobe that is dark on average may be bright somewhere: none has less than this part of an equal share.
constexpr double least_share = 0.1;

// Luminance of a set of curves, mean over theta_d by sin(2 theta_d): of the lobe under light from everywhere.
double mean_luminance(const std::vector<double> &theta_d, const FresnelCurves &curves) {
    double sum = 0.0;
    for (std::size_t c = 0; c < luminance.size(); ++c) {
        const auto at = [&](std::size_t k) { return curves[c][k] * std::sin(2.0 * theta_d[k]); };
        for (std::size_t k = 0; k + 1 < theta_d.size(); ++k)
            sum += luminance[c] * 0.5 * (theta_d[k + 1] - theta_d[k]) * (at(k) + at(k + 1));
    }
    return sum;
}

void normalise(std::vector<double> &shares) {
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double &share : shares) share = sum > 0.0 ? share / sum : 1.0 / static_cast<double>(shares.size());
}

std::vector<double> drawn_shares(const Material &material) {
    std::vector<double> shares;
    for (const FresnelCurves &curves : material.fresnel) shares.push_back(mean_luminance(material.theta_d, curves));
    normalise(shares);
    const double least = least_share / static_cast<double>(shares.size());
    for (double &share : shares) share = std::max(share, least);
    normalise(shares);
    return shares;
}

double largest(const FresnelCurves &curves) {
    double most = 0.0;
    for (const std::vector<double> &curve : curves)
        most = std::max(most, *std::max_element(curve.begin(), curve.end()));
    return most;
}

} // namespace

std::vector<double> lobe_weights(const Material &material, LobeWeight which) {
    if (material.model == Model::PerLobe) {
        if (which == LobeWeight::Model) return std::vector<double>(material.lobes.size(), 1.0);
        if (which == LobeWeight::Drawn) return drawn_shares(material);
    }
    std::vector<double> weights;
    for (const Lobe &lobe : material.lobes) weights.push_back(lobe.weight);
    return weights;
}

double drawn_bound(const Material &material) {
    if (material.model == Model::Shared) return largest(material.fresnel.front());
    const std::vector<double> shares = lobe_weights(material, LobeWeight::Drawn);
    double bound = 0.0;
    for (std::size_t k = 0; k < shares.size(); ++k) bound = std::max(bound, largest(material.fresnel[k]) / shares[k]);
    return bound;
}

} // namespace smx
