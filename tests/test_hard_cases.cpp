// Every number that the library computes, on the grid of hard cases, in three grades, against the oracle
// (docs/stability.md). SLOPEMIX_HARD_POINTS says how many pairs of directions, SLOPEMIX_HARD_CHECKED what share of them
// is evaluated at 60 digits too, SLOPEMIX_HARD_REPORT where to write the tables.
#include <gtest/gtest.h>

#include <iomanip>
#include <optional>
#include <sstream>

#include "big.h"
#include "dual.h"
#include "hard_probe.h"
#include "hard_run.h"
#include "hard_statistics.h"
#include "textbook.h"

using test::Big;
using test::HardCase;
using test::HardPair;
using test::HardPoint;
using test::HardSettings;
using test::HardStatistics;

namespace {

using Wide = long double;
using Dual = test::Dual<test::hard_variables>;

// The oracle's own error is below this share of what is allowed in double.
constexpr double oracle_share = 0x1p-4;
constexpr double smallest_float = 0x1p-126;
constexpr std::size_t pairs_per_case = 1000;
constexpr std::size_t report_every = 1000; // cases

constexpr auto variable = test::variable_of<Dual>;

template <class T, class Variable>
std::array<T, test::quantities> truth(const test::CaseOf<T> &c, const HardPair &pair, Variable make) {
    return test::truth_of(c, test::direction_of<T>(pair.wi, 0, make), test::direction_of<T>(pair.wo, 3, make));
}

// A case in all three arithmetics.
struct Truths {
    test::CaseOf<Wide> wide;
    test::CaseOf<Dual> dual;
    test::CaseOf<Big> big;

    explicit Truths(const HardCase &c)
        : wide(test::case_of<Wide>(c, test::constant_of<Wide>)),
          dual(test::case_of<Dual>(c, variable)),
          big(test::case_of<Big>(c, test::constant_of<Big>)) {}

    std::array<Big, test::quantities> at_60_digits(const HardPair &pair) const {
        return truth(big, pair, test::constant_of<Big>);
    }
};

constexpr const char *inputs = "wi | wo | X (alphas, rho, mean), lobes (weight, alpha)";

std::string cells_of(const HardCase &c, const HardPair &pair) {
    std::ostringstream out;
    out << std::setprecision(9);
    for (const auto &k : {pair.wi, pair.wo}) out << "(" << k[0] << ", " << k[1] << ", " << k[2] << ") | ";
    out << "X (" << c.x.alpha_x << ", " << c.x.alpha_y << ", " << c.x.rho << ", " << c.x.mean_x << ", " << c.x.mean_y
        << "), ";
    if (c.lobes.size() > 2)
        out << c.lobes.size() << " lobes";
    else
        for (const oracle::Lobe &lobe : c.lobes) out << "lobe (" << lobe.weight << ", " << lobe.alpha << ") ";
    return out.str();
}

struct Results {
    std::vector<HardStatistics> grades = test::statistics_of_grades(3, test::quantity_names(), inputs);
    HardStatistics textbook{
        {"textbook form, in float", 0x1p-23, 16 * 0x1p-23, test::no_promise, 1e-5}, test::quantity_names(), inputs};
    HardStatistics beside_textbook{
        {"precise, on the same points", 0x1p-23, 16 * 0x1p-23, 0.25, 1e-5}, test::quantity_names(), inputs};
    std::size_t seen = 0, unsound = 0, oracle_checked = 0, oracle_wrong = 0;
    double oracle_worst = 0.0; // error over what is allowed in double

    void merge(const Results &other) {
        for (std::size_t g = 0; g < grades.size(); ++g) grades[g].merge(other.grades[g]);
        textbook.merge(other.textbook);
        beside_textbook.merge(other.beside_textbook);
        seen += other.seen, unsound += other.unsound, oracle_checked += other.oracle_checked,
            oracle_wrong += other.oracle_wrong;
        oracle_worst = std::max(oracle_worst, other.oracle_worst);
    }
};

void check_oracle(const std::array<Wide, test::quantities> &wide, const std::array<Dual, test::quantities> &dual,
                  const std::array<Big, test::quantities> &big, Results &results) {
    ++results.oracle_checked;
    for (std::size_t q = 0; q < test::quantities; ++q) {
        const double wanted = static_cast<double>(big[q]);
        if (std::abs(wanted) < 0x1p-126) continue;
        const double error = static_cast<double>(abs(Big(static_cast<double>(wide[q])) - big[q])) / std::abs(wanted);
        const double ratio = error / (test::promises[2].factor * (1.0 + dual[q].condition()));
        results.oracle_worst = std::max(results.oracle_worst, ratio);
        results.oracle_wrong += !(ratio <= oracle_share);
    }
}

// Densities of drawn directions, and f cos with less than all masking, divide what the distribution of normals gives by
// an area that may be as small as it is: they come back to a float's range where that had left it.
bool is_lost_before_division(const std::array<Wide, test::quantities> &wide, std::size_t quantity) {
    if (quantity < test::quantity_density) return false;
    const Wide factor = quantity < test::quantity_less ? 1.0L : wide[test::quantity_fresnel];
    return wide[test::quantity_ndf] * factor / 4.0L < Wide(smallest_float);
}

// Whether the condition number, a first derivative, says too little: a curve's kink within the angle's error, a
// density's peak about a mean slope, a density of 0 whose exponent is not known well enough to be one.
bool is_open(const HardCase &c, const Truths &truths, const HardPair &pair, const test::Promise &promise,
             std::size_t quantity, double wanted, double got, const Dual &theta_d) {
    const bool has_fresnel = test::has_fresnel(quantity);
    if (has_fresnel && wanted != 0.0 &&
        test::is_near_knot(c, theta_d.value, promise.factor * (1.0 + theta_d.condition()) * theta_d.value))
        return true;
    const bool has_density = quantity == test::quantity_ndf || quantity >= test::quantity_shared;
    if (!has_density) return false;
    if (test::second_order(c, pair, promise.epsilon) > promise.factor) return true;
    if (wanted > smallest_float || got == 0.0) return false;
    const auto wi = test::direction_of<Dual>(pair.wi, 0, variable), wo = test::direction_of<Dual>(pair.wo, 3, variable);
    return test::may_have_density(truths.dual, wi + wo, promise.epsilon);
}

using Values = std::vector<std::vector<double>>;

// Numbers that are not finite, or negative, of a pair where no more is asked.
std::size_t count_unsound(const std::array<Wide, test::quantities> &wide, const Values &values, std::size_t pair) {
    std::size_t count = 0;
    for (std::size_t q = 0; q < test::quantities; ++q)
        count += wide[q] != Wide(test::no_value) && !(std::isfinite(values[q][pair]) && values[q][pair] >= 0.0);
    return count;
}

void compare(const HardCase &c, const std::vector<HardPair> &pairs, const std::vector<Values> &values,
             const HardSettings &settings, std::size_t first, std::size_t step, Results &results) {
    const Truths truths(c);
    const bool is_textbook = c.x.rho == 0.0 && c.x.mean_x == 0.0 && c.x.mean_y == 0.0;
    for (std::size_t k = first; k < pairs.size(); k += step) {
        const bool is_lost = test::is_spread_lost(c, pairs[k].wi) || test::is_spread_lost(c, pairs[k].wo);
        const auto wide = truth(truths.wide, pairs[k], test::constant_of<Wide>);
        const auto dual = truth(truths.dual, pairs[k], variable);
        std::optional<std::array<Big, test::quantities>> big;
        const auto at_60_digits = [&]() -> const std::array<Big, test::quantities> & {
            if (!big) big = truths.at_60_digits(pairs[k]);
            return *big;
        };
        if (static_cast<double>(results.oracle_checked) < settings.checked_share * static_cast<double>(++results.seen))
            check_oracle(wide, dual, at_60_digits(), results);
        const auto better = [&](std::size_t q) { return static_cast<double>(at_60_digits()[q]); };
        const auto see = [&](HardStatistics &statistics, std::size_t q, double got) {
            // A truth that is no 0 stays none.
            const auto rounded = static_cast<double>(wide[q]),
                       wanted = wide[q] > 0.0L ? std::max(rounded, 0x1p-1074) : rounded;
            if (wanted == test::no_value) return;
            HardPoint point;
            point.quantity = q, point.got = got, point.wanted = wanted;
            point.condition = wanted == 0.0 ? 0.0 : dual[q].condition();
            const bool is_lost_early = is_lost_before_division(wide, q);
            point.may_cancel = test::has_steep_fresnel(q) || is_lost_early;
            point.is_open = is_lost_early || ((statistics.is_wrong(point) || got == 0.0) &&
                                              is_open(c, truths, pairs[k], statistics.promise(), q, wanted, got,
                                                      dual[test::quantity_theta_d]));
            statistics.see(point, better, [&] { return cells_of(c, pairs[k]); });
        };
        for (std::size_t g = 0; g < values.size(); ++g) { // double only where the device has it
            const test::Promise &promise = test::promises[g];
            if (is_lost || test::is_sign_open(c, pairs[k].wi, promise.epsilon) ||
                test::is_sign_open(c, pairs[k].wo, promise.epsilon)) {
                results.unsound += count_unsound(wide, values[g], k);
                continue;
            }
            for (std::size_t q = 0; q < test::quantities; ++q) see(results.grades[g], q, values[g][q][k]);
        }
        if (is_textbook && !is_lost)
            for (const auto &[q, got] : test::textbook(c, pairs[k])) {
                see(results.textbook, q, got);
                see(results.beside_textbook, q, values[0][q][k]);
            }
    }
}

std::string tables_of(const Results &results) {
    std::ostringstream out;
    out << results.seen << " pairs of directions; " << results.oracle_checked
        << " of them at 60 digits too, where the oracle's error is at most " << results.oracle_worst
        << " of what is allowed in double\n";
    for (const HardStatistics &grade : results.grades) grade.write(out);
    results.textbook.write(out);
    results.beside_textbook.write(out);
    return out.str();
}

std::string worst_of(const HardStatistics &statistics) {
    std::ostringstream out;
    statistics.write(out);
    return out.str();
}

Results merged(const std::vector<Results> &parts) {
    Results all;
    for (const Results &part : parts) all.merge(part);
    return all;
}

Results run(const HardSettings &settings) {
    smx::Context context("", 0);
    std::vector<test::HardProbe> probes;
    const std::size_t grades = context.info().has_double ? 3 : 2;
    for (std::size_t g = 0; g < grades; ++g) probes.emplace_back(context, static_cast<smx::Grade>(g));
    std::vector<Results> parts(test::host_threads());
    for (std::size_t index = 0; static_cast<double>(index * pairs_per_case) < settings.points; ++index) {
        const HardCase c = test::hard_case(index);
        const std::vector<HardPair> pairs = test::hard_pairs(c, pairs_per_case, index);
        std::vector<Values> values(grades);
        // Every other case by kernels as images get them, without what its surface has no use for.
        const auto form = index % 2 ? test::HardProbe::Form::Least : test::HardProbe::Form::Full;
        for (std::size_t g = 0; g < grades; ++g) values[g] = probes[g].run(c, pairs, form);
        test::in_threads(parts, [&](std::size_t first, std::size_t step, Results &part) {
            compare(c, pairs, values, settings, first, step, part);
        });
        if (index % report_every == 0) settings.write_report(tables_of(merged(parts)));
    }
    const Results all = merged(parts);
    settings.write_report(tables_of(all));
    return all;
}

} // namespace

TEST(HardCases, AllNumbersAreAsPromised) {
    const HardSettings settings;
    const Results results = run(settings);
    for (const HardStatistics &grade : results.grades) {
        EXPECT_EQ(grade.failures(), 0u) << worst_of(grade);
        for (std::size_t q = 0; q < test::quantities; ++q)
            EXPECT_GE(static_cast<double>(grade.counts()[q].points), 0.4 * settings.points)
                << test::quantity_names()[q];
    }
    EXPECT_EQ(results.unsound, 0u);
    EXPECT_GE(static_cast<double>(results.oracle_checked), 0.9 * settings.checked_share * settings.points);
    EXPECT_EQ(results.oracle_wrong, 0u) << "the oracle's own error: " << results.oracle_worst;
    // The same points by the textbook's form, in each of its numbers: a checker that sees nothing there would see
    // nothing here.
    for (std::size_t q = 0; q < test::quantities; ++q) {
        const test::QuantityCounts &n = results.textbook.counts()[q];
        if (n.points == 0) continue;
        EXPECT_GT(static_cast<double>(n.failures()), 0.01 * static_cast<double>(n.points)) << test::quantity_names()[q];
    }
}

// What bounds are told by: condition numbers against differences of 60 digits.
TEST(HardCases, ConditionsAreThoseOfDifferences) {
    const HardCase c = {{0.3, 0.5, 0.4, 0.1, -0.2}, {{0.3, 0.05}, {0.7, 0.4}}, true};
    for (const HardPair &pair :
         {HardPair{{0.36f, 0.48f, 0.8f}, {-0.6f, 0.3f, 0.74f}}, HardPair{{0.9f, 0.1f, 0.3f}, {-0.8f, 0.2f, 0.1f}}}) {
        const auto moved = [&](std::size_t which, double sign) {
            const auto variable = [&](double value, std::size_t index) {
                return Big(value) * (Big(1.0) + (index == which ? Big(sign * 1e-15) : Big(0.0)));
            };
            return truth(test::case_of<Big>(c, variable), pair, variable);
        };
        const auto value = moved(test::hard_variables, 0.0);
        const auto dual = truth(test::case_of<Dual>(c, variable), pair, variable);
        std::array<double, test::quantities> condition{};
        for (std::size_t j = 0; j < test::hard_variables; ++j) {
            const auto above = moved(j, 1.0), below = moved(j, -1.0);
            for (std::size_t q = 0; q < test::quantities; ++q)
                condition[q] += std::abs(static_cast<double>((above[q] - below[q]) / (Big(2e-15) * value[q])));
        }
        for (std::size_t q = 0; q < test::quantities; ++q)
            EXPECT_NEAR(dual[q].condition(), condition[q], 1e-9 * (1.0 + condition[q])) << test::quantity_names()[q];
    }
}
