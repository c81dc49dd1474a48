#include "choose_orders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "even_points.h"
#include "shade_filtered.h"

namespace smx {

namespace {

// What is tried, and the time that a lobe takes by it, relative to the closed form (slopemix bench).
struct Candidate {
    int order;
    double cost;
};
constexpr std::array<Candidate, 6> candidates = {{{0, 1.0}, {1, 6.0}, {2, 14.0}, {3, 17.0}, {5, 40.0}, {8, 88.0}}};

// All are measured against the last that is tried: order 5, which is some 0.003 off, where that is little.
std::size_t finest_candidate(double tolerance) { return candidates.size() - (tolerance >= 0.012 ? 2 : 1); }

// Lit pixels that the orders are tried on, about; and the share of the tolerance that they may fill, since so few
// pixels tell an image's error to no better than that.
constexpr std::size_t probes = 96;
constexpr double safety = 0.8;

struct Pairs {
    std::vector<float> wi, wo; // [count][3], packed
    std::size_t count() const { return wi.size() / 3; }
};

// Lit pixels of the image, spread evenly, which leaves out no part of it, the rim included. Fewer where little of the
// image is lit.
Pairs lit_pairs(const Scene &scene) {
    constexpr int most_points = 4096;
    const std::uint32_t side = std::min(scene.width, scene.height);
    Pairs pairs;
    for (int n = 1; n <= most_points && pairs.count() < probes; ++n) {
        // Over the square that the sphere fills.
        const auto [x, y] = even_point(n);
        const auto column = static_cast<std::uint32_t>(x * side), row = static_cast<std::uint32_t>(y * side);
        const auto d = lit_pixel(scene, (scene.width - side) / 2 + column, (scene.height - side) / 2 + row);
        if (!d) continue;
        for (double v : d->wi) pairs.wi.push_back(static_cast<float>(v));
        for (double v : d->wo) pairs.wo.push_back(static_cast<float>(v));
    }
    return pairs;
}

// What the image's lobes are by each candidate, over pixels and channels.
class Trial {
  public:
    Trial(const Material &material, const Scene &scene, const std::vector<float> &values, std::size_t pairs,
          std::size_t finest);

    std::size_t lobes() const { return lobes_; }
    std::size_t finest() const { return finest_; }
    // What all lobes by the first candidate have beyond the finest.
    std::vector<double> first_excess() const;
    // Moves a lobe from one candidate to another in such an excess.
    void move(std::vector<double> &excess, std::size_t lobe, std::size_t from, std::size_t to) const;
    // Of an excess, relative to the finest: root mean squares over the image. `moved` as if it were.
    double error(const std::vector<double> &excess) const;
    double error_moved(const std::vector<double> &excess, std::size_t lobe, std::size_t from, std::size_t to) const;

  private:
    const std::vector<double> &of(std::size_t candidate, std::size_t lobe) const {
        return values_[candidate * lobes_ + lobe];
    }

    std::size_t lobes_, finest_;
    std::vector<std::vector<double>> values_;
    double value2_ = 0.0;
};

Trial::Trial(const Material &material, const Scene &scene, const std::vector<float> &values, std::size_t pairs,
             std::size_t finest)
    : lobes_(material.lobes.size()), finest_(finest) {
    const double angle = theta_d(scene);
    for (std::size_t entry = 0; entry < (finest + 1) * lobes_; ++entry) {
        const FresnelCurves &curves = material.fresnel[material.model == Model::PerLobe ? entry % lobes_ : 0];
        const Rgb f = fresnel_at(material.theta_d, curves, angle);
        std::vector<double> coloured;
        for (std::size_t p = 0; p < pairs; ++p)
            for (double channel : f) coloured.push_back(channel * double{values[entry * pairs + p]});
        values_.push_back(std::move(coloured));
    }
    std::vector<double> total(values_[0].size());
    for (std::size_t k = 0; k < lobes_; ++k)
        for (std::size_t p = 0; p < total.size(); ++p) total[p] += of(finest_, k)[p];
    for (double value : total) value2_ += value * value;
}

std::vector<double> Trial::first_excess() const {
    std::vector<double> excess(values_[0].size());
    for (std::size_t k = 0; k < lobes_; ++k) move(excess, k, finest_, 0);
    return excess;
}

void Trial::move(std::vector<double> &excess, std::size_t lobe, std::size_t from, std::size_t to) const {
    for (std::size_t p = 0; p < excess.size(); ++p) excess[p] += of(to, lobe)[p] - of(from, lobe)[p];
}

double Trial::error(const std::vector<double> &excess) const {
    double error2 = 0.0;
    for (double e : excess) error2 += e * e;
    return value2_ > 0.0 ? std::sqrt(error2 / value2_) : 0.0;
}

double Trial::error_moved(const std::vector<double> &excess, std::size_t lobe, std::size_t from, std::size_t to) const {
    double error2 = 0.0;
    for (std::size_t p = 0; p < excess.size(); ++p) {
        const double e = excess[p] + of(to, lobe)[p] - of(from, lobe)[p];
        error2 += e * e;
    }
    return value2_ > 0.0 ? std::sqrt(error2 / value2_) : 0.0;
}

// Raises one lobe after the other, each time the one, and as far, as lowers the error most for its cost.
std::vector<std::size_t> cheapest(const Trial &trial, double tolerance) {
    std::vector<std::size_t> choice(trial.lobes(), 0);
    std::vector<double> excess = trial.first_excess();
    for (double error = trial.error(excess); !(error <= tolerance); error = trial.error(excess)) {
        double best_gain = -std::numeric_limits<double>::infinity();
        std::size_t lobe = trial.lobes(), to = 0;
        for (std::size_t k = 0; k < trial.lobes(); ++k)
            for (std::size_t c = choice[k] + 1; c <= trial.finest(); ++c) {
                const double cost = candidates[c].cost - candidates[choice[k]].cost;
                const double gain = (error - trial.error_moved(excess, k, choice[k], c)) / cost;
                if (gain > best_gain) best_gain = gain, lobe = k, to = c;
            }
        if (lobe == trial.lobes()) break; // all are at the finest
        trial.move(excess, lobe, choice[lobe], to);
        choice[lobe] = to;
    }
    // What an early raise did, a later one may have made needless.
    for (std::size_t k = trial.lobes(); k-- > 0;)
        for (std::size_t c = 0; c < choice[k]; ++c)
            if (trial.error_moved(excess, k, choice[k], c) <= tolerance) {
                trial.move(excess, k, choice[k], c);
                choice[k] = c;
            }
    return choice;
}

std::vector<int> orders_of(const std::vector<std::size_t> &choice) {
    std::vector<int> orders;
    for (std::size_t c : choice) orders.push_back(candidates[c].order);
    return orders;
}

std::vector<int> tried_orders(std::size_t lobes, std::size_t finest) {
    std::vector<int> orders;
    for (std::size_t c = 0; c <= finest; ++c) orders.insert(orders.end(), lobes, candidates[c].order);
    return orders;
}

} // namespace

ChosenOrders widening_orders(Context &context, const Material &material, const Scene &scene, Effects on,
                             const RenderOptions &options) {
    if (options.widening_order != widening_auto || rough_axes(scene.displacement) == 0)
        return {fixed_orders(material, scene.displacement, std::max(options.widening_order, 0)), {}};

    const Context::Lock lock(context);
    const CallTimer timer(context);
    const Pairs pairs = lit_pairs(scene);
    if (pairs.count() == 0) // nothing to see
        return {fixed_orders(material, scene.displacement, 0), timer.finish(context, 0.0, 0)};
    const std::size_t finest = finest_candidate(options.widening_tolerance);
    const LobeValues tried = eval_lobes(context, material, tried_orders(material.lobes.size(), finest), scene, on,
                                        options.grade, pairs.count(), pairs.wi.data(), pairs.wo.data());
    const Trial trial(material, scene, tried.values, pairs.count(), finest);
    return {orders_of(cheapest(trial, safety * options.widening_tolerance)),
            timer.finish(context, tried.kernel_seconds, 0)};
}

} // namespace smx
