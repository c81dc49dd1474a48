// Numbers that carry their derivatives by several variables. A variable x begins with the derivative x: what is then
// carried is x df/dx, and the sum of the absolute values over |f| is the condition number of f.
#pragma once

#include <array>
#include <cmath>

#include "oracle_formulas.h"

namespace test {

template <std::size_t N>
struct Dual {
    double value = 0.0;
    std::array<double, N> by{};

    explicit Dual(double v = 0.0) : value(v) {}

    // The variable number `index`, or a share of it.
    static Dual variable(double v, std::size_t index) {
        Dual d(v);
        d.by[index] = v;
        return d;
    }
    double condition() const {
        double sum = 0.0;
        for (double d : by) sum += std::abs(d);
        return sum / std::abs(value);
    }

    // f(a), of the derivative `slope` there.
    friend Dual chain(const Dual &a, double f, double slope) {
        Dual out(f);
        for (std::size_t j = 0; j < N; ++j) out.by[j] = slope * a.by[j];
        return out;
    }
    friend Dual chain(const Dual &a, const Dual &b, double f, double by_a, double by_b) {
        Dual out(f);
        for (std::size_t j = 0; j < N; ++j) out.by[j] = by_a * a.by[j] + by_b * b.by[j];
        return out;
    }
    friend Dual operator+(const Dual &a, const Dual &b) { return chain(a, b, a.value + b.value, 1.0, 1.0); }
    friend Dual operator-(const Dual &a, const Dual &b) { return chain(a, b, a.value - b.value, 1.0, -1.0); }
    friend Dual operator*(const Dual &a, const Dual &b) { return chain(a, b, a.value * b.value, b.value, a.value); }
    friend Dual operator/(const Dual &a, const Dual &b) {
        const double q = a.value / b.value;
        return chain(a, b, q, 1.0 / b.value, -q / b.value);
    }
    friend bool operator<(const Dual &a, const Dual &b) { return a.value < b.value; }

    friend Dual exp(const Dual &a) { return chain(a, std::exp(a.value), std::exp(a.value)); }
    friend Dual sqrt(const Dual &a) {
        const double root = std::sqrt(a.value);
        return chain(a, root, root > 0.0 ? 0.5 / root : 0.0);
    }
    friend Dual erfc(const Dual &a) {
        return chain(a, std::erfc(a.value), -2.0 / std::sqrt(oracle::pi_of<double>()) * std::exp(-a.value * a.value));
    }
    friend Dual atan2(const Dual &y, const Dual &x) {
        const double r2 = x.value * x.value + y.value * y.value;
        return chain(y, x, std::atan2(y.value, x.value), x.value / r2, -y.value / r2);
    }
};

// A number as a double, without what it carries.
template <class T>
double value_of(const T &number) {
    return static_cast<double>(number);
}
template <std::size_t N>
double value_of(const Dual<N> &number) {
    return number.value;
}

} // namespace test
