#include "outliers.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace smx {

namespace {

constexpr double outlier_ratio = 30.0;

double sum_of_channels(const Brdf &brdf, std::size_t cell) {
    return brdf.value(0, cell) + brdf.value(1, cell) + brdf.value(2, cell);
}

// Over the valid cells of a row; 0 where it has none.
double median_of_row(const Brdf &brdf, std::size_t h, std::size_t d) {
    std::vector<double> values;
    for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
        const std::size_t cell = brdf.cell(h, d, p);
        if (brdf.valid(cell)) values.push_back(sum_of_channels(brdf, cell));
    }
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::vector<std::size_t> outliers(const Brdf &brdf) {
    constexpr std::size_t rows = Brdf::theta_h_count;
    std::vector<std::size_t> found;
    for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
        std::vector<double> medians;
        for (std::size_t h = 0; h < rows; ++h) medians.push_back(median_of_row(brdf, h, d));
        for (std::size_t h = 0; h < rows; ++h) {
            const double beside = std::max(medians[h > 0 ? h - 1 : h], medians[std::min(h + 1, rows - 1)]);
            const double ceiling = outlier_ratio * std::max(medians[h], beside);
            if (ceiling <= 0.0) continue; // nothing to judge by
            for (std::size_t p = 0; p < brdf.phi_d_count(); ++p) {
                const std::size_t cell = brdf.cell(h, d, p);
                if (brdf.valid(cell) && sum_of_channels(brdf, cell) > ceiling) found.push_back(cell);
            }
        }
    }
    return found;
}

} // namespace

std::optional<Brdf> without_outliers(const Brdf &brdf) {
    const std::vector<std::size_t> faults = outliers(brdf);
    if (faults.empty()) return std::nullopt;
    std::vector<double> values = brdf.values();
    for (std::size_t cell = 0; cell < brdf.cells(); ++cell)
        if (!brdf.valid(cell)) values[cell] = -1.0;
    for (std::size_t cell : faults) values[cell] = -1.0;
    return Brdf(brdf.name(), brdf.source(), brdf.sha256(), brdf.phi_d_count(), std::move(values));
}

} // namespace smx
