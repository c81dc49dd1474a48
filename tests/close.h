// Comparing numbers: a relative tolerance with an absolute floor. NaN equals nothing, not even NaN; an infinity equals
// only itself. A failure shows both values, the error and what was allowed.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#define EXPECT_CLOSE(got, wanted, relative, floor) EXPECT_PRED_FORMAT4(test::close_to, got, wanted, relative, floor)

namespace test {

inline bool is_close(double got, double wanted, double relative, double floor) {
    if (got == wanted) return true;
    return std::isfinite(got) && std::isfinite(wanted) &&
           std::abs(got - wanted) <= relative * std::max(std::abs(got), std::abs(wanted)) + floor;
}

inline ::testing::AssertionResult close_to(const char *got_text, const char *wanted_text, const char *, const char *,
                                           double got, double wanted, double relative, double floor) {
    if (is_close(got, wanted, relative, floor)) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << got_text << " = " << got << "\n  " << wanted_text << " = " << wanted
                                         << "\n  error " << got - wanted << " (relative " << got / wanted - 1.0
                                         << "), allowed " << relative << " relative + " << floor;
}

} // namespace test
