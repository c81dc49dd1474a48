#include "brdf_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "error.h"
#include "material_value.h"

namespace smx {

namespace {

const double grazing_cosine = std::cos(80 * std::numbers::pi / 180);

// Model and reference at one pair of directions; roots are taken once for both of its orders.
struct Compared {
    Rgb f, r, root_difference;

    Compared(const Rgb &model, const Rgb &reference) : f(model), r(reference), root_difference{} {
        for (std::size_t c = 0; c < 3; ++c) root_difference[c] = std::cbrt(f[c]) - std::cbrt(r[c]);
    }
};

// Weighted sums of squares.
class Sums {
  public:
    void add(const Compared &pair, double cos_i, double weight) {
        const double root_i = std::cbrt(cos_i);
        for (std::size_t c = 0; c < 3; ++c) {
            const double plain = (pair.f[c] - pair.r[c]) * cos_i;
            const double log = std::log1p(plain / (1.0 + pair.r[c] * cos_i)); // of the quotient of the two
            const double cube_root = pair.root_difference[c] * root_i;
            l2_ += weight * plain * plain;
            log_ += weight * log * log;
            cube_root_ += weight * cube_root * cube_root;
        }
        weight_ += 3 * weight;
    }
    void add(const Sums &other) {
        weight_ += other.weight_;
        l2_ += other.l2_;
        log_ += other.log_;
        cube_root_ += other.cube_root_;
    }
    bool empty() const { return weight_ == 0.0; }
    MetricErrors errors() const {
        return {std::sqrt(l2_ / weight_), std::sqrt(log_ / weight_), std::sqrt(cube_root_ / weight_)};
    }

  private:
    double weight_ = 0.0, l2_ = 0.0, log_ = 0.0, cube_root_ = 0.0;
};

// What is compared with the reference: f along one row of a table with `columns` values of phi_d, and where it counts.
struct Candidate {
    std::size_t columns;
    std::function<void(std::size_t h, std::size_t d, std::vector<Rgb> &row)> fill;
    std::function<bool(std::size_t h, std::size_t d, std::size_t p)> valid;
};

Rgb value_at(const Brdf &brdf, std::size_t h, std::size_t d, std::size_t p) {
    const std::size_t cell = brdf.cell(h, d, p % brdf.phi_d_count());
    return {brdf.value(0, cell), brdf.value(1, cell), brdf.value(2, cell)};
}

bool valid_at(const Brdf &brdf, std::size_t h, std::size_t d, std::size_t p) {
    return brdf.valid(brdf.cell(h, d, p % brdf.phi_d_count()));
}

BrdfErrors measure(const Candidate &candidate, const Brdf &reference) {
    Sums within, grazing;
    std::vector<Rgb> row(candidate.columns);
    for (std::size_t h = 0; h < Brdf::theta_h_count; ++h)
        for (std::size_t d = 0; d < Brdf::theta_d_count; ++d) {
            candidate.fill(h, d, row);
            const double weight = Brdf::theta_h_weight(h) * std::sin(2 * Brdf::theta_d(d));
            for (std::size_t p = 0; p < candidate.columns; ++p) {
                const Cosines at = Brdf::cosines(h, d, p);
                if (at.i <= 0.0 || at.o <= 0.0 || !valid_at(reference, h, d, p) || !candidate.valid(h, d, p)) continue;
                Sums &sums = std::min(at.i, at.o) >= grazing_cosine ? within : grazing;
                const Compared pair(row[p], value_at(reference, h, d, p));
                sums.add(pair, at.i, weight);
                // In half a turn of phi_d a cell also stands for its pair with the directions exchanged.
                if (candidate.columns == 180) sums.add(pair, at.o, weight);
            }
        }
    if (within.empty()) fail(Fault::NoSolution, reference.name(), ": no valid cell to compare within 80 degrees");
    Sums all = within;
    all.add(grazing);
    return {all.errors(), within.errors()};
}

// Fills a row from a formula, which is even in cos(phi_d) but for the order of the directions: a quarter of a turn is
// enough.
void fill_from(const TableFormula &model, std::size_t h, std::size_t d, std::vector<Rgb> &row) {
    for (std::size_t p = 0; p < row.size(); ++p) {
        const std::size_t mirrored = std::min(p % 180, 180 - p % 180);
        const Cosines at = Brdf::cosines(h, d, p);
        if (mirrored < p)
            row[p] = row[mirrored];
        else if (at.i > 0.0 && at.o > 0.0)
            row[p] = model(h, d, at);
    }
}

} // namespace

BrdfErrors brdf_errors(const TableFormula &model, const Brdf &reference) {
    const auto fill = [&](std::size_t h, std::size_t d, std::vector<Rgb> &row) { fill_from(model, h, d, row); };
    return measure({reference.phi_d_count(), fill, [](std::size_t, std::size_t, std::size_t) { return true; }},
                   reference);
}

BrdfErrors brdf_errors(const Material &material, const Brdf &reference) {
    return brdf_errors(MaterialValue(material), reference);
}

BrdfErrors brdf_errors(const Brdf &brdf, const Brdf &reference) {
    const auto fill = [&](std::size_t h, std::size_t d, std::vector<Rgb> &row) {
        for (std::size_t p = 0; p < row.size(); ++p) row[p] = value_at(brdf, h, d, p);
    };
    const auto valid = [&](std::size_t h, std::size_t d, std::size_t p) { return valid_at(brdf, h, d, p); };
    return measure({std::max(brdf.phi_d_count(), reference.phi_d_count()), fill, valid}, reference);
}

} // namespace smx
