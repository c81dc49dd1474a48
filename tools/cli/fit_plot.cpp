// The layout, in gnuplot's screen units: slope density and legend of the lobes above, then a row of three Fresnel
// charts and a row of three slices, one for each channel. A density alone has the first row.
#include "fit_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "fit_slice.h"
#include "input.h"
#include "plot.h"
#include "text.h"

namespace slopemix::cli {

namespace {

constexpr int width = 1200, height = 1180, density_height = 500;
constexpr std::array<const char *, 3> channels = {"red", "green", "blue"};
constexpr const char *measured_colour = "#333333", *sum_colour = "#d55e00", *shared_colour = "#e69f00",
                     *per_lobe_colour = "#0072b2";

struct Curves {
    std::size_t sets = 0, knots = 0;
    std::vector<double> theta_d, fresnel; // [sets][3][knots]

    double at(std::size_t set, std::size_t channel, std::size_t knot) const {
        return fresnel[(3 * set + channel) * knots + knot];
    }
};

Curves curves_of(const Material &material) {
    const smx_material_info info = info_of(material);
    Curves curves{info.fresnel_sets, info.fresnel_knots, {}, {}};
    curves.theta_d.resize(curves.knots);
    curves.fresnel.resize(3 * curves.sets * curves.knots);
    check(
        smx_material_get_fresnel(material.get(), curves.theta_d.data(), curves.fresnel.data(), curves.fresnel.size()));
    return curves;
}

// The share of each lobe in the density that retro-reflection sees: its weight, or, per lobe, its curves at normal
// incidence.
std::vector<smx_lobe> lobes_of(const Material &material, const Curves &curves) {
    std::vector<smx_lobe> lobes = lobes_of(material);
    if (curves.sets == 1 && info_of(material).model == SMX_MODEL_SHARED) return lobes;
    double sum = 0.0;
    for (std::size_t k = 0; k < lobes.size(); ++k)
        sum += lobes[k].weight = curves.at(k, 0, 0) + curves.at(k, 1, 0) + curves.at(k, 2, 0);
    for (smx_lobe &lobe : lobes) lobe.weight = sum > 0.0 ? lobe.weight / sum : 0.0;
    return lobes;
}

struct Extent {
    double low = HUGE_VAL, high = 0.0;

    void see(double value) {
        if (!(value > 0.0) || !std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

// A logarithmic axis around the values, but not more than `decades` long.
std::string log_range(const char *axis, Extent extent, double decades) {
    if (extent.high <= 0.0) extent = {0.1, 1.0};
    const double high = std::ceil(std::log10(extent.high * 1.2));
    const double low = std::max(std::floor(std::log10(extent.low)), high - decades);
    return std::string("set ") + axis + "range [1e" + fixed(low, 0) + ":1e" + fixed(std::min(high, low + decades), 0) +
           "]\n";
}

std::string place(double left, double right, double bottom, double top) {
    const auto margin = [](const char *side, double at) {
        return std::string("set ") + side + "margin at screen " + fixed(at, 4) + '\n';
    };
    return margin("l", left) + margin("r", right) + margin("b", bottom) + margin("t", top);
}

std::string place_in_row(std::size_t column, double bottom, double top) {
    const double left = 0.07 + 0.315 * static_cast<double>(column);
    return place(left, left + 0.275, bottom, top);
}

std::string title(const std::string &text) { return "set title " + chart_text("{/:Bold " + text + '}') + '\n'; }

// p22 of a lobe over the slope x; gnuplot draws it.
std::string lobe_formula(const smx_lobe &lobe) {
    const std::string alpha = chart_number(lobe.alpha);
    return chart_number(lobe.weight / (std::numbers::pi * lobe.alpha * lobe.alpha)) + "*exp(-(x/" + alpha + ")**2)";
}

std::string heading(const Material &material, double at) {
    const smx_material_info info = info_of(material);
    const std::string text = std::string(info.name) + ", " + word_for(info.model, models) + ", " +
                             std::to_string(info.lobes) + (info.lobes == 1 ? " lobe" : " lobes");
    return "set label 1 " + chart_text(text) + " at screen 0.07, screen " + fixed(at, 4) +
           " noenhanced font ',20' textcolor '#111111'\n";
}

std::string density_chart(const Density &density, const std::vector<smx_lobe> &lobes,
                          const std::vector<std::string> &shades, double bottom, double top) {
    std::vector<double> slope(info_of(density).nodes), p22(slope.size());
    check(smx_density_get_nodes(density.get(), slope.data(), p22.data(), nullptr, slope.size()));
    std::vector<std::vector<double>> rows;
    Extent x, y;
    for (std::size_t k = 0; k < slope.size(); ++k) {
        if (!(slope[k] > 0.0)) continue;
        rows.push_back({slope[k], p22[k]});
        x.see(slope[k]);
        y.see(p22[k]);
    }

    const std::string sum_style = std::string("linewidth 2.2 linecolor '") + sum_colour + '\'';
    std::string sum, curves; // the sum is drawn last, on top, but stands first in the legend
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        sum += (k ? "+" : "") + lobe_formula(lobes[k]);
        curves += ", " + lobe_formula(lobes[k]) + " linewidth 1.4 linecolor '" + shades[k] + "' title '" +
                  general(lobes[k].alpha, 3) + '\'';
    }
    return chart_data("density", rows) + place(0.07, 0.70, bottom, top) + title("Slope density and its lobes") +
           "set logscale xy\nset format xy '10^{%T}'\nset xlabel 'slope, tan θ'\nset ylabel 'p_{22}, per unit "
           "slope²'\n" +
           log_range("x", x, 8.0) + log_range("y", y, 12.0) + "set samples 1000\nset key at screen 0.72, screen " +
           fixed(top + 0.01, 4) +
           " left top Left reverse maxrows 18\n"
           "plot $density using 1:2 with points pointtype 7 pointsize 0.35 linecolor '" +
           measured_colour + "' title 'density', keyentry with lines " + sum_style +
           " title 'all lobes', keyentry with lines linecolor '#ffffff' title 'α of each:'" + curves + ", " + sum +
           " with lines " + sum_style + '\n';
}

std::string fresnel_charts(const Curves &curves, const std::vector<std::string> &shades) {
    std::vector<std::vector<double>> rows;
    Extent y;
    for (std::size_t j = 0; j < curves.knots; ++j) {
        rows.push_back({curves.theta_d[j] * 180.0 / std::numbers::pi});
        for (std::size_t curve = 0; curve < 3 * curves.sets; ++curve) {
            rows.back().push_back(curves.fresnel[curve * curves.knots + j]);
            y.see(rows.back().back());
        }
    }
    std::string charts = chart_data("fresnel", rows) +
                         "unset key\nunset logscale x\nset format x '%g'\nset xrange [0:90]\nset xtics 15\nset xlabel "
                         "'θ_d, degrees'\n" +
                         log_range("y", y, 4.0);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        charts += place_in_row(c, 0.4, 0.605) + title(std::string("Fresnel curves, ") + channels[c]) +
                  (c == 0 ? "set ylabel 'F'\n" : "unset ylabel\n") + "plot ";
        for (std::size_t set = 0; set < curves.sets; ++set)
            charts += (set ? ", " : "") + std::string("$fresnel using 1:") + std::to_string(2 + 3 * set + c) +
                      " with lines linewidth 1.6 linecolor '" + shades[set] + '\'';
        charts += '\n';
    }
    return charts;
}

std::string slice_charts(const std::vector<std::vector<double>> &rows) {
    Extent measured;
    for (const std::vector<double> &row : rows)
        for (std::size_t c = 1; c <= 3; ++c) measured.see(row[c]);
    std::string charts = chart_data("slice", rows) +
                         "set xrange [-90:90]\nset xtics 30\nset xlabel 'θ_o, degrees, positive on the mirror side'\n" +
                         log_range("y", measured, 9.0) +
                         "set key default\nset key at screen 0.508, screen 0.328 center center horizontal textcolor "
                         "'#333333' samplen 1.6 maxrows 1 Left reverse width -1\n";
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto curve = [&](std::size_t model, const std::string &style, const char *name) {
            return "$slice using 1:" + std::to_string(2 + 3 * model + c) + " with lines " + style + " title '" + name +
                   '\'';
        };
        charts += place_in_row(c, 0.06, 0.265) + title(std::string("BRDF slice at 45° incidence, ") + channels[c]) +
                  (c == 0 ? "set ylabel 'f in 1/sr'\n" : "unset ylabel\nunset key\n") + "plot " +
                  curve(0, std::string("linewidth 3.5 linecolor '#bbbbbb'"), "measured") + ", " +
                  curve(1, std::string("linewidth 1.5 linecolor '") + shared_colour + '\'', "shared") + ", " +
                  curve(2, std::string("linewidth 1.5 linecolor '") + per_lobe_colour + '\'', "per-lobe") + '\n';
    }
    return charts;
}

} // namespace

std::string plot_fit(const Context &context, FitSource &source, const Material &material) {
    const bool is_shared = info_of(material).model == SMX_MODEL_SHARED;
    const Material &other = source.other_model();
    const Material &shared = is_shared ? material : other, &per_lobe = is_shared ? other : material;

    const Curves curves = curves_of(material);
    const std::vector<smx_lobe> lobes = lobes_of(material, curves);
    const std::vector<std::string> shades = chart_shades(lobes.size());
    return run_gnuplot(chart_head(width, height) + "set multiplot\n" + heading(material, 0.965) +
                       density_chart(source.density(), lobes, shades, 0.705, 0.915) + "unset label 1\n" +
                       fresnel_charts(curves, curves.sets == 1 ? chart_shades(1) : shades) +
                       slice_charts(slice_at_45_degrees(context, source.brdf(), {&shared, &per_lobe})) +
                       "unset multiplot\n");
}

std::string plot_density(const Density &density, const Material &material) {
    const std::vector<smx_lobe> lobes = lobes_of(material, curves_of(material));
    return run_gnuplot(chart_head(width, density_height) + heading(material, 0.93) +
                       density_chart(density, lobes, chart_shades(lobes.size()), 0.15, 0.82));
}

} // namespace slopemix::cli
