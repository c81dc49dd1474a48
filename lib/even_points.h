// Points that cover the unit square evenly, however many of them are taken.
#pragma once

#include <cmath>

namespace smx {

struct Point2 {
    double x, y;
};

// Number `n` of the additive recurrence of the plastic number (Roberts 2018, R2).
inline Point2 even_point(int n) {
    return {std::fmod(0.5 + n * 0.7548776662466927, 1.0), std::fmod(0.5 + n * 0.5698402909980532, 1.0)};
}

} // namespace smx
