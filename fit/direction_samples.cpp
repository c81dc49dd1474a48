#include "direction_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace smx {

namespace {

constexpr std::size_t phi_samples = 4;

// Up to theta_h = 10 degrees also half-way between two nodes: there a lobe may be no wider than their distance.
constexpr std::size_t fine_halves = 60;

// The sample half-way between nodes half / 2 and (half + 1) / 2 of theta_h.
DirectionSample sample_at(const Brdf &brdf, std::size_t half, std::size_t d, std::size_t p) {
    const std::size_t cell = brdf.cell(half / 2, d, p), next = brdf.cell((half + 1) / 2, d, p);
    const double u = static_cast<double>(half) / (2.0 * Brdf::theta_h_count), theta_h = u * u * std::numbers::pi / 2;
    DirectionSample s = direction_at(theta_h, Brdf::theta_d(d), brdf.phi_d(p));
    for (std::size_t c = 0; c < 3; ++c) s.f[c] = (brdf.value(c, cell) + brdf.value(c, next)) / 2;
    // sin(theta) dtheta of theta = u^2 pi/2 is proportional to sin(theta) u; the pole's cell is a twentieth of
    // the next one's (the integral of a linear interpolant's half cell against the trapezoid rule).
    const double first = 1.0 / (2.0 * Brdf::theta_h_count);
    const double step = half > fine_halves ? 2.0 : half == fine_halves ? 1.5 : 1.0;
    const double ring = half > 0 ? std::sin(theta_h) * u * step : first * first * std::numbers::pi / 2 * first / 20;
    s.weight = s.ci * std::sqrt(std::max(s.co, 0.0) * ring);
    return s;
}

DirectionLevel make_level(const Brdf &brdf, std::size_t d) {
    DirectionLevel level{Brdf::theta_d(d), 0.0, {}};
    const std::size_t columns = brdf.phi_d_count(), stride = columns / phi_samples;
    for (std::size_t half = 0; half < 2 * Brdf::theta_h_count - 1; half += half < fine_halves ? 1 : 2)
        for (std::size_t j = 0; j < phi_samples; ++j) {
            const std::size_t p = (j * stride + half * 7) % columns, h = half / 2, next = (half + 1) / 2;
            if (!brdf.valid(brdf.cell(h, d, p)) || !brdf.valid(brdf.cell(next, d, p))) continue;
            const DirectionSample s = sample_at(brdf, half, d, p);
            if (s.ci >= min_cosine && s.co >= min_cosine) level.samples.push_back(s);
        }
    return level;
}

// How much of a level is seen: lights spread over the sphere stand 2 theta_d from the view with density sin(2 theta_d),
// and light a share cos^2(theta_d) of the disc; the constant keeps the light at the camera, a common one.
double seen(double theta_d) {
    const double cosine = std::cos(theta_d);
    return (0.25 + std::sin(2 * theta_d)) * cosine * cosine;
}

double sum_of_squares(const DirectionLevel &level) {
    double sum = 0.0;
    for (const DirectionSample &s : level.samples)
        for (double f : s.f) sum += s.weight * s.weight * f * f;
    return sum;
}

// Scales the samples' weights so that their values have this sum of squares.
void normalise(DirectionLevel &level, double wanted) {
    const double sum = sum_of_squares(level);
    level.norm = std::sqrt(wanted);
    for (DirectionSample &s : level.samples) s.weight *= level.norm / std::sqrt(sum);
}

} // namespace

DirectionSample direction_at(double theta_h, double theta_d, double phi_d) {
    const double cos_cos = std::cos(theta_h) * std::cos(theta_d);
    const double sin_sin = std::sin(theta_h) * std::sin(theta_d) * std::cos(phi_d);
    DirectionSample s{};
    s.ci = cos_cos - sin_sin;
    s.co = cos_cos + sin_sin;
    s.sin_i = std::sqrt(std::max(1.0 - s.ci * s.ci, 0.0));
    s.sin_o = std::sqrt(std::max(1.0 - s.co * s.co, 0.0));
    s.tan2 = std::tan(theta_h) * std::tan(theta_h);
    s.inv_cos4 = (1.0 + s.tan2) * (1.0 + s.tan2);
    return s;
}

std::vector<std::size_t> table_rows(const std::vector<double> &theta_d) {
    std::vector<std::size_t> rows;
    for (double angle : theta_d) {
        const auto row = static_cast<std::size_t>(std::lround(angle * 180 / std::numbers::pi));
        rows.push_back(std::min(row, Brdf::theta_d_count - 1));
    }
    return rows;
}

std::vector<DirectionLevel> direction_levels(const Brdf &brdf, const std::vector<double> &theta_d) {
    std::vector<DirectionLevel> levels;
    for (std::size_t row : table_rows(theta_d)) {
        DirectionLevel level = make_level(brdf, row);
        if (!level.samples.empty()) levels.push_back(std::move(level));
    }
    weigh_levels(levels, 1.0);
    return levels;
}

void weigh_levels(std::vector<DirectionLevel> &levels, double share) {
    std::erase_if(levels, [](const DirectionLevel &level) { return sum_of_squares(level) <= 0.0; });
    // A level stands for the angles up to half-way to its neighbours.
    std::vector<double> parts;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const double low = levels[l > 0 ? l - 1 : l].theta_d, high = levels[std::min(l + 1, levels.size() - 1)].theta_d;
        parts.push_back(levels.size() > 1 ? seen(levels[l].theta_d) * (high - low) : 1.0);
    }
    const double total = std::accumulate(parts.begin(), parts.end(), 0.0);
    for (std::size_t l = 0; l < levels.size(); ++l) normalise(levels[l], share * parts[l] / total);
}

} // namespace smx
