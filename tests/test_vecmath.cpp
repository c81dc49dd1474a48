// cl/vecmath.clh on the device, against 60 digits: the error that stands beside each function there, in each grade, is
// the largest over its domain, ends included, and the same at every number of lanes.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>

#include "big.h"
#include "context.h"
#include "device_buffer.h"
#include "grade.h"
#include "random.h"

using smx::Grade;
using test::Big;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Input {
    double x, y = 0.0;
};

// A function of the header, its true value, and what its error is measured in: error(got, inputs).
struct Function {
    const char *call; // of the lanes x and y
    std::vector<Input> inputs;
    std::function<double(double got, const Input &)> error;
    std::array<double, 3> largest; // precise, fast, double: as stated in the header
    bool ours = true;              // from a polynomial, not from the device
    bool may_be_better = false;    // with a reciprocal that a device has no estimate for
};

double relative(double got, const Big &wanted) { return static_cast<double>(abs(Big(got) / wanted - 1.0)); }

// Half of the points even over the interval, half even over its logarithm down to `least`, both with jitter; the ends.
std::vector<Input> negatives(double lowest, double least = 1e-30) {
    test::Random random(11);
    std::vector<Input> list{{lowest}, {-0.0}, {0.0}};
    for (int k = 0; k < 10000; ++k) {
        list.push_back({lowest * (k + random.uniform()) / 10000});
        list.push_back({-random.log_uniform(least, -lowest)});
    }
    return list;
}

std::vector<Input> positives(double highest, double least = 1e-30) {
    std::vector<Input> list = negatives(-highest, least);
    for (Input &input : list) input.x = std::abs(input.x);
    return list;
}

// Where 60 digits are slow.
std::vector<Input> every_eighth(const std::vector<Input> &list) {
    std::vector<Input> some;
    for (std::size_t k = 0; k < list.size(); k += 8) some.push_back(list[k]);
    return some;
}

std::vector<Input> log_positives(double least, double most) {
    test::Random random(12);
    std::vector<Input> list{{least}, {most}};
    for (int k = 0; k < 20000; ++k) list.push_back({random.log_uniform(least, most)});
    return list;
}

std::vector<Input> of_both_signs(std::vector<Input> list) {
    for (std::size_t k = 0; k < list.size(); k += 3) list[k].x = -list[k].x;
    return list;
}

std::vector<Input> vectors() {
    test::Random random(13);
    std::vector<Input> list{{1.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}, {1.0, 1.0}, {-1.0, 0.0}, {1e-20, 1e-20}};
    for (int k = 0; k < 10000; ++k) {
        const double angle = random.uniform(0.0, 2.0 * oracle::pi), length = random.log_uniform(1e-10, 1e10);
        list.push_back({length * std::cos(angle), length * std::sin(angle)});
        list.push_back({random.log_uniform(1e-15, 1e15) * (k % 2 ? 1.0 : -1.0),
                        random.log_uniform(1e-15, 1e15) * (k % 4 < 2 ? 1.0 : -1.0)});
    }
    return list;
}

Big true_half_ierfc(const Big &v) { return (exp(Big(0.0) - v * v) / sqrt(Big::pi()) - v * erfc(v)) / 2.0; }

double half_ierfc_error(double got, const Input &at) {
    if (std::isinf(at.x)) return got < 1e-3 ? 0.0 : infinity;
    const Big wanted = true_half_ierfc(at.x);
    return static_cast<double>(abs(Big(got) - wanted) / (Big(at.x) + wanted));
}

// Over 1 + v^2.
double relative_ierfc_error(double got, const Input &at) {
    return relative(got, true_half_ierfc(at.x)) / (1.0 + at.x * at.x);
}

// sqrt(4 asin(chord / 2) / pi); 0 of 0.
double sqrt_angle_error(double got, const Input &at) {
    if (at.x == 0.0) return std::abs(got);
    return relative(got, sqrt(asin(sqrt(at.x) / 2.0) * 4.0 / Big::pi()));
}

double angle_error(double got, const Input &at) {
    Big wanted = atan2(at.y, at.x) / Big::pi();
    if (wanted < 0.0) wanted = wanted + 1.0;
    // -1 is 1, and is 0 modulo pi, as the direction of the x axis has it.
    return std::min(static_cast<double>(abs(Big(got) - wanted)),
                    at.y == 0.0 ? std::min(std::abs(got), std::abs(got - 1.0)) : infinity);
}

const std::vector<Function> &functions() {
    static const std::vector<Function> list = [] {
        std::vector<Input> ierfc = positives(6.0);
        for (double v : {3.4, 2.4, 27.0, 100.0, 1e10, 1e30, infinity}) ierfc.push_back({v});
        return std::vector<Function>{
            {"inv_sqrt(x)",
             log_positives(2e-38, 3e38),
             [](double got, const Input &at) { return relative(got, Big(1.0) / sqrt(at.x)); },
             {2.4e-7, 7e-5, 4e-16},
             false},
            {"reciprocal(x)",
             of_both_signs(log_positives(2e-38, 8e37)),
             [](double got, const Input &at) { return relative(got, Big(1.0) / at.x); },
             {2e-7, 7e-5, 2e-16},
             false},
            {"exp2_negative(x)",
             negatives(-126.0),
             [](double got, const Input &at) { return relative(got, exp2(at.x)); },
             {1e-7, 8e-5, 4e-16}},
            {"exp_negative(x)",
             negatives(-87.33),
             [](double got, const Input &at) { return relative(got, exp(at.x)); },
             {1e-7, 8e-5, 4e-16}},
            {"exp2_lifted(x)",
             negatives(-206.0),
             [](double got, const Input &at) { return relative(got, exp2(Big(at.x) + 80.0)); },
             {1e-7, 8e-5, 4e-16}},
            {"half_ierfc(x)", ierfc, half_ierfc_error, {2.2e-7, 7e-5, 4e-16}},
            {"half_ierfc_relative(x)",
             every_eighth(positives(9.0)),
             relative_ierfc_error,
             {6.5e-7, 2.4e-4, 8e-16},
             true,
             true},
            {"sqrt_angle_from_chord2(x)", positives(2.0), sqrt_angle_error, {2.2e-7, 2.2e-5, 4e-16}},
            {"angle_modulo_pi(y, x)", vectors(), angle_error, {9e-8, 7.6e-6, 4e-16}},
        };
    }();
    return list;
}

// The function on all inputs as the device computes it, in `Real`s; what it was given is written back into `inputs`.
template <typename Real>
std::vector<double> on_device(smx::Context &context, const char *call, Grade grade, std::vector<Input> &inputs) {
    const std::string source = smx::kernel_source("vecmath.clh") + R"(
__kernel void apply(__global real *out, __global const real *a, __global const real *b) {
    size_t at = W * get_global_id(0);
    realW x = vloadW(0, a + at), y = vloadW(0, b + at);
    vstoreW()" + std::string(call) +
                               R"(, 0, out + at);
})";
    const std::size_t size = smx::round_up(inputs.size(), context.width());
    std::vector<Real> x(size, Real(-1)), y(size, Real(1)), out(size);
    for (std::size_t k = 0; k < inputs.size(); ++k) {
        inputs[k].x = x[k] = static_cast<Real>(inputs[k].x);
        inputs[k].y = y[k] = static_cast<Real>(inputs[k].y);
    }
    cl::Program program(context.cl(), source);
    program.build(
        smx::build_options({{"W", static_cast<int>(context.width())}, {"GRADE", static_cast<int>(grade)}}).c_str());
    cl::Kernel kernel(program, "apply");
    const cl::Buffer buffer = smx::empty_buffer<Real>(context, size);
    const cl::Buffer x_buffer = smx::buffer_from(context, x), y_buffer = smx::buffer_from(context, y);
    kernel.setArg(0, buffer);
    kernel.setArg(1, x_buffer);
    kernel.setArg(2, y_buffer);
    context.queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(size / context.width()));
    context.queue().enqueueReadBuffer(buffer, CL_TRUE, 0, size * sizeof(Real), out.data());
    return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(inputs.size())};
}

std::vector<double> evaluate(std::uint32_t width, const char *call, Grade grade, std::vector<Input> &inputs) {
    smx::Context context("", width);
    return smx::with_real(grade, [&](auto real) { return on_device<decltype(real)>(context, call, grade, inputs); });
}

// How far lanes may differ, relative: ours not at all; a device's own functions, of scalars and of vectors, may be two.
double slack(const Function &function, Grade grade) {
    return function.ours ? 0.0 : 2.0 * function.largest[static_cast<std::size_t>(grade)];
}

bool has_double() { return smx::Context("", 0).info().has_double; }

void expect_stated_errors(Grade grade) {
    for (const Function &function : functions()) {
        std::vector<Input> inputs = function.inputs;
        const std::vector<double> got = evaluate(0, function.call, grade, inputs);
        double largest = 0.0;
        Input where{};
        for (std::size_t k = 0; k < inputs.size(); ++k) {
            const double error = function.error(got[k], inputs[k]);
            if (error > largest || std::isnan(error)) largest = error, where = inputs[k];
            if (std::isnan(error)) break;
        }
        const double stated = function.largest[static_cast<std::size_t>(grade)];
        EXPECT_TRUE(largest <= stated) << function.call << " at x = " << where.x << ", y = " << where.y << ": error "
                                       << largest << ", stated " << stated;
        // What is stated of our polynomials is near the truth; a device's own functions may be better than they must.
        if (grade != Grade::Double && function.ours && !function.may_be_better) {
            EXPECT_GT(largest, stated / 2.0) << function.call;
        }
    }
}

} // namespace

TEST(Vecmath, PreciseErrorsAreAsStated) { expect_stated_errors(Grade::Precise); }

TEST(Vecmath, FastErrorsAreAsStated) { expect_stated_errors(Grade::Fast); }

TEST(Vecmath, DoubleErrorsAreAsStated) {
    if (!has_double()) GTEST_SKIP() << "the device has no doubles";
    expect_stated_errors(Grade::Double);
}

TEST(Vecmath, LanesDoNotMatter) {
    for (const Grade grade : {Grade::Precise, Grade::Fast})
        for (const Function &function : functions()) {
            std::vector<Input> inputs = function.inputs;
            const std::vector<double> one = evaluate(1, function.call, grade, inputs);
            for (const std::uint32_t width : {4u, 8u, 16u}) {
                const std::vector<double> wide = evaluate(width, function.call, grade, inputs);
                for (std::size_t k = 0; k < one.size(); ++k)
                    ASSERT_LE(std::abs(wide[k] - one[k]), slack(function, grade) * std::abs(one[k]))
                        << function.call << " at x = " << inputs[k].x << ", y = " << inputs[k].y << ", " << width
                        << " lanes, grade " << smx::grade_name(grade);
            }
        }
}

// Far below, exponentials are 0: a density of 0 may be multiplied by anything finite.
TEST(Vecmath, ExponentialsVanish) {
    for (const Grade grade : {Grade::Precise, Grade::Fast})
        for (const char *call : {"exp2_negative(x)", "exp_negative(x)"}) {
            std::vector<Input> inputs{{-127.0}, {-1000.0}, {-1e30}, {-infinity}};
            for (const double value : evaluate(0, call, grade, inputs)) EXPECT_EQ(value, 0.0) << call;
        }
}
