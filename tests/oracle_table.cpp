#include "oracle_table.h"

#include <algorithm>

namespace oracle {
namespace {

// The two nodes around a coordinate counted in cells, and the share of the second.
struct Bracket {
    int low, high;
    double share;
};

Bracket clamped_bracket(double at, int nodes) {
    const double inside = std::clamp(at, 0.0, nodes - 1.0);
    const int low = std::min(static_cast<int>(inside), nodes - 2);
    return {low, low + 1, inside - low};
}

Bracket periodic_bracket(double at, int nodes) {
    const double wrapped = at - nodes * std::floor(at / nodes);
    const int low = std::min(static_cast<int>(wrapped), nodes - 1);
    return {low, (low + 1) % nodes, wrapped - low};
}

// Position of an angle in cells of one degree; theta_h in the square-root warp.
double theta_h_cells(double theta_h) { return table_theta_h * std::sqrt(std::max(theta_h, 0.0) / (pi / 2.0)); }
double degrees(double angle) { return angle * 180.0 / pi; }

Rgb linear(const Table &table, const HalfDiff &at) {
    const Bracket h = clamped_bracket(theta_h_cells(at.theta_h), table_theta_h);
    const Bracket d = clamped_bracket(degrees(at.theta_d), table_theta_d);
    const Bracket p = periodic_bracket(degrees(at.phi_d), table.phi_d);
    Rgb sum{};
    for (int corner = 0; corner < 8; ++corner) {
        const bool hh = (corner & 4) != 0, hd = (corner & 2) != 0, hp = (corner & 1) != 0;
        const double weight =
            (hh ? h.share : 1.0 - h.share) * (hd ? d.share : 1.0 - d.share) * (hp ? p.share : 1.0 - p.share);
        for (int c = 0; c < 3; ++c)
            sum[static_cast<std::size_t>(c)] +=
                weight * table.at(c, hh ? h.high : h.low, hd ? d.high : d.low, hp ? p.high : p.low);
    }
    return sum;
}

Rgb nearest(const Table &table, const HalfDiff &at) {
    const int th = std::clamp(static_cast<int>(theta_h_cells(at.theta_h)), 0, table_theta_h - 1);
    const int td = std::clamp(static_cast<int>(degrees(at.theta_d)), 0, table_theta_d - 1);
    // Half a turn is no change by reciprocity, so the original folds negative azimuths up by pi.
    const double phi = at.phi_d < 0.0 ? at.phi_d + pi : at.phi_d;
    const int pd = std::clamp(static_cast<int>(degrees(phi)), 0, 179);
    return {table.at(0, th, td, pd), table.at(1, th, td, pd), table.at(2, th, td, pd)};
}

} // namespace

HalfDiff half_diff(const Vec &wi, const Vec &wo, const Vec &wm) {
    const Vec h = half_vector(wi, wo);
    const Vec side = cross(wm, h); // sin(theta_h) times the y axis of the frame of h
    const double cos_h = dot(wm, h);
    HalfDiff a;
    a.theta_h = std::atan2(length(side), cos_h);
    a.theta_d = angle(wi, h);
    a.phi_d = std::atan2(dot(wi, side), dot(wi, cos_h * h - wm));
    return a;
}

Pair directions(double theta_h, double theta_d, double phi_d) {
    const Vec d = spherical(theta_d, phi_d);
    const double c = std::cos(theta_h), s = std::sin(theta_h);
    const Vec wi{c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    return {wi, reflect(wi, {s, 0.0, c})};
}

Pair node_directions(int th, int td, int pd) {
    const double u = static_cast<double>(th) / table_theta_h;
    return directions(u * u * pi / 2.0, td * pi / 180.0, pd * pi / 180.0);
}

bool above_horizon(int th, int td, int pd) {
    const Pair p = node_directions(th, td, pd);
    return p.wi.z > 0.0 && p.wo.z > 0.0;
}

Table make_table(int phi_d, const std::function<Rgb(const Vec &, const Vec &)> &f) {
    Table t;
    t.phi_d = phi_d;
    t.values.assign(3 * t.cells(), -1.0);
    for (int th = 0; th < table_theta_h; ++th)
        for (int td = 0; td < table_theta_d; ++td)
            for (int pd = 0; pd < phi_d; ++pd) {
                const Pair p = node_directions(th, td, pd);
                if (p.wi.z <= 0.0 || p.wo.z <= 0.0) continue;
                const Rgb value = f(p.wi, p.wo);
                for (std::size_t c = 0; c < 3; ++c) t.values[c * t.cells() + t.index(th, td, pd)] = value[c];
            }
    return t;
}

Rgb lookup(const Table &table, Lookup how, const HalfDiff &at) {
    return how == Lookup::linear ? linear(table, at) : nearest(table, at);
}

} // namespace oracle
