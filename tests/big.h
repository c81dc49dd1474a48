// Numbers of 60 decimal digits, over GNU MPFR: what oracles of elementary functions are written in.
#pragma once

#include <mpfr.h>

#include "oracle_formulas.h"

namespace test {

class Big {
  public:
    Big(double value = 0.0) {
        mpfr_init2(value_, bits);
        mpfr_set_d(value_, value, MPFR_RNDN);
    }
    Big(const Big &other) : Big() { mpfr_set(value_, other.value_, MPFR_RNDN); }
    Big &operator=(const Big &other) {
        mpfr_set(value_, other.value_, MPFR_RNDN);
        return *this;
    }
    ~Big() { mpfr_clear(value_); }

    explicit operator double() const { return mpfr_get_d(value_, MPFR_RNDN); }

    friend Big operator+(const Big &a, const Big &b) { return binary(mpfr_add, a, b); }
    friend Big operator-(const Big &a, const Big &b) { return binary(mpfr_sub, a, b); }
    friend Big operator*(const Big &a, const Big &b) { return binary(mpfr_mul, a, b); }
    friend Big operator/(const Big &a, const Big &b) { return binary(mpfr_div, a, b); }
    friend bool operator<(const Big &a, const Big &b) { return mpfr_less_p(a.value_, b.value_) != 0; }

    friend Big abs(const Big &a) { return unary(mpfr_abs, a); }
    friend Big sqrt(const Big &a) { return unary(mpfr_sqrt, a); }
    friend Big exp(const Big &a) { return unary(mpfr_exp, a); }
    friend Big exp2(const Big &a) { return unary(mpfr_exp2, a); }
    friend Big erfc(const Big &a) { return unary(mpfr_erfc, a); }
    friend Big asin(const Big &a) { return unary(mpfr_asin, a); }
    friend Big atan2(const Big &y, const Big &x) { return binary(mpfr_atan2, y, x); }
    static Big pi() {
        Big out;
        mpfr_const_pi(out.value_, MPFR_RNDN);
        return out;
    }

  private:
    static constexpr mpfr_prec_t bits = 200;

    template <typename Function>
    static Big unary(Function function, const Big &a) {
        Big out;
        function(out.value_, a.value_, MPFR_RNDN);
        return out;
    }
    template <typename Function>
    static Big binary(Function function, const Big &a, const Big &b) {
        Big out;
        function(out.value_, a.value_, b.value_, MPFR_RNDN);
        return out;
    }

    mpfr_t value_;
};

} // namespace test

template <>
inline test::Big oracle::pi_of() {
    return test::Big::pi();
}
