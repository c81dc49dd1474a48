// A plain ray caster for the tile of the geometric reference, in double: walks from cell to cell, and in each tries
// both triangles. No hierarchy, no positions but absolute ones; what the kernels do otherwise is checked against it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "height_field.h"
#include "vec3.h"

namespace oracle {

struct TileHit {
    long cell_x = 0, cell_y = 0; // not taken modulo the tile
    int upper = 0;
    Vec p; // absolute
    double gradient_x = 0.0, gradient_y = 0.0;
};

class TileRays {
  public:
    explicit TileRays(const smx::HeightField &field) : field_(field) {}

    // The first triangle from `p` along `d`, but for `from`. Walks at most `cells` cells.
    std::optional<TileHit> cast(const Vec &p, const Vec &d, const TileHit *from = nullptr, long cells = 100000) const {
        long x = static_cast<long>(std::floor(p.x)), y = static_cast<long>(std::floor(p.y));
        if (from) x = from->cell_x, y = from->cell_y;
        double t = 0.0;
        for (long k = 0; k < cells; ++k) {
            const double tx = exit(p.x, d.x, x), ty = exit(p.y, d.y, y), out = std::min(tx, ty);
            std::optional<TileHit> nearest;
            double t_nearest = std::numeric_limits<double>::infinity();
            for (int upper : {0, 1}) {
                if (from && from->cell_x == x && from->cell_y == y && from->upper == upper) continue;
                TileHit hit;
                const auto met = triangle(p, d, x, y, upper, hit);
                if (met && *met >= t - 1e-9 && *met < t_nearest) t_nearest = *met, nearest = hit;
            }
            if (nearest) return nearest;
            t = out;
            if (d.z > 0.0 && p.z + t * d.z > field_.top) return {};
            if (tx < ty)
                x += d.x > 0.0 ? 1 : -1;
            else
                y += d.y > 0.0 ? 1 : -1;
        }
        return {};
    }

  private:
    static double exit(double p, double d, long cell) {
        if (d == 0.0) return std::numeric_limits<double>::infinity();
        return (static_cast<double>(cell + (d > 0.0)) - p) / d;
    }

    double height(long x, long y) const {
        const long side = field_.side();
        const auto wrapped = [side](long k) { return static_cast<std::size_t>((k % side + side) % side); };
        return field_.heights[wrapped(y) * static_cast<std::size_t>(side) + wrapped(x)];
    }

    // Where the ray meets the triangle's plane within it.
    std::optional<double> triangle(const Vec &p, const Vec &d, long x, long y, int upper, TileHit &hit) const {
        const double corner = height(x + upper, y + upper);
        const double sign = upper ? -1.0 : 1.0;
        const double along_x = sign * (height(x + 1 - upper, y + upper) - corner),
                     along_y = sign * (height(x + upper, y + 1 - upper) - corner);
        const double base_x = static_cast<double>(x + upper), base_y = static_cast<double>(y + upper);
        const double rate = d.z - along_x * d.x - along_y * d.y;
        if (rate >= 0.0) return {}; // from behind, or along it
        const double above = p.z - corner - along_x * (p.x - base_x) - along_y * (p.y - base_y);
        const double t = -above / rate;
        const Vec at{p.x + t * d.x, p.y + t * d.y, p.z + t * d.z};
        const double u = sign * (at.x - base_x), v = sign * (at.y - base_y);
        if (u < 0.0 || v < 0.0 || u + v > 1.0) return {};
        hit = {x, y, upper, at, along_x, along_y};
        return t;
    }

    const smx::HeightField &field_;
};

} // namespace oracle
