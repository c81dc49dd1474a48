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

bool Brdf::above_horizon(std::size_t h, std::size_t d, std::size_t p) const {
    const double cos_cos = std::cos(theta_h(h)) * std::cos(theta_d(d));
    const double sin_sin = std::sin(theta_h(h)) * std::sin(theta_d(d)) * std::cos(phi_d(p));
    return cos_cos - sin_sin > 0.0 && cos_cos + sin_sin > 0.0;
}

} // namespace smx
