// The page: a title, error against time for all methods, the filter's orders by themselves, and the strip.
#include "tradeoff_plot.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "plot.h"
#include "text.h"
#include "tradeoff_analysis.h"

namespace slopemix::cli {

namespace {

using Rows = std::vector<std::vector<double>>;

struct Style {
    const char *colour;
    int point;
    const char *label_offset; // of the labels, in characters
};

// Told apart also by those who do not see all colours (Okabe and Ito's palette), and by the points' form.
Style style_of(Method method) {
    switch (method) {
        case Method::grid:
            return {"#777777", 4, "0.9,0.5"};
        case Method::sobol:
            return {"#009e73", 8, "-0.9,-0.6"};
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

using Wanted = std::function<bool(const Configuration &)>;

// time, error, label's number
Rows rows_of(const TradeoffResult &result, const Wanted &is_wanted) {
    Rows rows;
    for (const TradeoffPoint &point : result.points) {
        const Configuration &c = point.configuration;
        if (!is_wanted(c)) continue;
        rows.push_back({point.measured.kernel_seconds.median, error_bound(point.measured, result.truth),
                        static_cast<double>(is_filtered(c.method) ? c.lobes : c.samples)});
    }
    return rows;
}

std::string place(double left, double right, double bottom, double top) {
    const auto margin = [](const char *side, double at) {
        return std::string("set ") + side + "margin at screen " + fixed(at, 4) + '\n';
    };
    return margin("l", left) + margin("r", right) + margin("b", bottom) + margin("t", top);
}

std::string axes(const std::string &title) {
    return "set title " + chart_text("{/:Bold " + title + '}') +
           "\nset logscale xy\nset format xy '10^{%T}'\nset xlabel 'seconds on the device, per image'\n"
           "set ylabel 'relRMSE against the truth'\nset offsets graph 0.03, graph 0.05, graph 0.05, graph 0.05\n";
}

// A line with its points, and their labels.
std::string curve(const std::string &data, const Style &style, const std::string &colour, const std::string &title) {
    return '$' + data + " using 1:2 with linespoints linewidth 1.4 pointtype " + std::to_string(style.point) +
           " pointsize 0.55 linecolor '" + colour + "' title " + chart_text(title) + ", $" + data +
           " using 1:2:(sprintf('%g',$3)) with labels font ',8' textcolor '" + colour + "' offset " +
           style.label_offset;
}

// All methods as they are by default, the filter in closed form.
std::string methods_chart(const TradeoffResult &result) {
    Rows front;
    for (const TradeoffPoint *point : pareto_set(result))
        front.push_back({point->measured.kernel_seconds.median, error_bound(point->measured, result.truth)});
    std::string data = chart_data("front", front);
    std::string plot =
        "plot $front using 1:2 with lines linewidth 9 linecolor '#e8e4b0' title 'Pareto set, all points'";
    for (const auto &[word, method] : methods) {
        const Rows rows = rows_of(result, [&, method = method](const Configuration &c) {
            return c.method == method && c.is_as_is() && (!is_filtered(method) || c.order == 0);
        });
        if (rows.empty()) continue;
        const std::string name = std::string("m") + std::to_string(static_cast<int>(method));
        data += chart_data(name, rows);
        plot += ", " +
                curve(name, style_of(method), style_of(method).colour,
                      is_filtered(method) ? std::string(word) + ", order 0, by N" : std::string(word) + ", by samples");
    }
    const std::string floor = chart_number(floor_of(result.truth));
    plot += ", " + floor +
            " with lines dashtype 3 linewidth 1 linecolor '#555555' title 'floor: ten times the truth’s own error'";
    return data + place(0.055, 0.575, 0.475, 0.90) + axes("All methods") +
           "set key at graph 0.99, graph 0.99 right top Left reverse\n" + plot + "\n";
}

// The filter by model and order.
std::string orders_chart(const TradeoffResult &result) {
    std::string data, plot;
    for (const auto &[word, method] : methods) {
        std::vector<std::int32_t> orders;
        for (const TradeoffPoint &point : result.points)
            if (point.configuration.method == method && is_filtered(method) && point.configuration.is_as_is() &&
                std::find(orders.begin(), orders.end(), point.configuration.order) == orders.end())
                orders.push_back(point.configuration.order);
        for (const std::int32_t order : orders) {
            const std::string name = "o" + std::to_string(static_cast<int>(method)) + "_" + std::to_string(order + 1);
            data += chart_data(name, rows_of(result, [&, method = method](const Configuration &c) {
                                   return c.method == method && c.order == order && c.is_as_is();
                               }));
            plot += (plot.empty() ? "plot " : ", ") + curve(name, style_of(method), style_of(method).colour,
                                                            std::string(word) + ", order " + std::to_string(order));
        }
    }
    if (plot.empty()) return "";
    return data + place(0.645, 0.985, 0.475, 0.90) + axes("The filter, by order and N") + plot + "\n";
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

std::string tradeoff_charts(const TradeoffResult &result) { return methods_chart(result) + orders_chart(result); }

std::string plot_tradeoff(const TradeoffJob &job, const TradeoffResult &result) {
    const std::string heading = std::string(result.material.name) + ": what accuracy costs in time. Surface " +
                                general(job.alpha.first, 4) + ", " + general(job.alpha.second, 4) + ", light at " +
                                general(job.light_degrees, 4) + "°, " + std::to_string(job.flags.resolution.width) +
                                " × " + std::to_string(job.flags.resolution.height) + " pixels";
    return run_gnuplot(chart_head(page_width, page_height) + "set multiplot\nset label 1 " + chart_text(heading) +
                       " at screen 0.02, screen 0.965 noenhanced font ',20' textcolor '#111111'\n" +
                       tradeoff_charts(result) + "unset label 1\n" + tradeoff_strip(result) + "unset multiplot\n");
}

} // namespace slopemix::cli
