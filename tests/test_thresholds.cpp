// Where the device's functions change their form, a fine sweep shows no jump; limits are what they tend to
// (docs/stability.md lists the thresholds).
#include <gtest/gtest.h>

#include <cmath>

#include "device_buffer.h"
#include "hard_probe.h"

using test::HardCase;
using test::HardPair;
using test::HardProbe;
using Values = std::vector<std::vector<double>>;

namespace {

// Relative: of float and double, and of the fast grade, whose functions err by 1e-4.
constexpr double largest_jump[] = {1e-5, 2e-4, 1e-5};

smx::Context &context() {
    static smx::Context context("", 1);
    return context;
}

bool has(smx::Grade grade) { return grade != smx::Grade::Double || context().info().has_double; }

enum class Of { Functions, Widening, Draws };

// A function of x, and where its form changes.
struct Threshold {
    const char *call;
    double at;
    Of of = Of::Functions;
};

const std::vector<Threshold> &thresholds() {
    static const std::vector<Threshold> list{
        {"x + half_ierfc(x)", 3.4},
        {"x + half_ierfc(x)", 2.4},
        {"x + half_ierfc(x)", 27.0},
        {"exp2_negative(x)", -0.5},
        {"exp2_negative(x)", -7.5},
        {"exp2_lifted(x)", -0.5},
        {"exp_negative(x)", -0.34657359},
        {"angle_modulo_pi(x, (realW)1.0f)", 1.0},
        {"angle_modulo_pi((realW)1.0f, x)", 1.0},
        {"slope_quantile((float)x)", 1.6869e-3},
        {"slope_at(4, 9, 1, (float)x).t + 1.0f", 0.5},
        {"beckmann_sigma((realW)1e-19f, x)", 0x1p-126},
        {"beckmann_sigma((realW)1.0f, x)", 0x1p-126},
        {"beckmann_sigma((realW)0.34f, x)", 0.01},
        {"beckmann_sigma((realW)0.24f, x)", 0.01},
        {"g2_over_po(x, (realW)1.0f, (realW)1e-3f, (realW)0.1f) * 1e34f", 1e-34},
        {"facet_slope(x, (realW)1e-9f)", 1.0},
        {"facet_slope((realW)1.0f, x)", 0x1p-126},
        {"slope_of_both(x, (realW)1e-9f)", 1.0},
        {"slope_of_both((realW)1.0f, x)", 0x1p-126},
        {"mixture_slope2(one_lobe, 1, (float)x)", 0.5},
        {"facet_slope2(x, (realW)0.0f, (realW)1e-9f)", 1.41421356},
        {"facet_slope2((realW)1e-36f, (realW)0.0f, x)", 0x1p-126},
        {"beside(facet_off_lobe(x), facet_off_lobe((realW)2e-4f))", 1e-5, Of::Widening},
        {"beside(facet_off_lobe(x), facet_off_lobe((realW)2e-4f))", 1e-4, Of::Widening},
        {"beside(facet_off_surface(x), facet_off_surface((realW)2e-4f))", 1e-5, Of::Widening},
        {"beside(facet_off_surface(x), facet_off_surface((realW)2e-4f))", 1e-4, Of::Widening},
        {"facet_at_horizon(x)", 1e-12, Of::Widening},
        {"beside(facet_at_horizon((x - 1.0f) * 1e-6f), facet_at_horizon((realW)1.0f))", 1.0, Of::Widening},
        {"visible_slope((realW)0.0f, x)", 0x1p-25, Of::Draws},
        {"visible_slope((realW)0.5f, x)", 0.01, Of::Draws},
        {"visible_slope((realW)9.0f, x)", 0.01, Of::Draws},
        {"visible_slope((realW)0.5f, x) + 1.0f", 0.6822, Of::Draws}, // slope 0
        {"visible_slope(x, (realW)0.3f)", 0x1p24, Of::Draws},
        {"visible_slope(x, (realW)0.3f)", 0x1p60, Of::Draws},
        {"gaussian_slope(x)", 0x1p-25, Of::Draws},
        {"gaussian_slope(x) + 1.0f", 0.5, Of::Draws},
    };
    return list;
}

const char *functions = R"(
__constant float2 one_lobe[] = {(float2)(1.0f, 0.5f)};

inline realW slope_of_both(realW m_x, realW m_z) {
    realW x, y;
    facet_slopes(m_x, m_x, m_z, &x, &y);
    return x;
}
)";

// The quadrature's integrand (widen.clh) at a facet so steep that lobe or surface end, of the widest there are, and at
// one that wi just sees, for the lobe of the least masking.
const char *facets = R"(
__constant QuadratureLobe widest = {.alpha2 = 1e8f, .inv_alpha2 = 1e-8f};
__constant QuadratureLobe sharpest = {.alpha2 = 1e-8f, .inv_alpha2 = 1e8f};

inline Chart plain_chart(void) {
    Chart c = {.i = {(realW)0.5f, (realW)0.0f, (realW)0.0f}};
    c.o = c.i;
    return c;
}

// h is wh's share of the facet.
inline realW facet_off_lobe(realW h) {
    Chart c = plain_chart();
    c.i.at_m = c.o.at_m = 0.5f * h;
    c.h1 = (realW)1.0f; // and 1 + h1 u1 is h
    return integrand(&widest, 0, 0, &c, h - 1.0f, (realW)0.0f, (realW)0.0f);
}

// z = 1 - 1 + z is the normal's share of it. X's alphas are 1e4.
inline realW facet_off_surface(realW z) {
    Chart c = plain_chart();
    c.z.t1 = c.z.t2 = (realW)1.0f;
    c.g11 = (realW)1e-4f;
    return integrand(&widest, 0, 0, &c, (realW)-1.0f, z, (realW)0.0f);
}

inline realW facet_at_horizon(realW cos_i) {
    Chart c = plain_chart();
    c.i.at_m = cos_i;
    return integrand(&sharpest, 0, 0, &c, (realW)0.0f, (realW)0.0f, (realW)0.0f);
}

// Of numbers that may be 0, their quotient with another.
inline realW beside(realW value, realW scale) { return 1.0f + value / scale; }
)";

std::string source_of(Of of) {
    if (of == Of::Draws) return smx::kernel_source("visible_normals.clh");
    const std::string all = smx::kernel_source("beckmann.clh") + smx::kernel_source("masking.clh") +
                            smx::kernel_source("quantile.clh") + functions;
    return of == Of::Widening ? all + smx::kernel_source("widen.clh") + facets : all;
}

// The function at 401 places about its threshold, within 1e-4 of it.
template <typename Real>
std::vector<double> sweep_as(const Threshold &t, smx::Grade grade) {
    const std::string source = source_of(t.of) + R"(
__kernel void apply(__global real *out, __global const real *a) {
    size_t at = get_global_id(0);
    realW x = a[at];
    out[at] = )" + t.call + ";\n}";
    std::vector<Real> x;
    for (int k = -200; k <= 200; ++k) x.push_back(static_cast<Real>(t.at * (1.0 + k * 5e-7)));
    cl::Program program(context().cl(), source);
    program.build(
        smx::build_options({{"W", 1}, {"GRADE", static_cast<int>(grade)}, {"WIDENING", 2}, {"PER_LOBE", 1}}).c_str());
    cl::Kernel kernel(program, "apply");
    const cl::Buffer out = smx::empty_buffer<Real>(context(), x.size()), in = smx::buffer_from(context(), x);
    kernel.setArg(0, out);
    kernel.setArg(1, in);
    context().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(x.size()));
    context().queue().enqueueReadBuffer(out, CL_TRUE, 0, x.size() * sizeof(Real), x.data());
    return {x.begin(), x.end()};
}

std::vector<double> sweep(const Threshold &t, smx::Grade grade) {
    return smx::with_real(grade, [&](auto real) { return sweep_as<decltype(real)>(t, grade); });
}

// The largest step over the value, where a smooth function's steps are 5e-7 of its condition.
double jump(const std::vector<double> &values) {
    double largest = 0.0;
    for (std::size_t k = 1; k < values.size(); ++k) {
        const double step = std::abs(values[k] - values[k - 1]) / std::abs(values[k]);
        largest = std::isfinite(step) ? std::max(largest, step) : HUGE_VAL;
    }
    return largest;
}

HardPair pair_of(const oracle::Vec &wi, const oracle::Vec &wo) {
    return {{static_cast<float>(wi.x), static_cast<float>(wi.y), static_cast<float>(wi.z)},
            {static_cast<float>(wo.x), static_cast<float>(wo.y), static_cast<float>(wo.z)}};
}

const std::vector<HardPair> &plain_pairs() {
    static const std::vector<HardPair> pairs = [] {
        test::Random random(5);
        std::vector<HardPair> list;
        for (int k = 0; k < 500; ++k) list.push_back(pair_of(random.direction(0.05), random.direction(0.05)));
        list.push_back(pair_of({1.0, 0.0, 1e-7}, {-1.0, 0.0, 1e-7}));
        list.push_back(pair_of({0.0, 0.0, 1.0}, {0.0, 0.0, 1.0}));
        return list;
    }();
    return pairs;
}

// The largest difference of two cases, relative, but for values below a float's range.
double difference(HardProbe &probe, const HardCase &a, const HardCase &b) {
    const Values x = probe.run(a, plain_pairs()), y = probe.run(b, plain_pairs());
    double largest = 0.0;
    for (std::size_t q = 0; q < test::quantities; ++q)
        for (std::size_t k = 0; k < x[q].size(); ++k) {
            if (std::abs(y[q][k]) < 0x1p-100 && std::abs(x[q][k]) < 0x1p-100) continue;
            const double error = std::abs(x[q][k] / y[q][k] - 1.0);
            largest = std::isfinite(error) ? std::max(largest, error) : HUGE_VAL;
        }
    return largest;
}

const std::vector<oracle::Lobe> soft{{0.5, 0.3}, {0.5, 1.0}};

class Thresholds : public ::testing::TestWithParam<smx::Grade> {
  protected:
    void SetUp() override {
        if (!has(GetParam())) GTEST_SKIP() << "the device has no doubles";
    }
    double bound() const { return largest_jump[static_cast<int>(GetParam())]; }
};

INSTANTIATE_TEST_SUITE_P(Grades, Thresholds,
                         ::testing::Values(smx::Grade::Precise, smx::Grade::Fast, smx::Grade::Double),
                         [](const auto &grade) { return smx::grade_name(grade.param); });

} // namespace

TEST_P(Thresholds, FunctionsDoNotJump) {
    for (const Threshold &t : thresholds()) EXPECT_LE(jump(sweep(t, GetParam())), bound()) << t.call << " at " << t.at;
}

// The sweep sees steps that are too large: a clamp in the wrong place, a term that is left out.
TEST_P(Thresholds, SweepSeesJumps) {
    for (const char *call :
         {"x < (realW)3.4f ? x + half_ierfc(x) : 1.001f * x", "x + (x < (realW)3.4f ? 0.0f : 0.01f)"})
        EXPECT_GT(jump(sweep({call, 3.4}, GetParam())), bound()) << call;
}

TEST_P(Thresholds, NoAlphaIsTheLimitOfSmallOnes) {
    HardProbe probe(context(), GetParam());
    for (const auto &[none, little] :
         std::vector<std::pair<test::HardSurface, test::HardSurface>>{{{0.0, 0.0, 0.0}, {1e-7, 1e-7, 0.0}},
                                                                      {{0.0, 0.0, 0.0}, {1e-9, 1e-12, 0.9}},
                                                                      {{0.0, 0.5, 0.0}, {1e-7, 0.5, 0.0}},
                                                                      {{0.0, 0.5, 0.0}, {1e-7, 0.5, 1.0 - 1e-6}},
                                                                      {{0.5, 0.0, 0.0}, {0.5, 1e-7, -0.5}},
                                                                      {{0.5, 0.0, 0.0}, {0.5, 1e-30, 0.0}}})
        EXPECT_LE(difference(probe, {none, soft}, {little, soft}), bound()) << little.alpha_x << ", " << little.alpha_y;
    EXPECT_GT(difference(probe, {{}, soft}, {{0.05, 0.05}, soft}), bound()) << "nothing is compared";
}

// Where the principal axes are told by another difference, and where none is needed.
TEST_P(Thresholds, PrincipalAxesDoNotJump) {
    HardProbe probe(context(), GetParam());
    const double little = 1e-9;
    for (const double rho : {0.5, -0.9, 1e-3})
        EXPECT_LE(difference(probe, {{0.5 - little, 0.5, rho}, soft}, {{0.5 + little, 0.5, rho}, soft}), bound())
            << rho;
    for (const auto &[x, y] : {std::pair{0.5, 0.5}, std::pair{0.5, 0.2}, std::pair{0.2, 0.5}})
        EXPECT_LE(difference(probe, {{x, y, 0.0}, soft}, {{x, y, little}, soft}), bound()) << x << ", " << y;
}

TEST_P(Thresholds, LargeAlphasStayFinite) {
    HardProbe probe(context(), GetParam());
    for (const double alpha : {1e3, 1e4})
        for (const auto &quantity : probe.run({{alpha, alpha, 0.0}, {{1.0, alpha}}}, plain_pairs()))
            for (const double v : quantity) EXPECT_TRUE(std::isfinite(v) && v >= 0.0) << v << " at alpha " << alpha;
}
