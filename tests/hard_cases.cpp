#include "hard_cases.h"

#include <cmath>

namespace test {

namespace {

using oracle::Lobe;
using oracle::Vec;

double as_float(double v) { return static_cast<float>(v); }

constexpr std::array alphas{0.0, 1e-7, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 1.0, 3.0, 30.0, 1e3};
constexpr std::array correlations{0.0, 0.5, 1.0 - 1e-6, -(1.0 - 1e-6), -0.7};
constexpr std::array<std::array<double, 2>, 8> means{
    {{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}, {0.5, -0.3}, {1e-5, 2.0}, {-30.0, 10.0}}};

std::vector<Lobe> sixty_four() {
    std::vector<Lobe> lobes;
    for (int k = 0; k < 64; ++k) lobes.push_back({1.0 / 64, as_float(std::pow(10.0, -7.0 + 10.0 * k / 63))});
    return lobes;
}

// One lobe of every alpha, then the mixtures: weights 0, 1 and 1e-12, identical lobes, 1e6 apart, 64.
const std::vector<std::vector<Lobe>> &lobe_sets() {
    static const std::vector<std::vector<Lobe>> sets = [] {
        std::vector<std::vector<Lobe>> list;
        for (double a : alphas) list.push_back({{1.0, as_float(a)}});
        list.push_back({{0.5, as_float(0.1)}, {0.5, as_float(0.1)}});
        list.push_back({{0.5, as_float(1e-4)}, {0.5, 100.0}});
        list.push_back({{1e-12, as_float(1e-3)}, {1.0 - 1e-12, 1.0}});
        list.push_back({{1.0 - 1e-12, as_float(1e-4)}, {1e-12, 30.0}});
        list.push_back({{0.0, as_float(1e-2)}, {1.0, 0.25}});
        list.push_back(sixty_four());
        return list;
    }();
    return sets;
}

// A slope of the widened lobe k: its distance from the mean is from 0 to 13 alphas.
Vec facet(const HardCase &c, Random &random) {
    const double alpha = c.lobes[random.below(c.lobes.size())].alpha;
    const double xx = c.x.alpha_x * c.x.alpha_x + alpha * alpha, yy = c.x.alpha_y * c.x.alpha_y + alpha * alpha;
    const double xy = c.x.rho * c.x.alpha_x * c.x.alpha_y;
    const double length = 13.0 * std::pow(random.uniform(), 2.0), phi = random.uniform(0.0, 2.0 * oracle::pi);
    const double l11 = std::sqrt(xx), l21 = l11 > 0.0 ? xy / l11 : 0.0, l22 = std::sqrt(std::max(yy - l21 * l21, 0.0));
    const double sx = c.x.mean_x + l11 * length * std::cos(phi);
    const double sy = c.x.mean_y + length * (l21 * std::cos(phi) + l22 * std::sin(phi));
    return oracle::normalised({-sx, -sy, 1.0});
}

Vec at_height(double z, Random &random) {
    const double phi = random.below(8) == 0 ? 0.0 : random.uniform(0.0, 2.0 * oracle::pi);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

// Normal incidence, grazing within 1e-3 down to the smallest normal float, exactly grazing, below.
Vec edge(Random &random) {
    constexpr std::array heights{1.0, 1e-3, 1e-4, 1e-7, 1e-12, 1e-20, 1e-30, 0.0, -1e-7, -0.5};
    const std::size_t kind = random.below(heights.size() + 2);
    if (kind >= heights.size()) return random.direction();
    const double z = heights[kind];
    return at_height(z > 0.0 && z < 1.0 && random.below(2) == 0 ? z * random.uniform(0.1, 1.0) : z, random);
}

Vec slightly_off(const Vec &k, Random &random) {
    const double by = random.log_uniform(1e-8, 1e-1);
    return {k.x + by * random.uniform(-1.0, 1.0), k.y + by * random.uniform(-1.0, 1.0),
            k.z * (1.0 + by * random.uniform(-1.0, 1.0))};
}

Vec partner(const HardCase &c, const Vec &wi, std::size_t kind, Random &random) {
    switch (kind) {
        case 0: // independent
            return edge(random);
        case 1: // wh is wi
            return wi;
        case 2: // wh undefined
            return {-wi.x, -wi.y, -wi.z};
        case 3: // wh at the pole
            return {-wi.x, -wi.y, wi.z};
        case 4: // wo nearly -wi where both are low, wh near the pole
            return slightly_off({-wi.x, -wi.y, wi.z}, random);
        case 5: // wh near wi: low where wi is
            return slightly_off(wi, random);
        default: // wh within the lobes
            return oracle::reflect(wi, facet(c, random));
    }
}

std::array<float, 3> floats(const Vec &k) {
    return {static_cast<float>(k.x), static_cast<float>(k.y), static_cast<float>(k.z)};
}

} // namespace

HardCase hard_case(std::size_t index) {
    // Counts and strides without a common factor: all combinations come, each as often.
    const std::size_t n = alphas.size();
    HardCase c;
    // The 64 lobes, which take the oracle 64 times as long, come once where the others come ten times.
    const std::size_t sets = lobe_sets().size() - 1;
    c.lobes = index % (10 * sets + 1) == 10 * sets ? lobe_sets().back() : lobe_sets()[index % sets];
    const std::size_t pair = index * 7919 % (n * n);
    c.x.alpha_x = as_float(alphas[pair / n]), c.x.alpha_y = as_float(alphas[pair % n]);
    c.x.rho = as_float(correlations[index / 7 % correlations.size()]);
    const auto &mean = means[index / 3 % means.size()];
    c.x.mean_x = as_float(mean[0]), c.x.mean_y = as_float(mean[1]);
    if (index % 8 == 1) c.x = {c.x.alpha_x, c.x.alpha_x, 0.0, 0.0, 0.0};
    if (index % 8 == 3) c.x.mean_x = c.x.mean_y = 0.0;
    c.is_equidistant = index / 2 % 2 == 1;
    return c;
}

std::vector<HardPair> hard_pairs(const HardCase &c, std::size_t count, uint64_t seed) {
    Random random(seed);
    std::vector<HardPair> pairs;
    while (pairs.size() < count) {
        const std::size_t kind = random.below(12);
        const Vec wi = kind < 6 || random.below(2) == 0 ? edge(random) : random.direction();
        const Vec wo = partner(c, wi, kind, random);
        // A facet that turns wo below is drawn again, most of the time.
        if (kind >= 6 && wo.z <= 0.0 && random.below(10) > 0) continue;
        pairs.push_back({floats(wi), floats(wo)});
    }
    return pairs;
}

HardCurve hard_theta_d(const HardCase &c) {
    return c.is_equidistant ? HardCurve{0.0f, 0.25f, 0.5f, 0.75f, 1.0f} : HardCurve{0.0f, 0.3f, 0.301f, 0.9f, 1.0f};
}

HardCurve hard_curve(const HardCase &c, std::size_t set, std::size_t channel) {
    const float share = 1.0f / static_cast<float>(1 + set % 4), level = c.is_equidistant ? 1.0f : 0.0f;
    if (channel == 0) return {0.04f * share, 0.05f, 0.051f, 0.5f, 1.0f};
    if (channel == 1) return {level, level, level, level, level};
    return {1e-10f, 1e-10f, share, 0.25f, 0.0f};
}

} // namespace test
