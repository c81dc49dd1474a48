// MERL tables as the oracle reads and makes them (Matusik et al. 2003): [rgb][theta_h][theta_d][phi_d], 1/sr.
// Value k of an axis sits at theta_h = (k/90)^2 pi/2, theta_d = k pi/180, phi_d = k pi/180 (full-azimuth tables hold
// phi_d over 2 pi in as many steps of one degree). A negative value marks an invalid cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "vec3.h"

namespace oracle {

using Rgb = std::array<double, 3>;

inline constexpr int table_theta_h = 90;
inline constexpr int table_theta_d = 90;

enum class Lookup { linear, nearest };

struct Table {
    int phi_d = 180;
    std::vector<double> values; // [3][90][90][phi_d]

    std::size_t cells() const { return std::size_t{table_theta_h} * table_theta_d * static_cast<std::size_t>(phi_d); }
    std::size_t index(int th, int td, int pd) const {
        return static_cast<std::size_t>((th * table_theta_d + td) * phi_d + pd);
    }
    double at(int channel, int th, int td, int pd) const {
        return values[static_cast<std::size_t>(channel) * cells() + index(th, td, pd)];
    }
};

// Half and difference angles (Rusinkiewicz 1998) of a pair of directions about the normal m.
struct HalfDiff {
    double theta_h = 0.0, theta_d = 0.0, phi_d = 0.0; // phi_d in (-pi, pi]
};
HalfDiff half_diff(const Vec &wi, const Vec &wo, const Vec &wm);

// The pair of directions at given angles, about +z.
struct Pair {
    Vec wi, wo;
};
Pair directions(double theta_h, double theta_d, double phi_d);
Pair node_directions(int th, int td, int pd);

// True where both directions of a node are above the horizon.
bool above_horizon(int th, int td, int pd);

// A table of f at the nodes; -1 below the horizon.
Table make_table(int phi_d, const std::function<Rgb(const Vec &wi, const Vec &wo)> &f);

// The table's value in 1/sr. Linear in (sqrt theta_h, theta_d, phi_d), clamped past the last theta; or the cell that
// holds the angles, as the lookup code that came with MERL has it.
Rgb lookup(const Table &table, Lookup how, const HalfDiff &at);

} // namespace oracle
