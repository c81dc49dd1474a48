// Directions that renderers draw (cl/visible_normals.clh) on the grid of hard cases, in three grades, against the
// oracle: the lobe, the normal of its facet, and the direction that it mirrors. SLOPEMIX_HARD_POINTS says how many,
// SLOPEMIX_HARD_CHECKED what share of them is evaluated at 60 digits too, SLOPEMIX_HARD_REPORT where to write the
// tables.
#include <gtest/gtest.h>

#include <iomanip>
#include <optional>
#include <sstream>

#include "big.h"
#include "device_buffer.h"
#include "device_lobe.h"
#include "dual.h"
#include "hard_probe.h"
#include "hard_run.h"
#include "hard_statistics.h"
#include "oracle_draws.h"

using test::Big;
using test::HardCase;
using test::HardPoint;
using test::HardSettings;
using test::HardStatistics;

namespace {

using Wide = long double;
using Dual = test::Dual<11>; // wo, X, alpha, u.y, u.z

constexpr std::size_t draws_per_case = 1000;
constexpr std::size_t numbers = 6; // of the normal and of wi
constexpr double least_uniform = 0x1p-25, most_uniform = 1.0 - 0x1p-24;

// Writes out[number][stride], then the squared alphas of the lobes that u.x chooses in both models.
constexpr const char *probe = R"(
inline VectorW vectors(__global const float *k, int stride, int at) {
    VectorW v = {load_floatsW(0, k + at), load_floatsW(0, k + stride + at), load_floatsW(0, k + 2 * stride + at)};
    return v;
}

__kernel void probe(__global real *out, int stride, __global const float *views, __global const float *uniforms,
                    __global const float *alphas, Displacement x, __constant Lobe *lobes, int count) {
    int at = W * (int)get_global_id(0);
    VectorW wo = vectors(views, stride, at), u = vectors(uniforms, stride, at);
    realW alpha = load_floatsW(0, alphas + at);
    Viewer v = viewer(&x, wo);
    VectorW m = visible_normal(&x, alpha * alpha, wo, v.o.p, u.y, u.z), wi = mirrored(wo, m);
    realW all[] = {m.x, m.y, m.z, wi.x, wi.y, wi.z, chosen_alpha2(lobes, count, 0, &v.o, u.x),
                   chosen_alpha2(lobes, count, 1, &v.o, u.x)};
    for (int k = 0; k < 8; ++k) vstoreW(all[k], 0, out + k * stride + at);
}
)";

struct Draw {
    std::array<float, 3> wo, u;
    std::size_t lobe;
};

// Half of the numbers from their ends on, the ends included.
float uniform(test::Random &random) {
    const std::size_t kind = random.below(8);
    const double u = kind == 0   ? 0.0
                     : kind == 1 ? most_uniform
                     : kind == 2 ? random.log_uniform(0x1p-24, 0.5)
                     : kind == 3 ? 1.0 - random.log_uniform(0x1p-24, 0.5)
                                 : random.uniform();
    return static_cast<float>(std::floor(u * 0x1p24) * 0x1p-24);
}

// From directions that see the surface.
std::vector<Draw> hard_draws(const HardCase &c, std::size_t count, uint64_t seed) {
    test::Random random(seed);
    std::vector<Draw> draws;
    for (const test::HardPair &pair : test::hard_pairs(c, 2 * count, seed)) {
        if (draws.size() == count) break;
        const auto &k = pair.wo;
        if (k[2] <= 0.0f || k[2] - k[0] * c.x.mean_x - k[1] * c.x.mean_y <= 0.0) continue;
        draws.push_back({k, {uniform(random), uniform(random), uniform(random)}, random.below(c.lobes.size())});
    }
    return draws;
}

// A slope in the tails changes by less than the share by which its uniform number does, and is rounded all the same: as
// a cause of errors it counts by itself at least.
template <class T>
T counted(T slope, [[maybe_unused]] std::size_t index) {
    if constexpr (std::is_same_v<T, Dual>) slope.by[index] = std::max(std::abs(slope.by[index]), std::abs(slope.value));
    return slope;
}

// The normal and wi of a draw. `variable` as in hard_truth.h, in the order of Dual's.
template <class T, class Variable>
std::array<T, numbers> truth(const HardCase &c, const Draw &d, Variable variable) {
    const auto x = oracle::gaussian_of<T>(variable(c.x.alpha_x, 3), variable(c.x.alpha_y, 4), variable(c.x.rho, 5),
                                          variable(c.x.mean_x, 6), variable(c.x.mean_y, 7));
    const oracle::GaussianOf<T> g = oracle::widened_by(x, variable(c.lobes[d.lobe].alpha, 8));
    const oracle::VecOf<T> wo = test::direction_of<T>(d.wo, 0, variable);
    const auto clamped = [](float u) { return std::clamp(double{u}, least_uniform, most_uniform); };
    const double u1 = clamped(d.u[1]), u2 = clamped(d.u[2]);
    using std::sqrt;
    const T v = oracle::plane(g, wo) / sqrt(oracle::spread2(g, wo));
    const T along = counted(oracle::visible_slope(v, test::value_of(v), variable(u1, 9), u1), 9);
    const T across = counted(oracle::gaussian_slope(variable(u2, 10), u2), 10);
    const oracle::VecOf<T> m = oracle::facet_along_view(g, wo, along, across), wi = oracle::mirrored_about(wo, m);
    return {m.x, m.y, m.z, wi.x, wi.y, wi.z};
}

constexpr auto variable = test::variable_of<Dual>;

// A view along the normal of a lobe's ellipse sees all azimuths alike: which one is drawn is not said.
bool has_azimuth(const HardCase &c, const Draw &d) {
    const oracle::GaussianOf<Wide> x = oracle::gaussian_of<Wide>(c.x.alpha_x, c.x.alpha_y, c.x.rho, 0.0L, 0.0L);
    const auto wo = test::direction_of<Wide>(d.wo, 0, test::constant_of<Wide>);
    return oracle::spread2(oracle::widened_by(x, Wide(c.lobes[d.lobe].alpha)), wo) > 0x1p-120L;
}

// Whether u.x may choose a lobe of this alpha, its share's ends `error` off: by weights and, of the shared model, by
// what wo sees.
bool may_choose(const HardCase &c, const Draw &d, bool per_lobe, double alpha2, double error) {
    const auto wo = test::direction_of<Wide>(d.wo, 0, test::constant_of<Wide>);
    const oracle::GaussianOf<Wide> x =
        oracle::gaussian_of<Wide>(c.x.alpha_x, c.x.alpha_y, c.x.rho, c.x.mean_x, c.x.mean_y);
    std::vector<Wide> below{0.0L};
    for (const oracle::Lobe &lobe : c.lobes) {
        const Wide seen = per_lobe ? 1.0L : oracle::sigma(oracle::widened_by(x, Wide(lobe.alpha)), wo);
        below.push_back(below.back() + Wide(lobe.weight) * seen);
    }
    for (std::size_t k = 0; k < c.lobes.size(); ++k) {
        const double wanted = c.lobes[k].alpha * c.lobes[k].alpha;
        const Wide low = below[k] / below.back(), high = below[k + 1] / below.back();
        if (std::abs(alpha2 - wanted) <= 0x1p-22 * wanted && low - error <= d.u[0] && d.u[0] <= high + error)
            return true;
    }
    return false;
}

// Where the derivative says too little. At its upper end a slope goes like the root of what u is below 1: there a share
// of u that is an error is more than that. And a facet that is steep along one axis alone turns so fast near slope 0
// that the second difference over such errors is more than what is allowed.
bool is_open(const HardCase &c, const Draw &d, const test::Promise &promise, std::size_t number) {
    if (1.0 - d.u[1] < 16 * promise.factor || 1.0 - d.u[2] < 16 * promise.factor) return true;
    const auto at = [&](std::size_t which, double share) {
        Draw moved = d;
        moved.u[which] = static_cast<float>(moved.u[which] * (1.0 + share));
        return truth<Wide>(c, moved, test::constant_of<Wide>)[number];
    };
    const Wide value = at(1, 0.0);
    for (const std::size_t which : {1, 2}) {
        const Wide second = at(which, promise.factor) + at(which, -promise.factor) - 2.0L * value;
        if (std::abs(second) > promise.factor * std::abs(value)) return true;
    }
    return false;
}

struct Results {
    std::vector<HardStatistics> grades =
        test::statistics_of_grades(3, {"normal x", "normal y", "normal z", "wi x", "wi y", "wi z"},
                                   "wo | uniform numbers | X (alphas, rho, mean), alpha");
    std::size_t seen = 0, without_azimuth = 0, wrong_lobes = 0, oracle_checked = 0, oracle_wrong = 0;

    void merge(const Results &other) {
        for (std::size_t g = 0; g < grades.size(); ++g) grades[g].merge(other.grades[g]);
        seen += other.seen, without_azimuth += other.without_azimuth, wrong_lobes += other.wrong_lobes;
        oracle_checked += other.oracle_checked, oracle_wrong += other.oracle_wrong;
    }
};

std::string cells_of(const HardCase &c, const Draw &d) {
    std::ostringstream out;
    out << std::setprecision(9);
    for (const auto &k : {d.wo, d.u}) out << "(" << k[0] << ", " << k[1] << ", " << k[2] << ") | ";
    out << "X (" << c.x.alpha_x << ", " << c.x.alpha_y << ", " << c.x.rho << ", " << c.x.mean_x << ", " << c.x.mean_y
        << "), " << c.lobes[d.lobe].alpha;
    return out.str();
}

using Values = std::vector<std::vector<double>>; // [number][draw]

void compare_lobes(const HardCase &c, const Draw &d, const std::vector<Values> &values, std::size_t k,
                   Results &results) {
    // A share is a sum over lobes.
    const auto count = static_cast<double>(c.lobes.size());
    for (std::size_t g = 0; g < values.size(); ++g)
        for (std::size_t model = 0; model < 2; ++model)
            results.wrong_lobes += !may_choose(c, d, model == 1, values[g][numbers + model][k],
                                               std::max(count / 16, 1.0) * test::promises[g].factor);
}

void compare(const HardCase &c, const std::vector<Draw> &draws, const std::vector<Values> &values,
             const HardSettings &settings, std::size_t first, std::size_t step, Results &results) {
    for (std::size_t k = first; k < draws.size(); k += step) {
        const Draw &d = draws[k];
        if (test::is_spread_lost(c, d.wo) || test::is_sign_open(c, d.wo, test::promises[0].epsilon)) continue;
        compare_lobes(c, d, values, k, results);
        if (!has_azimuth(c, d)) {
            ++results.without_azimuth;
            continue;
        }
        const auto wide = truth<Wide>(c, d, test::constant_of<Wide>);
        const auto dual = truth<Dual>(c, d, variable);
        std::optional<std::array<Big, numbers>> big;
        const auto at_60_digits = [&](std::size_t q) {
            if (!big) big = truth<Big>(c, d, test::constant_of<Big>);
            return static_cast<double>((*big)[q]);
        };
        if (static_cast<double>(results.oracle_checked) <
            settings.checked_share * static_cast<double>(++results.seen)) {
            ++results.oracle_checked;
            for (std::size_t q = 0; q < numbers; ++q)
                results.oracle_wrong +=
                    std::abs(static_cast<double>(wide[q]) - at_60_digits(q)) >
                    test::promises[2].factor / 16 * (1.0 + dual[q].condition()) * std::abs(at_60_digits(q));
        }
        for (std::size_t g = 0; g < values.size(); ++g)
            for (std::size_t q = 0; q < numbers; ++q) {
                HardPoint point;
                point.quantity = q, point.got = values[g][q][k], point.wanted = static_cast<double>(wide[q]);
                point.condition = dual[q].condition();
                point.is_signed = q != 2;
                point.is_open = results.grades[g].is_wrong(point) && is_open(c, d, test::promises[g], q);
                results.grades[g].see(point, at_60_digits, [&] { return cells_of(c, d); });
            }
    }
}

// What the device draws.
class Probe {
  public:
    Probe(smx::Context &context, smx::Grade grade) : context_(context), grade_(grade) {
        cl::Program program(context.cl(), smx::kernel_source("visible_normals.clh") + probe);
        program.build(
            smx::build_options({{"W", static_cast<int>(context.width())}, {"GRADE", static_cast<int>(grade)}}).c_str());
        kernel_ = cl::Kernel(program, "probe");
    }

    Values run(const HardCase &c, const std::vector<Draw> &draws) {
        Values values(numbers + 2);
        smx::with_real(grade_, [&](auto real) { run_as<decltype(real)>(c, draws, values); });
        return values;
    }

  private:
    template <typename Real>
    void run_as(const HardCase &c, const std::vector<Draw> &draws, Values &values) {
        const std::size_t stride = smx::round_up(draws.size(), context_.width());
        std::vector<float> views(3 * stride), uniforms(3 * stride), alphas(stride);
        for (std::size_t k = 0; k < stride; ++k) {
            const Draw &d = draws[std::min(k, draws.size() - 1)];
            for (std::size_t axis = 0; axis < 3; ++axis)
                views[axis * stride + k] = d.wo[axis], uniforms[axis * stride + k] = d.u[axis];
            alphas[k] = static_cast<float>(c.lobes[d.lobe].alpha);
        }
        smx::Material material;
        material.model = smx::Model::Shared;
        for (const oracle::Lobe &lobe : c.lobes) material.lobes.push_back({lobe.weight, lobe.alpha});
        const cl::Buffer in[] = {smx::buffer_from(context_, views), smx::buffer_from(context_, uniforms),
                                 smx::buffer_from(context_, alphas)};
        const cl::Buffer lobes =
            smx::buffer_from(context_, smx::widened_lobes<Real>(material, test::displacement_of(c.x)));
        std::vector<Real> all(values.size() * stride);
        const cl::Buffer out = smx::empty_buffer<Real>(context_, all.size());
        kernel_.setArg(0, out);
        kernel_.setArg(1, static_cast<cl_int>(stride));
        for (cl_uint k = 0; k < 3; ++k) kernel_.setArg(2 + k, in[k]);
        smx::set_arg(kernel_, 5, test::displacement_of(c.x), grade_);
        kernel_.setArg(6, lobes);
        kernel_.setArg(7, static_cast<cl_int>(c.lobes.size()));
        context_.queue().enqueueNDRangeKernel(kernel_, cl::NullRange, cl::NDRange(stride / context_.width()));
        context_.queue().enqueueReadBuffer(out, CL_TRUE, 0, all.size() * sizeof(Real), all.data());
        for (std::size_t q = 0; q < values.size(); ++q)
            values[q].assign(all.begin() + static_cast<std::ptrdiff_t>(q * stride),
                             all.begin() + static_cast<std::ptrdiff_t>(q * stride + draws.size()));
    }

    smx::Context &context_;
    smx::Grade grade_;
    cl::Kernel kernel_;
};

Results run(const HardSettings &settings) {
    smx::Context context("", 0);
    std::vector<Probe> probes;
    const std::size_t grades = context.info().has_double ? 3 : 2;
    for (std::size_t g = 0; g < grades; ++g) probes.emplace_back(context, static_cast<smx::Grade>(g));
    std::vector<Results> parts(test::host_threads());
    double points = 0.0;
    for (std::size_t index = 0; points < settings.points; ++index) {
        const HardCase c = test::hard_case(index);
        const std::vector<Draw> draws = hard_draws(c, draws_per_case, index);
        if (draws.empty()) continue;
        std::vector<Values> values;
        for (Probe &p : probes) values.push_back(p.run(c, draws));
        test::in_threads(parts, [&](std::size_t first, std::size_t step, Results &part) {
            compare(c, draws, values, settings, first, step, part);
        });
        points += static_cast<double>(draws.size());
    }
    Results all;
    for (const Results &part : parts) all.merge(part);
    return all;
}

std::string written(const Results &results) {
    std::ostringstream out;
    out << results.seen << " draws, " << results.without_azimuth << " more from directions without an azimuth; "
        << results.oracle_checked << " at 60 digits too\n";
    for (const HardStatistics &grade : results.grades) grade.write(out);
    return out.str();
}

} // namespace

TEST(HardDraws, LobesNormalsAndDirectionsAreAsPromised) {
    const HardSettings settings;
    const Results results = run(settings);
    for (const HardStatistics &grade : results.grades) EXPECT_EQ(grade.failures(), 0u) << written(results);
    EXPECT_EQ(results.wrong_lobes, 0u);
    EXPECT_EQ(results.oracle_wrong, 0u);
    EXPECT_GE(static_cast<double>(results.seen), 0.5 * settings.points);
    settings.write_report(written(results));
}
