#include "brdf.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "error.h"
#include "fill_holes.h"

namespace smx {

namespace {

// Far above any reflection, far below where a float's sums would overflow.
constexpr double max_value = 1e30;

// Sines and cosines of the nodes' angles, computed once.
struct Trigonometry {
    std::array<double, Brdf::theta_h_count> cos_h{}, sin_h{};
    std::array<double, Brdf::theta_d_count> cos_d{}, sin_d{};
    std::array<double, 360> cos_phi_d{};

    Trigonometry() {
        for (std::size_t k = 0; k < Brdf::theta_h_count; ++k) {
            cos_h[k] = std::cos(Brdf::theta_h(k));
            sin_h[k] = std::sin(Brdf::theta_h(k));
        }
        for (std::size_t k = 0; k < Brdf::theta_d_count; ++k) {
            cos_d[k] = std::cos(Brdf::theta_d(k));
            sin_d[k] = std::sin(Brdf::theta_d(k));
        }
        for (std::size_t k = 0; k < cos_phi_d.size(); ++k)
            cos_phi_d[k] = std::cos(static_cast<double>(k) * std::numbers::pi / 180);
    }
};

} // namespace

Brdf::Brdf(std::string name, std::string source, std::string sha256, std::size_t phi_d_count,
           std::vector<double> values)
    : name_(std::move(name)),
      source_(std::move(source)),
      sha256_(std::move(sha256)),
      phi_d_count_(phi_d_count),
      values_(std::move(values)) {
    find_valid_cells();
    if (invalid_cells_ == cells()) fail(Fault::BadFormat, name_, ": the table has no valid cell");
    fill_holes(*this, valid_, values_);
}

void Brdf::find_valid_cells() {
    valid_.assign(cells(), true);
    for (std::size_t at = 0; at < values_.size(); ++at) {
        if (!std::isfinite(values_[at]))
            fail(Fault::BadFormat, name_, ": value ", at, " of the table is ", values_[at], ", not a finite number");
        if (values_[at] > max_value)
            fail(Fault::BadFormat, name_, ": value ", at, " of the table is ", values_[at], "; the highest is ",
                 max_value);
        if (values_[at] < 0.0) valid_[at % cells()] = false;
    }
    for (std::size_t h = 0; h < theta_h_count; ++h)
        for (std::size_t d = 0; d < theta_d_count; ++d)
            for (std::size_t p = 0; p < phi_d_count_; ++p) {
                if (valid_[cell(h, d, p)]) continue;
                ++invalid_cells_;
                if (above_horizon(h, d, p)) ++filled_cells_;
            }
}

double Brdf::theta_h(std::size_t k) {
    const double u = static_cast<double>(k) / theta_h_count;
    return u * u * std::numbers::pi / 2;
}

double Brdf::theta_d(std::size_t k) { return static_cast<double>(k) / theta_d_count * std::numbers::pi / 2; }

double Brdf::phi_d(std::size_t k) const { return static_cast<double>(k) * std::numbers::pi / 180; }

Cosines Brdf::cosines(std::size_t h, std::size_t d, std::size_t p) {
    static const Trigonometry t;
    const double cos_cos = t.cos_h[h] * t.cos_d[d], sin_sin = t.sin_h[h] * t.sin_d[d] * t.cos_phi_d[p];
    return {cos_cos - sin_sin, cos_cos + sin_sin, t.cos_h[h], t.cos_d[d]};
}

bool Brdf::above_horizon(std::size_t h, std::size_t d, std::size_t p) {
    const Cosines at = cosines(h, d, p);
    return at.i > 0.0 && at.o > 0.0;
}

double Brdf::theta_h_weight(std::size_t k) {
    constexpr double h = 1.0 / theta_h_count;
    if (k == 0) return theta_h(1) * theta_h(1) / 10;
    return std::sin(theta_h(k)) * std::numbers::pi * static_cast<double>(k) * h * h;
}

} // namespace smx
