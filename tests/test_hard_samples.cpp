// Slopes and facets that the reference draws (cl/quantile.clh, cl/draw_facets.cl) against the oracle, on hard surfaces:
// quantiles down to the least mass that is drawn, facets of X and their densities over solid angle. The kernels are of
// floats in every grade. SLOPEMIX_HARD_POINTS says how many.
#include <gtest/gtest.h>

#include <cstdlib>

#include "device_buffer.h"
#include "dual.h"
#include "hard_probe.h"

namespace {

using Wide = long double;
using Dual = test::Dual<7>; // t1, t2, X

constexpr double epsilon = 0x1p-23;
constexpr double factor = 16 * epsilon; // of (1 + condition)
constexpr double well_conditioned = 1e-5;
constexpr double smallest_float = 0x1p-126;

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
Wide mass_of_strata(const Place &p, cl_uint before, Wide fraction) {
    const auto mass_of = [&](cl_uint count) { // of whole ones, no more than half of all
        const cl_uint graded = std::min(count, p.graded);
        return p.graded ? Wide(graded) * graded / (2.0L * p.graded) + (count - graded) : Wide(count);
    };
    const Wide begin = mass_of(before);
    return (begin + (mass_of(before + 1) - begin) * fraction) / (p.strata - p.graded);
}

// Error of a slope t of exp(-t^2) / sqrt(pi) at its place, over what is allowed. The mass below t is compared, from the
// nearer end, and its difference told in t.
double slope_error(const Place &p, double t) {
    const auto fraction = static_cast<Wide>(p.fraction);
    const Wide half = 0.5L, whole = p.whole;
    const bool is_low = whole + fraction < half * p.strata;
    const Wide mass =
        is_low ? mass_of_strata(p, p.whole, fraction) : mass_of_strata(p, p.strata - 1 - p.whole, 1.0L - fraction);
    const Wide side = is_low ? -1.0L : 1.0L;
    const Wide density = std::exp(-Wide(t) * t) / std::sqrt(oracle::pi_of<Wide>());
    const Wide off = std::abs(std::erfc(side * Wide(t)) / 2.0L - mass) / density;
    const Wide condition = mass / (density * std::max(std::abs(Wide(t)), Wide(smallest_float)));
    return static_cast<double>(off / (std::abs(Wide(t)) * factor * (1.0L + condition)));
}

// The facet of slopes t1, t2 deviations along X's principal axes, by angles: x, y, z, 1 / z, and its density.
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

struct Tally {
    std::size_t points = 0, wrong = 0;
    double worst = 0.0;
    std::string where;

    void see(double ratio, const std::string &what) {
        ++points;
        if (!(ratio <= 1.0)) ++wrong;
        if (!(ratio <= worst)) worst = ratio, where = what;
    }
};

void compare_facets(const test::HardSurface &x, const std::vector<float> &out, std::size_t count, Tally &tally) {
    for (std::size_t k = 0; k < count; ++k) {
        const double in[] = {out[k], out[count + k], x.alpha_x, x.alpha_y, x.rho, x.mean_x, x.mean_y};
        Dual dual[7];
        Wide wide[7];
        for (std::size_t j = 0; j < 7; ++j) dual[j] = Dual::variable(in[j], j), wide[j] = in[j];
        const auto conditions = facet(dual[0], dual[1], dual[2], dual[3], dual[4], dual[5], dual[6]);
        const auto wanted = facet(wide[0], wide[1], wide[2], wide[3], wide[4], wide[5], wide[6]);
        const bool has_density = x.alpha_x > 0.0 && x.alpha_y > 0.0;
        for (std::size_t q = 0; q < (has_density ? 5 : 4); ++q) {
            const double got = out[(2 + q) * count + k], truth = static_cast<double>(wanted[q]);
            if (std::abs(truth) < smallest_float) continue;
            const double condition = conditions[q].condition(), error = std::abs(got / truth - 1.0);
            double ratio = error / (factor * (1.0 + condition));
            if (condition < 10.0) ratio = std::max(ratio, error / well_conditioned);
            const bool is_sound = std::isfinite(got) && (q < 2 || got >= 0.0);
            std::ostringstream what;
            what << "facet[" << q << "] of (" << in[0] << ", " << in[1] << "), X (" << x.alpha_x << ", " << x.alpha_y
                 << ", " << x.rho << ", " << x.mean_x << ", " << x.mean_y << "): got " << got << ", wanted " << truth
                 << ", condition " << condition;
            tally.see(is_sound ? ratio : HUGE_VAL, what.str());
        }
    }
}

} // namespace

TEST(HardSamples, SlopesAndFacetsAreAsPromised) {
    const char *text = std::getenv("SLOPEMIX_HARD_POINTS");
    const double points = text ? std::atof(text) : 2e5;
    constexpr std::size_t per_case = 1000;
    smx::Context context("", 1);
    cl::Program program(context.cl(), smx::kernel_source("draw_facets.cl") + probe);
    program.build(smx::build_options({{"W", 1}, {"GRADE", 0}}).c_str());
    cl::Kernel kernel(program, "probe");
    Tally slopes, facets;
    for (std::size_t index = 0; static_cast<double>(index * per_case) < points; ++index) {
        const test::HardSurface x = test::hard_case(index).x;
        const std::vector<Draw> list = draws(per_case, index);
        const cl::Buffer in = smx::buffer_from(context, list), out = smx::empty_buffer<float>(context, 7 * per_case);
        kernel.setArg(0, out);
        kernel.setArg(1, static_cast<cl_int>(per_case));
        kernel.setArg(2, in);
        smx::set_arg(kernel, 3, test::displacement_of(x), smx::Grade::Precise);
        context.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(per_case));
        std::vector<float> got(7 * per_case);
        context.queue().enqueueReadBuffer(out, CL_TRUE, 0, got.size() * sizeof(float), got.data());
        for (std::size_t k = 0; k < per_case; ++k) {
            const Draw &d = list[k];
            const double t[] = {got[k], got[per_case + k]};
            for (int axis = 0; axis < 2; ++axis) {
                std::ostringstream what;
                const Place &p = axis ? d.along_2 : d.along_1;
                what << "slope at (" << p.whole << " + " << p.fraction << ") / " << p.strata << ", " << p.graded
                     << " graded: " << t[axis];
                slopes.see(slope_error(p, t[axis]), what.str());
            }
        }
        compare_facets(x, got, per_case, facets);
    }
    for (const Tally *tally : {&slopes, &facets}) {
        EXPECT_GT(tally->points, 0u);
        EXPECT_EQ(tally->wrong, 0u) << "of " << tally->points << ", the worst " << tally->worst
                                    << " times too far: " << tally->where;
        RecordProperty("worst", std::to_string(tally->worst));
    }
    if (std::getenv("SLOPEMIX_HARD_REPORT"))
        std::cout << slopes.points << " slopes, error over bound at most " << slopes.worst << "; " << facets.points
                  << " numbers of facets, " << facets.worst << "\n";
}

// The comparison sees a quantile that is 1e-5 off.
TEST(HardSamples, SlopesOffAreSeen) {
    EXPECT_LT(slope_error({0, 2, 0, 0.5f}, -0.47693627620446987), 0.01);
    EXPECT_GT(slope_error({0, 2, 0, 0.5f}, -0.47693627620446987 * (1.0 + 1e-5)), 1.0);
    EXPECT_GT(slope_error({0, 65536, 0, 0x1p-24f}, -4.9), 1.0);
    // The first of 8 strata, when it is graded, ends at 1/14.
    EXPECT_LT(slope_error({1, 8, 1, 0x1p-24f}, -1.0360767508316173), 0.1);
    EXPECT_GT(slope_error({1, 8, 0, 0x1p-24f}, -1.0360767508316173), 1.0);
}
