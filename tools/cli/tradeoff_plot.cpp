// The page: a title, error against time for all methods, the widening by itself, and the strip.
#include "tradeoff_plot.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "plot.h"
#include "text.h"
#include "tradeoff_analysis.h"

namespace slopemix::cli {

namespace {

struct Style {
    const char *colour;
    int point;
    const char *label_offset; // of the labels, in characters
};

// Told apart also by those who do not see all colours (Okabe and Ito's palette), and by the points' form.
Style style_of(Method method) {
    switch (method) {
        case Method::grid:
            return {"#777777", 4, "-0.9,-0.5"};
        case Method::sobol:
            return {"#009e73", 8, "-0.9,-0.5"};
        case Method::mis:
            return {"#0072b2", 6, "0.9,0.5"};
        case Method::geometric:
            return {"#cc79a7", 12, "0.0,0.8"};
        case Method::shared:
            return {"#b87d00", 10, "0.0,0.8"};
        case Method::per_lobe:
            return {"#d55e00", 7, "0.0,-0.8"};
    }
    return {"#000000", 1, "0,0"};
}

std::string place(double left, double right) {
    return "set lmargin at screen " + fixed(left, 4) + "\nset rmargin at screen " + fixed(right, 4) +
           "\nset bmargin at screen 0.53\nset tmargin at screen 0.91\n";
}

// A chart of error against time, which grows with the curves that are added.
class Chart {
  public:
    Chart(std::string name, double left, double right) : name_(std::move(name)), left_(left), right_(right) {}

    // A point as time, error and the number that is its label.
    using Row = std::vector<double>;

    // Adds data, and returns the block's name; empty if there are none.
    std::string add(const std::vector<Row> &rows) {
        if (rows.empty()) return "";
        for (const Row &row : rows) {
            time_.see(row[0]);
            error_.see(row[1]);
        }
        const std::string data = name_ + std::to_string(count_++);
        data_ += chart_data(data, rows);
        return '$' + data;
    }

    // A height that is to be in view.
    std::string level(double error) {
        if (error > 0.0) error_.see(error);
        return chart_number(error);
    }

    void draw(const std::string &what) { plot_ += (plot_.empty() ? "plot " : ", ") + what; }

    // Lines and points with their labels, and an entry of the key.
    void draw_curve(const std::string &data, const Style &style, const std::string &title,
                    const std::string &prefix = "") {
        const std::string colour = std::string(" '") + style.colour + '\'';
        draw(data + " using 1:2 with linespoints linewidth 1.4 pointtype " + std::to_string(style.point) +
             " pointsize 0.55 linecolor" + colour + (title.empty() ? "" : " title " + chart_text(title)));
        draw(data + " using 1:2:(sprintf('" + prefix + "%g',$3)) with labels font ',8' textcolor" + colour +
             " offset " + style.label_offset);
    }

    bool is_empty() const { return plot_.empty(); }

    std::string script(const std::string &title, const std::string &error) const {
        return data_ + place(left_, right_) + "set title " + chart_text("{/:Bold " + title + '}') +
               "\nset logscale xy\nset format xy '10^{%T}'\nset xlabel 'seconds on the device, per image'\n"
               "set ylabel " +
               chart_text(error) + "\nset key at screen " + fixed(left_, 4) +
               ", screen 0.47 left top Left reverse horizontal maxcols 4 width -2\n" + range("x", time_) +
               range("y", error_) + plot_ + '\n';
    }

  private:
    struct Extent {
        double low = HUGE_VAL, high = 0.0;
        void see(double value) {
            low = std::min(low, value);
            high = std::max(high, value);
        }
    };

    // With room for the labels, and not rounded to whole decades.
    static std::string range(const char *axis, Extent extent) {
        return std::string("set ") + axis + "range [" + chart_number(extent.low / 1.7) + ':' +
               chart_number(extent.high * 1.7) + "]\n";
    }

    std::string name_, data_, plot_;
    double left_, right_;
    int count_ = 0;
    Extent time_, error_;
};

using Rows = std::vector<Chart::Row>;
using Wanted = std::function<bool(const Configuration &)>;

// Error against the measured table, labelled with samples or lobes.
Rows rows_of(const TradeoffResult &result, const Wanted &is_wanted) {
    Rows rows;
    for (const TradeoffPoint &point : result.points) {
        const Configuration &c = point.configuration;
        if (c.is_as_is() && is_wanted(c))
            rows.push_back({point.measured.kernel_seconds.median, error_bound(point.measured, result.truth),
                            static_cast<double>(is_filtered(c.method) ? c.lobes : c.samples)});
    }
    return rows;
}

Rows rows_of_front(const TradeoffResult &result) {
    Rows rows;
    for (const TradeoffPoint *point : pareto_set(result))
        rows.push_back({point->measured.kernel_seconds.median, error_bound(point->measured, result.truth), 0.0});
    return rows;
}

// All methods as they are by default; of the filter the closed form by N, and the orders of the chosen one.
std::string methods_chart(const TradeoffResult &result) {
    Chart chart("methods", 0.055, 0.575);
    chart.draw(chart.add(rows_of_front(result)) +
               " using 1:2 with lines linewidth 9 linecolor '#ece7b4' title 'Pareto set'");
    for (const auto &[word, method] : methods) {
        const std::string data = chart.add(rows_of(result, [&, method = method](const Configuration &c) {
            return c.method == method && (!is_filtered(method) || c.order == 0);
        }));
        if (data.empty()) continue;
        chart.draw_curve(data, style_of(method),
                         std::string(word) + (is_filtered(method) ? ", order 0, by N" : ", by samples"));
    }
    Rows orders;
    for (const TradeoffPoint *filter : chosen_filters(result))
        if (filter->configuration.order > 0)
            orders.push_back({filter->measured.kernel_seconds.median, error_bound(filter->measured, result.truth),
                              static_cast<double>(filter->configuration.order)});
    if (!orders.empty()) {
        const Configuration chosen = chosen_filters(result).front()->configuration;
        chart.draw_curve(
            chart.add(orders), {"#8b2500", 5, "0.0,0.8"},
            std::string(word_for(chosen.method, methods)) + ", N = " + std::to_string(chosen.lobes) + ", by order (o)",
            "o");
    }
    chart.draw(chart.level(floor_of(result.truth)) +
               " with lines dashtype 3 linewidth 1 linecolor '#555555' title 'floor of the truth'");
    return chart.script("All methods", "relRMSE against the measured table");
}

// Error against the fitted base, labelled with the order.
Rows rows_of_widening(const TradeoffResult &result, Method method, std::uint32_t lobes) {
    Rows rows;
    for (const TradeoffPoint &point : result.points) {
        const Configuration &c = point.configuration;
        if (c.is_as_is() && c.method == method && c.lobes == lobes && c.order >= 0 && point.measured.widening)
            rows.push_back(
                {point.measured.kernel_seconds.median, *point.measured.widening, static_cast<double>(c.order)});
    }
    return rows;
}

// The filter's widening alone, a curve over the orders for each N; beside it the references, whose noise is the same
// for any table.
std::string widening_chart(const TradeoffJob &job, const TradeoffResult &result) {
    const std::vector<const TradeoffPoint *> filters = chosen_filters(result);
    if (filters.empty()) return "";
    const Method method = filters.front()->configuration.method;
    const std::vector<std::string> shades = chart_shades(job.axes.lobes.size());
    Chart chart("widening", 0.645, 0.975);
    for (const Method sampler : {Method::grid, Method::sobol, Method::mis}) {
        const std::string data =
            chart.add(rows_of(result, [&](const Configuration &c) { return c.method == sampler; }));
        if (data.empty()) continue;
        chart.draw(data + " using 1:2 with linespoints linewidth 1 pointsize 0.4 pointtype " +
                   std::to_string(style_of(sampler).point) + " linecolor '#bbbbbb' title '" +
                   word_for(sampler, methods) + '\'');
    }
    for (std::size_t k = 0; k < shades.size(); ++k) {
        const std::string data = chart.add(rows_of_widening(result, method, job.axes.lobes[k]));
        if (data.empty()) continue; // of auto alone, which is no order
        chart.draw_curve(data, {shades[k].c_str(), 7, k % 2 == 0 ? "-0.9,-0.4" : "0.9,0.4"},
                         "N = " + std::to_string(job.axes.lobes[k]));
    }
    if (chart.is_empty()) return "";
    return chart.script(std::string("The widening of ") + word_for(method, methods) + ", by order",
                        "relRMSE against the fitted base");
}

} // namespace

std::vector<TradeoffPoint> strip_of(const TradeoffResult &result) {
    const std::vector<const TradeoffPoint *> front = pareto_set(result);
    const std::size_t count = std::min(strip_length, front.size());
    std::vector<TradeoffPoint> strip;
    for (std::size_t k = 0; k < count; ++k)
        strip.push_back(*front[count > 1 ? k * (front.size() - 1) / (count - 1) : 0]);
    return strip;
}

std::string plot_tradeoff(const TradeoffJob &job, const TradeoffResult &result) {
    const std::string heading = std::string(result.material.name) + ": what accuracy costs in time. Surface " +
                                general(job.alpha.first, 4) + ", " + general(job.alpha.second, 4) + ", light at " +
                                general(job.light_degrees, 4) + "°, " + std::to_string(job.flags.resolution.width) +
                                " × " + std::to_string(job.flags.resolution.height) + " pixels";
    return run_gnuplot(chart_head(page_width, page_height) + "set multiplot\nset label 1 " + chart_text(heading) +
                       " at screen 0.02, screen 0.97 noenhanced font ',20' textcolor '#111111'\n" +
                       methods_chart(result) + "unset label 1\n" + widening_chart(job, result) +
                       tradeoff_strip(result) + "unset multiplot\n");
}

} // namespace slopemix::cli
