// Slopes and facets that the reference draws (cl/quantile.clh, cl/draw_facets.cl) against the oracle, on hard surfaces:
// quantiles down to the least mass that is drawn, facets of X and their densities over solid angle. The kernels are of
// floats in every grade. SLOPEMIX_HARD_POINTS says how many, SLOPEMIX_HARD_CHECKED what share of them is evaluated at
// 60 digits too, SLOPEMIX_HARD_REPORT where to write the tables.
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "big.h"
#include "device_buffer.h"
#include "dual.h"
#include "hard_probe.h"
#include "hard_run.h"
#include "hard_statistics.h"
#include "oracle_draws.h"

using test::Big;
using test::HardPoint;
using test::HardStatistics;
using test::HardSurface;

namespace {

using Wide = long double;
using Dual = test::Dual<7>; // t1, t2, X; of a slope, the mass

constexpr std::size_t draws_per_case = 1000;
const std::vector<std::string> names{"slope", "normal x", "normal y", "normal z", "1 / z", "density"};

struct Place {
    cl_uint whole, strata, graded;
    cl_float fraction;
};

struct Draw {
    Place along_1, along_2;
};

// Writes t1, t2, then the facet as draw_facets.cl stores it but for the weights.
constexpr const char *probe = R"(
typedef struct { uint whole, strata, graded; float fraction; } Place;
typedef struct { Place along_1, along_2; } Draw;
inline DrawnSlope slope_of(Place p) { return slope_at(p.whole, p.strata, p.graded, p.fraction); }
__kernel void probe(__global float *out, int stride, __global const Draw *draws, Displacement x) {
    uint at = (uint)get_global_id(0);
    Draw d = draws[at];
    DrawnSlope along_1 = slope_of(d.along_1), along_2 = slope_of(d.along_2);
    out[at] = along_1.t;
    out[stride + at] = along_2.t;
    along_1.weight = along_2.weight = 1.0f;
    store_facet_of_x(out + 2 * stride, stride, at, x, along_1, along_2);
}
)";

// The middle, either tail to its end, and everywhere between.
Place draw(test::Random &random) {
    constexpr std::array<cl_uint, 6> counts{1, 2, 7, 4096, 65536, 1 << 24};
    const cl_uint strata = counts[random.below(counts.size())], graded = random.below(2) ? strata / 8 : 0;
    const std::size_t kind = random.below(4);
    const cl_uint whole = kind == 0 ? 0 : kind == 1 ? strata - 1 : static_cast<cl_uint>(random.below(strata));
    const double u = kind < 2 ? random.log_uniform(0x1p-24, 0.5) : random.uniform();
    const auto fraction = static_cast<float>(std::min(std::max(u, 0x1p-24), 1.0 - 0x1p-24));
    return {whole, strata, graded, kind == 1 ? 1.0f - fraction : fraction};
}

std::vector<Draw> draws(std::size_t count, uint64_t seed) {
    test::Random random(seed);
    std::vector<Draw> list(count);
    for (Draw &d : list) d.along_1 = draw(random), d.along_2 = draw(random);
    return list;
}

// Mass of the first `before` strata and a fraction of the next.
template <class T>
T mass_of_strata(const Place &p, cl_uint before, const T &fraction) {
    const auto mass_of = [&](cl_uint count) { // of whole ones, no more than half of all
        const double graded = std::min(count, p.graded);
        return p.graded ? T(graded * graded) / T(2.0 * p.graded) + T(count - graded) : T(static_cast<double>(count));
    };
    const T begin = mass_of(before);
    return (begin + (mass_of(before + 1) - begin) * fraction) / T(static_cast<double>(p.strata - p.graded));
}

// A slope of exp(-t^2) / sqrt(pi) at its place, by the mass beyond it on the nearer side, which is what conditions
// count.
template <class T, class Variable>
T slope_of(const Place &p, Variable make) {
    const bool is_low = static_cast<double>(p.whole) + static_cast<double>(p.fraction) < 0.5 * p.strata;
    const T fraction(static_cast<double>(p.fraction));
    const T mass =
        is_low ? mass_of_strata(p, p.whole, fraction) : mass_of_strata(p, p.strata - 1 - p.whole, T(1.0) - fraction);
    const T t = oracle::gaussian_slope(make(mass, 0), test::value_of(mass));
    return is_low ? t : T(0.0) - t;
}

// The facet of slopes t1, t2 deviations along X's principal axes: x, y, z, 1 / z, and its density.
template <class T>
std::array<T, 5> facet(const T &t1, const T &t2, const T &ax, const T &ay, const T &rho, const T &mx, const T &my) {
    using std::atan2, std::exp, std::sqrt;
    const T xx = ax * ax, yy = ay * ay, xy = rho * ax * ay, half = (xx - yy) / T(2.0);
    const T radius = sqrt(half * half + xy * xy), larger = (xx + yy) / T(2.0) + radius;
    const T det = xx * yy * (T(1.0) - rho) * (T(1.0) + rho);
    const bool aligned = !(xy < T(0.0)) && !(T(0.0) < xy);
    const T var_1 = aligned ? xx : larger, var_2 = aligned ? yy : det / larger;
    // Cosine and sine of half the angle of (half, xy), each by the form that does not cancel.
    const T along = (half < T(0.0) ? T(0.0) - half : half) + radius, length = sqrt(along * along + xy * xy);
    T c = T(1.0), s = T(0.0);
    if (!aligned) {
        c = along / length, s = xy / length;
        if (half < T(0.0)) c = xy / length, s = along / length;
    }
    const T d1 = sqrt(var_1) * t1, d2 = sqrt(var_2) * t2;
    const T sx = mx + c * d1 - s * d2, sy = my + s * d1 + c * d2, inv_z = sqrt(T(1.0) + sx * sx + sy * sy);
    const T peak = T(1.0) / (oracle::pi_of<T>() * sqrt(det));
    return {T(0.0) - sx / inv_z, T(0.0) - sy / inv_z, T(1.0) / inv_z, inv_z,
            peak * exp(T(0.0) - t1 * t1 - t2 * t2) * inv_z * inv_z * inv_z};
}

const auto constant = []<class T>(std::type_identity<T>) { return [](T value, std::size_t) { return value; }; };
constexpr auto variable = [](Dual value, std::size_t index) { return Dual::variable(value.value, index); };

template <class T, class Variable>
std::array<T, 5> facet_of(const HardSurface &x, double t1, double t2, Variable make) {
    return facet(make(T(t1), 0), make(T(t2), 1), make(T(x.alpha_x), 2), make(T(x.alpha_y), 3), make(T(x.rho), 4),
                 make(T(x.mean_x), 5), make(T(x.mean_y), 6));
}

struct Results {
    HardStatistics precise = test::statistics_of_grades(1, names, "place, or slopes and X (alphas, rho, mean)").front();
    std::size_t seen = 0, oracle_checked = 0, oracle_wrong = 0;
    double checked_share = 0.01;

    bool is_to_be_checked() {
        return static_cast<double>(oracle_checked) < checked_share * static_cast<double>(++seen);
    }
    void check(Wide wide, double condition, const Big &big) {
        ++oracle_checked;
        const auto wanted = static_cast<double>(big);
        oracle_wrong += std::abs(static_cast<double>(wide) - wanted) >
                        test::promises[2].factor / 16 * (1.0 + condition) * std::abs(wanted);
    }
    void merge(const Results &other) {
        precise.merge(other.precise);
        seen += other.seen, oracle_checked += other.oracle_checked, oracle_wrong += other.oracle_wrong;
    }
};

HardPoint point(std::size_t quantity, double got, Wide wanted, const Dual &dual, bool is_signed) {
    HardPoint p;
    p.quantity = quantity, p.got = got, p.wanted = static_cast<double>(wanted), p.is_signed = is_signed;
    p.condition = p.wanted == 0.0 ? 0.0 : dual.condition();
    return p;
}

void compare_slope(const Place &place, double got, Results &results) {
    const Wide wide = slope_of<Wide>(place, constant(std::type_identity<Wide>()));
    const Dual dual = slope_of<Dual>(place, variable);
    const auto big = [&] { return slope_of<Big>(place, constant(std::type_identity<Big>())); };
    if (results.is_to_be_checked()) results.check(wide, dual.condition(), big());
    results.precise.see(
        point(0, got, wide, dual, true), [&](std::size_t) { return static_cast<double>(big()); },
        [&] {
            std::ostringstream out;
            out << std::setprecision(9) << "(" << place.whole << " + " << place.fraction << ") / " << place.strata
                << ", " << place.graded << " graded";
            return out.str();
        });
}

void compare_facet(const HardSurface &x, const double (&t)[2], const double (&got)[5], Results &results) {
    const auto wide = facet_of<Wide>(x, t[0], t[1], constant(std::type_identity<Wide>()));
    const auto dual = facet_of<Dual>(x, t[0], t[1], variable);
    const auto big = [&](std::size_t q) {
        return facet_of<Big>(x, t[0], t[1], constant(std::type_identity<Big>()))[q];
    };
    const bool has_density = x.alpha_x > 0.0 && x.alpha_y > 0.0;
    for (std::size_t q = 0; q < (has_density ? 5 : 4); ++q) {
        if (results.is_to_be_checked()) results.check(wide[q], dual[q].condition(), big(q));
        results.precise.see(
            point(1 + q, got[q], wide[q], dual[q], q < 2),
            [&](std::size_t quantity) { return static_cast<double>(big(quantity - 1)); },
            [&] {
                std::ostringstream out;
                out << std::setprecision(9) << "(" << t[0] << ", " << t[1] << "), X (" << x.alpha_x << ", " << x.alpha_y
                    << ", " << x.rho << ", " << x.mean_x << ", " << x.mean_y << ")";
                return out.str();
            });
    }
}

// What the device draws: [number][draw], slopes first.
class Probe {
  public:
    Probe() {
        cl::Program program(context_.cl(), smx::kernel_source("draw_facets.cl") + probe);
        program.build(smx::build_options({{"W", 1}, {"GRADE", 0}}).c_str());
        kernel_ = cl::Kernel(program, "probe");
    }

    std::vector<float> run(const HardSurface &x, const std::vector<Draw> &list) {
        const cl::Buffer in = smx::buffer_from(context_, list),
                         out = smx::empty_buffer<float>(context_, 7 * list.size());
        kernel_.setArg(0, out);
        kernel_.setArg(1, static_cast<cl_int>(list.size()));
        kernel_.setArg(2, in);
        smx::set_arg(kernel_, 3, test::displacement_of(x), smx::Grade::Precise);
        context_.queue().enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(list.size()));
        std::vector<float> got(7 * list.size());
        context_.queue().enqueueReadBuffer(out, CL_TRUE, 0, got.size() * sizeof(float), got.data());
        return got;
    }

  private:
    smx::Context context_{"", 1};
    cl::Kernel kernel_;
};

void compare(const HardSurface &x, const std::vector<Draw> &list, const std::vector<float> &all, std::size_t first,
             std::size_t step, Results &results) {
    for (std::size_t k = first; k < list.size(); k += step) {
        const auto number = [&](std::size_t q) { return static_cast<double>(all[q * list.size() + k]); };
        const double t[] = {number(0), number(1)};
        compare_slope(list[k].along_1, t[0], results);
        compare_slope(list[k].along_2, t[1], results);
        compare_facet(x, t, {number(2), number(3), number(4), number(5), number(6)}, results);
    }
}

HardStatistics seen_of(const Place &place, double slope) {
    Results results;
    compare_slope(place, slope, results);
    return results.precise;
}

} // namespace

TEST(HardSamples, SlopesAndFacetsAreAsPromised) {
    const test::HardSettings settings;
    std::vector<Results> parts(test::host_threads());
    for (Results &part : parts) part.checked_share = settings.checked_share;
    Probe probe;
    for (std::size_t index = 0; static_cast<double>(index * draws_per_case) < settings.points; ++index) {
        const HardSurface x = test::hard_case(index).x;
        const std::vector<Draw> list = draws(draws_per_case, index);
        const std::vector<float> got = probe.run(x, list);
        test::in_threads(parts, [&](std::size_t first, std::size_t step, Results &part) {
            compare(x, list, got, first, step, part);
        });
    }
    Results all;
    for (const Results &part : parts) all.merge(part);
    std::ostringstream tables;
    tables << all.oracle_checked << " of " << all.seen << " numbers at 60 digits too\n";
    all.precise.write(tables);
    EXPECT_EQ(all.precise.failures(), 0u) << tables.str();
    EXPECT_EQ(all.oracle_wrong, 0u);
    for (const test::QuantityCounts &n : all.precise.counts())
        EXPECT_GE(static_cast<double>(n.points), 0.5 * settings.points);
    settings.write_report(tables.str());
}

// The comparison sees a quantile that is 1e-5 off.
TEST(HardSamples, SlopesOffAreSeen) {
    EXPECT_EQ(seen_of({0, 2, 0, 0.5f}, -0.47693627620446987).failures(), 0u);
    EXPECT_EQ(seen_of({0, 2, 0, 0.5f}, -0.47693627620446987 * (1.0 + 1e-5)).failures(), 1u);
    EXPECT_EQ(seen_of({0, 65536, 0, 0x1p-24f}, -4.9).failures(), 1u);
    // The first of 8 strata, when it is graded, ends at 1/14.
    EXPECT_EQ(seen_of({1, 8, 1, 0x1p-24f}, -1.0360767508316173).failures(), 0u);
    EXPECT_EQ(seen_of({1, 8, 0, 0x1p-24f}, -1.0360767508316173).failures(), 1u);
}
