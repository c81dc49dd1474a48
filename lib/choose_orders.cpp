#include "choose_orders.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shade_filtered.h"

namespace smx {

namespace {

// What is tried, and the time that a lobe takes by it, relative to the closed form (slopemix_bench, shade.per-lobe.n8
// by order). All are measured against the last.
struct Candidate {
    int order;
    double cost;
};
constexpr std::array<Candidate, 6> candidates = {{{0, 1.0}, {1, 3.0}, {2, 5.0}, {3, 9.0}, {5, 23.0}, {8, 56.0}}};
constexpr std::size_t finest = candidates.size() - 1;

// Lit pixels that the orders are tried on, about; and the share of the tolerance that they may fill, since so few
// pixels tell an image's error to no better than that.
constexpr double probes = 48.0, safety = 0.8;

struct Pairs {
    std::vector<float> wi, wo; // [count][3], packed
    std::size_t count() const { return wi.size() / 3; }
};

// Centres of a grid of pixels, as fine as gives the number of lit ones.
Pairs lit_pairs(const Scene &scene) {
    Scene coarse = scene;
    for (std::uint32_t side = 4; side <= 64; ++side) {
        coarse.width = coarse.height = side;
        if (static_cast<double>(lit_pixels(coarse)) >= probes) break;
    }
    Pairs pairs;
    visit_lit_pixels(coarse, [&](const LocalDirections &d) {
        for (double v : d.wi) pairs.wi.push_back(static_cast<float>(v));
        for (double v : d.wo) pairs.wo.push_back(static_cast<float>(v));
    });
    return pairs;
}

// What the image's lobes are by each candidate, over pixels and channels.
class Trial {
  public:
    Trial(const Material &material, const Scene &scene, const std::vector<float> &values, std::size_t pairs);

    std::size_t lobes() const { return lobes_; }
    // Error of a choice of candidates, by lobe, relative to the finest: root mean squares over the image.
    double error(const std::vector<std::size_t> &choice) const;

  private:
    const std::vector<double> &of(std::size_t candidate, std::size_t lobe) const {
        return values_[candidate * lobes_ + lobe];
    }

    std::size_t lobes_;
    std::vector<std::vector<double>> values_;
};

Trial::Trial(const Material &material, const Scene &scene, const std::vector<float> &values, std::size_t pairs)
    : lobes_(material.lobes.size()) {
    const double angle = theta_d(scene);
    for (std::size_t entry = 0; entry < candidates.size() * lobes_; ++entry) {
        const FresnelCurves &curves = material.fresnel[material.model == Model::PerLobe ? entry % lobes_ : 0];
        const Rgb f = fresnel_at(material.theta_d, curves, angle);
        std::vector<double> coloured;
        for (std::size_t p = 0; p < pairs; ++p)
            for (double channel : f) coloured.push_back(channel * double{values[entry * pairs + p]});
        values_.push_back(std::move(coloured));
    }
}

double Trial::error(const std::vector<std::size_t> &choice) const {
    double error2 = 0.0, value2 = 0.0;
    for (std::size_t p = 0; p < values_[0].size(); ++p) {
        double value = 0.0, error = 0.0;
        for (std::size_t k = 0; k < lobes_; ++k) {
            value += of(finest, k)[p];
            error += of(choice[k], k)[p] - of(finest, k)[p];
        }
        error2 += error * error;
        value2 += value * value;
    }
    return value2 > 0.0 ? std::sqrt(error2 / value2) : 0.0;
}

// Raises one lobe after the other, each time the one, and as far, as lowers the error most for its cost.
std::vector<std::size_t> cheapest(const Trial &trial, double tolerance) {
    std::vector<std::size_t> choice(trial.lobes(), 0);
    for (double error = trial.error(choice); error > tolerance;) {
        double best_gain = -1.0;
        std::vector<std::size_t> best;
        for (std::size_t k = 0; k < trial.lobes(); ++k)
            for (std::size_t c = choice[k] + 1; c <= finest; ++c) {
                std::vector<std::size_t> raised = choice;
                raised[k] = c;
                const double cost = candidates[c].cost - candidates[choice[k]].cost;
                const double gain = (error - trial.error(raised)) / cost;
                if (gain > best_gain) best_gain = gain, best = raised;
            }
        if (best.empty()) break;
        choice = best;
        error = trial.error(choice);
    }
    // What an early raise did, a later one may have made needless.
    for (std::size_t k = trial.lobes(); k-- > 0;)
        for (std::size_t c = 0; c < choice[k]; ++c) {
            std::vector<std::size_t> lowered = choice;
            lowered[k] = c;
            if (trial.error(lowered) <= tolerance) choice = lowered;
        }
    return choice;
}

std::vector<int> orders_of(const std::vector<std::size_t> &choice) {
    std::vector<int> orders;
    for (std::size_t c : choice) orders.push_back(candidates[c].order);
    return orders;
}

std::vector<int> tried_orders(std::size_t lobes) {
    std::vector<int> orders;
    for (const Candidate &candidate : candidates) orders.insert(orders.end(), lobes, candidate.order);
    return orders;
}

} // namespace

ChosenOrders widening_orders(Context &context, const Material &material, const Scene &scene,
                             const RenderOptions &options) {
    if (options.widening_order != widening_auto || rough_axes(scene.displacement) == 0)
        return {fixed_orders(material, scene.displacement, std::max(options.widening_order, 0)), {}};

    const Context::Lock lock(context);
    const CallTimer timer(context);
    const Pairs pairs = lit_pairs(scene);
    const LobeValues tried = eval_lobes(context, material, tried_orders(material.lobes.size()), scene, options.grade,
                                        pairs.count(), pairs.wi.data(), pairs.wo.data());
    const Trial trial(material, scene, tried.values, pairs.count());
    return {orders_of(cheapest(trial, safety * options.widening_tolerance)),
            timer.finish(context, tried.kernel_seconds, 0)};
}

} // namespace smx
