#include "direction_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace smx {

namespace {

constexpr std::size_t phi_samples = 6;
constexpr double min_cosine = 0.02; // nearer the horizon than a table's cells resolve

// A value this many times the median of its row in phi_d, and of the rows beside it, is no reflection but a fault of
// the measurement: along phi_d measured tables vary by a few, not by tens.
constexpr double outlier_ratio = 30.0;

// Rows of the table at these angles.
std::vector<std::size_t> table_rows(const std::vector<double> &theta_d) {
    std::vector<std::size_t> rows;
    for (double angle : theta_d) {
        const auto row = static_cast<std::size_t>(std::lround(angle * 180 / std::numbers::pi));
        rows.push_back(std::min(row, Brdf::theta_d_count - 1));
    }
    return rows;
}

// Highest value that a cell of this (theta_h, theta_d) row may have.
double row_ceiling(const Brdf &brdf, std::size_t h, std::size_t d) {
    double ceiling = 0.0;
    for (std::size_t beside : {h > 0 ? h - 1 : h, h, std::min(h + 1, Brdf::theta_h_count - 1)}) {
        std::vector<double> values;
        for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
            const std::size_t cell = brdf.cell(beside, d, p);
            if (brdf.valid(cell)) values.push_back(brdf.value(0, cell) + brdf.value(1, cell) + brdf.value(2, cell));
        }
        if (values.empty()) continue;
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        ceiling = std::max(ceiling, outlier_ratio * *middle);
    }
    return ceiling;
}

bool usable(const Brdf &brdf, std::size_t cell, double ceiling) {
    return brdf.valid(cell) && brdf.value(0, cell) + brdf.value(1, cell) + brdf.value(2, cell) <= ceiling;
}

// The sample between nodes h and h_next (the same node, or its neighbour) at phi_d node p.
DirectionSample make_sample(const Brdf &brdf, std::size_t half, std::size_t d, std::size_t p, std::size_t cell,
                            std::size_t cell_next) {
    const double u = static_cast<double>(half) / (2.0 * Brdf::theta_h_count);
    const double th = u * u * std::numbers::pi / 2, td = Brdf::theta_d(d);
    const double cos_cos = std::cos(th) * std::cos(td);
    const double sin_sin = std::sin(th) * std::sin(td) * std::cos(brdf.phi_d(p));
    DirectionSample s{};
    s.ci = cos_cos - sin_sin;
    s.co = cos_cos + sin_sin;
    s.sin_i = std::sqrt(std::max(1.0 - s.ci * s.ci, 0.0));
    s.sin_o = std::sqrt(std::max(1.0 - s.co * s.co, 0.0));
    s.tan2 = std::tan(th) * std::tan(th);
    s.inv_cos4 = (1.0 + s.tan2) * (1.0 + s.tan2);
    for (std::size_t c = 0; c < 3; ++c) s.f[c] = (brdf.value(c, cell) + brdf.value(c, cell_next)) / 2;
    // sin(theta) dtheta of theta = u^2 pi/2 is proportional to sin(theta) u; the pole's cell is a twentieth of
    // the next one's (the integral of a linear interpolant's half cell against the trapezoid rule).
    const double first = 1.0 / (2.0 * Brdf::theta_h_count);
    const double ring = half > 0 ? std::sin(th) * u : first * first * std::numbers::pi / 2 * first / 20;
    s.weight = s.ci > 0.0 && s.co > 0.0 ? s.ci * std::sqrt(s.co * ring) : 0.0;
    return s;
}

// How often a level is seen: lights spread over the sphere stand 2 theta_d from the view with density sin(2 theta_d);
// the constant keeps the light at the camera, a common one.
double seen(double theta_d) { return (0.25 + std::sin(2 * theta_d)) / 1.25; }

// Scales the weights so that the level's values have a sum of squares that is its share of what is seen.
void normalise(DirectionLevel &level, double width) {
    double sum = 0.0;
    for (const DirectionSample &s : level.samples)
        for (double f : s.f) sum += s.weight * s.weight * f * f;
    if (sum <= 0.0) return;
    level.norm = std::sqrt(seen(level.theta_d) * width);
    for (DirectionSample &s : level.samples) s.weight *= level.norm / std::sqrt(sum);
}

DirectionLevel make_level(const Brdf &brdf, std::size_t d, double width) {
    DirectionLevel level{Brdf::theta_d(d), 0.0, {}};
    const std::size_t columns = brdf.phi_d_count(), stride = columns / phi_samples;
    std::vector<double> ceilings;
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h) ceilings.push_back(row_ceiling(brdf, h, d));
    for (std::size_t half = 0; half < 2 * Brdf::theta_h_count - 1; ++half)
        for (std::size_t j = 0; j < phi_samples; ++j) {
            const std::size_t p = (j * stride + half * 7) % columns;
            const std::size_t h = half / 2, next = (half + 1) / 2;
            const std::size_t cell = brdf.cell(h, d, p), cell_next = brdf.cell(next, d, p);
            if (!usable(brdf, cell, ceilings[h]) || !usable(brdf, cell_next, ceilings[next])) continue;
            const DirectionSample s = make_sample(brdf, half, d, p, cell, cell_next);
            if (s.ci >= min_cosine && s.co >= min_cosine) level.samples.push_back(s);
        }
    normalise(level, width);
    return level;
}

} // namespace

std::vector<DirectionLevel> direction_levels(const Brdf &brdf, const std::vector<double> &theta_d) {
    std::vector<DirectionLevel> levels;
    const std::vector<std::size_t> rows = table_rows(theta_d);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        // The level stands for the angles up to half-way to its neighbours; all together for 1.
        const std::size_t low = rows[r > 0 ? r - 1 : r], high = rows[std::min(r + 1, rows.size() - 1)];
        const double width = static_cast<double>(high - low) / (2.0 * Brdf::theta_d_count);
        DirectionLevel level = make_level(brdf, rows[r], width);
        if (!level.samples.empty()) levels.push_back(std::move(level));
    }
    return levels;
}

} // namespace smx
