#include "em_starts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace smx {

namespace {

constexpr unsigned cluster_rounds = 20; // of Lloyd's iteration; EM does the rest

// Mass and second moment of the slope, summed up for a lobe each.
struct Shares {
    std::vector<double> mass, moment;

    explicit Shares(std::size_t count) : mass(count, 0.0), moment(count, 0.0) {}
    void add(std::size_t lobe, double share, double slope) {
        mass[lobe] += share;
        moment[lobe] += share * slope * slope;
    }
    std::vector<Lobe> lobes() const {
        std::vector<Lobe> lobes;
        for (std::size_t k = 0; k < mass.size(); ++k)
            if (mass[k] > 0.0)
                lobes.push_back({mass[k], std::clamp(std::sqrt(moment[k] / mass[k]), min_alpha, max_alpha)});
        return lobes;
    }
};

// The nodes that have mass and a logarithm.
struct Points {
    std::vector<double> slope, log_slope, mass;

    explicit Points(const SlopeDensity &density) {
        for (std::size_t j = 0; j < density.slope.size(); ++j) {
            if (density.mass[j] <= 0.0 || density.slope[j] <= 0.0) continue;
            slope.push_back(density.slope[j]);
            log_slope.push_back(std::log(density.slope[j]));
            mass.push_back(density.mass[j]);
        }
    }
    std::size_t size() const { return slope.size(); }
};

double squared(double x) { return x * x; }

double squared_distance(double x, const std::vector<double> &centres) {
    double nearest = std::numeric_limits<double>::infinity();
    for (double centre : centres) nearest = std::min(nearest, squared(x - centre));
    return nearest;
}

std::size_t nearest_centre(double x, const std::vector<double> &centres) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < centres.size(); ++k)
        if (squared(x - centres[k]) < squared(x - centres[nearest])) nearest = k;
    return nearest;
}

// A point at random, in proportion to these weights; the count where there are none.
std::size_t draw(const std::vector<double> &weights, std::mt19937_64 &random) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double left = std::generate_canonical<double, 53>(random) * total;
    for (std::size_t j = 0; j < weights.size(); ++j) {
        left -= weights[j];
        if (weights[j] > 0.0 && left < 0.0) return j;
    }
    return weights.size();
}

// Each centre far from those before it, in proportion to the mass times the squared distance.
std::vector<double> spread_centres(const Points &points, unsigned count, std::mt19937_64 &random) {
    std::vector<double> centres, weights = points.mass;
    while (centres.size() < count) {
        const std::size_t at = draw(weights, random);
        if (at == weights.size()) break; // every point is a centre
        centres.push_back(points.log_slope[at]);
        for (std::size_t j = 0; j < points.size(); ++j)
            weights[j] = points.mass[j] * squared_distance(points.log_slope[j], centres);
    }
    return centres;
}

void move_to_means(const Points &points, std::vector<double> &centres) {
    std::vector<double> mass(centres.size(), 0.0), sum(centres.size(), 0.0);
    for (std::size_t j = 0; j < points.size(); ++j) {
        const std::size_t k = nearest_centre(points.log_slope[j], centres);
        mass[k] += points.mass[j];
        sum[k] += points.mass[j] * points.log_slope[j];
    }
    for (std::size_t k = 0; k < centres.size(); ++k)
        if (mass[k] > 0.0) centres[k] = sum[k] / mass[k];
}

} // namespace

std::vector<Lobe> quantile_start(const SlopeDensity &density, unsigned count) {
    Shares shares(count);
    double before = 0.0;
    for (std::size_t j = 0; j < density.mass.size(); ++j) {
        // A node that reaches over several shares is split among them.
        const double from = before * count, to = (before + density.mass[j]) * count;
        for (auto k = static_cast<unsigned>(from); k < count && k < to; ++k)
            shares.add(k, (std::min(to, k + 1.0) - std::max(from, static_cast<double>(k))) / count, density.slope[j]);
        before += density.mass[j];
    }
    return shares.lobes();
}

std::vector<Lobe> cluster_start(const SlopeDensity &density, unsigned count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const Points points(density);
    std::vector<double> centres = spread_centres(points, count, random);
    if (centres.empty()) return {};
    for (unsigned round = 0; round < cluster_rounds; ++round) move_to_means(points, centres);
    Shares shares(centres.size());
    for (std::size_t j = 0; j < points.size(); ++j)
        shares.add(nearest_centre(points.log_slope[j], centres), points.mass[j], points.slope[j]);
    return shares.lobes();
}

} // namespace smx
