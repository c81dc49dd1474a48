#include "hard_statistics.h"

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace test {

namespace {

constexpr double smallest_float = 0x1p-126;
constexpr std::size_t worst_kept = 10;
constexpr std::array<double, 4> steps{1.0 / 64, 1.0 / 16, 1.0 / 4, 1.0};

} // namespace

double HardStatistics::error_ratio(const HardPoint &p) const {
    const double ratio = std::abs(p.got / p.wanted - 1.0) / (promise_.factor * (1.0 + p.condition));
    return std::isfinite(p.condition) && !std::isnan(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

bool HardStatistics::is_wrong(const HardPoint &p) const {
    if (std::abs(p.wanted) < smallest_float) return std::abs(p.got) > (p.wanted == 0.0 ? 0.0 : 2 * smallest_float);
    return error_ratio(p) > 1.0 || (p.condition < 10.0 && std::abs(p.got / p.wanted - 1.0) > promise_.well_conditioned);
}

bool HardStatistics::may_be_zero(const HardPoint &p) const {
    return p.is_open || p.is_signed || p.may_cancel ||
           std::log(p.wanted / smallest_float) <= promise_.factor * (1.0 + p.condition);
}

bool HardStatistics::count(HardPoint &p) {
    QuantityCounts &c = counts_[p.quantity];
    const bool is_small = std::abs(p.wanted) < smallest_float; // or 0: no relative error is asked for
    ++c.points;
    p.ratio = std::numeric_limits<double>::infinity();
    if (!std::isfinite(p.got)) return ++c.not_finite, true;
    if (p.got < 0.0 && !p.is_signed) return ++c.negative, true;
    if (is_small && !is_wrong(p)) return ++c.within[0], false;
    const bool undetermined = p.is_open || (std::isfinite(p.condition) && promise_.factor * (1.0 + p.condition) >= 1.0);
    c.undetermined += undetermined;
    if (is_small) return c.wrong += !undetermined, !undetermined;
    if (p.got == 0.0 && !(undetermined && may_be_zero(p))) return ++c.zero, true;
    if (undetermined) return false;
    p.ratio = error_ratio(p);
    c.largest = std::max(c.largest, p.ratio);
    const double error = std::abs(p.got / p.wanted - 1.0);
    if (p.condition < 10.0) c.largest_error = std::max(c.largest_error, error);
    c.wrong += is_wrong(p);
    for (std::size_t k = 0; k < steps.size(); ++k)
        if (p.ratio <= steps[k]) {
            ++c.within[k];
            break;
        }
    return true;
}

bool HardStatistics::is_among_worst(const HardPoint &p) const {
    return worst_.size() < worst_kept || p.ratio > worst_.back().ratio;
}

void HardStatistics::keep(const HardPoint &p) {
    const auto place =
        std::find_if(worst_.begin(), worst_.end(), [&](const HardPoint &w) { return p.ratio > w.ratio; });
    worst_.insert(place, p);
    if (worst_.size() > worst_kept) worst_.pop_back();
}

void HardStatistics::merge(const HardStatistics &other) {
    for (std::size_t q = 0; q < counts_.size(); ++q) {
        QuantityCounts &a = counts_[q];
        const QuantityCounts &b = other.counts_[q];
        a.points += b.points, a.not_finite += b.not_finite, a.negative += b.negative, a.zero += b.zero;
        a.wrong += b.wrong, a.undetermined += b.undetermined;
        for (std::size_t k = 0; k < a.within.size(); ++k) a.within[k] += b.within[k];
        a.largest = std::max(a.largest, b.largest), a.largest_error = std::max(a.largest_error, b.largest_error);
    }
    for (const HardPoint &p : other.worst_)
        if (is_among_worst(p)) keep(p);
}

std::size_t HardStatistics::failures() const {
    std::size_t sum = 0;
    for (const QuantityCounts &c : counts_) sum += c.failures();
    return sum;
}

void HardStatistics::write(std::ostream &out) const {
    out << "\n### " << promise_.name << "\n\n"
        << "| quantity | points | not finite | negative | lost to 0 | wrong | <= 1/64 | <= 1/16 | <= 1/4 | <= 1 | "
           "undetermined | largest error / bound | largest error, cond < 10 |\n|"
        << " --- |";
    for (int k = 0; k < 12; ++k) out << " --- |";
    for (std::size_t q = 0; q < counts_.size(); ++q) {
        const QuantityCounts &c = counts_[q];
        if (c.points == 0) continue;
        out << "\n| " << names_[q] << " | " << c.points << " | " << c.not_finite << " | " << c.negative << " | "
            << c.zero << " | " << c.wrong;
        for (std::size_t n : c.within) out << " | " << n;
        out << std::setprecision(2) << " | " << c.undetermined << " | " << c.largest << " | " << c.largest_error
            << " |";
    }
    out << "\n\n| error / bound | quantity | got | wanted | cond | " << inputs_ << " |\n| --- |";
    for (std::size_t k = 0; k < 5 + static_cast<std::size_t>(std::count(inputs_.begin(), inputs_.end(), '|')); ++k)
        out << " --- |";
    out << "\n";
    for (const HardPoint &p : worst_)
        out << std::setprecision(3) << "| " << p.ratio << " | " << names_[p.quantity] << std::setprecision(9) << " | "
            << p.got << " | " << p.wanted << std::setprecision(3) << " | " << p.condition << " | " << p.where << " |\n";
}

std::vector<HardStatistics> statistics_of_grades(std::size_t grades, const std::vector<std::string> &names,
                                                 const std::string &inputs) {
    std::vector<HardStatistics> list;
    for (std::size_t g = 0; g < grades; ++g) list.emplace_back(promises[g], names, inputs);
    return list;
}

} // namespace test
