// How far the numbers of a grade are from the truth over many hard points, in units of what is allowed: counts,
// distribution, worst points, and all of it as a table.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace test {

// What is promised of a grade (docs/stability.md): error over |value| at most `factor` (1 + condition).
struct Promise {
    const char *name;
    double epsilon; // of its arithmetic
    double factor;
    double asks_again;       // share of what is allowed from which on the truth is taken at 60 digits
    double well_conditioned; // and at most this where the condition is below 10; infinity where nothing more is said
};
inline constexpr double no_promise = std::numeric_limits<double>::infinity();
// (Of fast, whose polynomials are made to err by as much as they may, a quarter would be every tenth point.)
inline constexpr std::array<Promise, 3> promises{{{"precise", 0x1p-23, 16 * 0x1p-23, 0.25, 1e-5},
                                                  {"fast", 0x1p-23, 2e-4, 1.0, no_promise},
                                                  {"double", 0x1p-52, 16 * 0x1p-52, 0.25, no_promise}}};

struct HardPoint {
    std::size_t quantity = 0;
    double got = 0.0, wanted = 0.0, condition = 0.0;
    bool is_open = false;    // nothing is determined, whatever the condition
    bool is_signed = false;  // of a quantity that may be negative
    bool may_cancel = false; // of one that is 0 at a place, and around it a difference
    double ratio = 0.0;      // of the error to what is allowed
    std::string where;       // its inputs, as cells of a table
};

struct QuantityCounts {
    std::size_t points = 0;
    std::size_t not_finite = 0, negative = 0, zero = 0; // zero: where the truth is a normal float
    std::size_t wrong = 0;                              // error above what is allowed, or no number
    std::size_t undetermined = 0;        // of `points`: more than 1 is allowed, so that only the above could fail
    std::array<std::size_t, 4> within{}; // error at most 1/64, 1/16, 1/4, 1 of what is allowed
    double largest = 0.0;                // error over what is allowed
    double largest_error = 0.0;          // relative, where the condition is below 10

    std::size_t failures() const { return not_finite + negative + zero + wrong; }
};

class HardStatistics {
  public:
    // `names` of the quantities; `inputs` is the head of the cells that say where a point is.
    HardStatistics(const Promise &promise, std::vector<std::string> names, std::string inputs)
        : promise_(promise), names_(std::move(names)), inputs_(std::move(inputs)), counts_(names_.size()) {}

    const Promise &promise() const { return promise_; }

    // Whether the error is above what is allowed.
    bool is_wrong(const HardPoint &point) const;

    // `wanted` and its condition from the oracle. `better(quantity)` gives the truth at 60 digits: it is asked for
    // where the error comes near what is allowed. `where()` gives the cells of its inputs.
    template <class Better, class Where>
    void see(HardPoint point, Better better, Where where) {
        if (is_told_by_error(point) && error_ratio(point) > promise_.asks_again) point.wanted = better(point.quantity);
        if (!count(point) || !is_among_worst(point)) return;
        point.where = where();
        keep(point);
    }
    void merge(const HardStatistics &other);

    const std::vector<QuantityCounts> &counts() const { return counts_; }
    std::size_t failures() const;
    void write(std::ostream &out) const;

  private:
    // Not where nothing is determined, and not below a normal float, where no relative error is asked for.
    bool is_told_by_error(const HardPoint &point) const {
        return !point.is_open && std::abs(point.wanted) >= 0x1p-126 && promise_.factor * (1.0 + point.condition) < 1.0;
    }
    // Infinity where a condition that is not finite, or a NaN, would say nothing.
    double error_ratio(const HardPoint &point) const;
    // Whether what is not determined is so by a factor that takes it below a normal float, by a difference, or at all.
    bool may_be_zero(const HardPoint &point) const;
    // Whether it has a ratio, which it is given.
    bool count(HardPoint &point);
    bool is_among_worst(const HardPoint &point) const;
    void keep(const HardPoint &point);

    Promise promise_;
    std::vector<std::string> names_;
    std::string inputs_;
    std::vector<QuantityCounts> counts_;
    std::vector<HardPoint> worst_; // ten, the worst first
};

// The same for each of these grades.
std::vector<HardStatistics> statistics_of_grades(std::size_t grades, const std::vector<std::string> &names,
                                                 const std::string &inputs);

} // namespace test
