// smx_material_eval against the oracle, on random directions and on the ones where shading code breaks: grazing,
// normal, mirror-like, alphas from 1e-4 to 20, displacements with one alpha 0, correlation, mean slopes.
#include <gtest/gtest.h>

#include "close.h"
#include "directions.h"
#include "random.h"
#include "support.h"

using oracle::Lobe;
using oracle::Mixture;
using oracle::Vec;
using test::Directions;

namespace {

constexpr double float_epsilon = 0x1p-24;
// Float32 arithmetic of a well conditioned value: about thirty roundings and the device's own exp and erf.
constexpr double base_tolerance = 1e-5;
// Below this float32 is denormal: the exponential of a lobe, and the result.
constexpr double smallest_float = 0x1p-126;
constexpr double floor_tolerance = 1e-35;

struct Case {
    std::string name;
    std::vector<Lobe> lobes;
    smx_displacement x;
};

const std::vector<Case> &cases() {
    static const std::vector<Case> list{
        {"one lobe", {{1.0, 0.3}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {"alpha 1e-4", {{1.0, 1e-4}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {"alpha 20", {{1.0, 20.0}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {"eight lobes",
         {{0.1, 1e-3}, {0.1, 3e-3}, {0.1, 0.01}, {0.1, 0.03}, {0.2, 0.1}, {0.2, 0.3}, {0.1, 1.0}, {0.1, 3.0}},
         {0.0, 0.0, 0.0, 0.0, 0.0}},
        {"wide and narrow", {{1e-3, 1e-4}, {0.999, 20.0}}, {0.0, 0.0, 0.0, 0.0, 0.0}},
        {"isotropic X", {{1.0, 0.02}}, {0.25, 0.25, 0.0, 0.0, 0.0}},
        {"latitudinal X", {{0.5, 1e-3}, {0.5, 0.2}}, {0.5, 0.0, 0.0, 0.0, 0.0}},
        {"longitudinal X", {{0.5, 1e-3}, {0.5, 0.2}}, {0.0, 0.5, 0.0, 0.0, 0.0}},
        {"alpha 1e-4 on a line", {{1.0, 1e-4}}, {0.5, 0.0, 0.0, 0.0, 0.0}},
        {"ratio 1e4", {{1.0, 1e-4}}, {1e-4, 1.0, 0.0, 0.0, 0.0}},
        {"correlated", {{0.3, 0.05}, {0.7, 0.4}}, {0.4, 0.2, 0.9, 0.0, 0.0}},
        {"anticorrelated", {{1.0, 1e-3}}, {0.3, 0.3, -0.9, 0.0, 0.0}},
        {"mean slope", {{0.3, 0.05}, {0.7, 0.4}}, {0.2, 0.2, 0.0, 0.5, -0.3}},
        {"mean slope, correlated", {{1.0, 0.1}}, {0.6, 0.1, 0.8, -0.4, 0.7}},
        {"mean slope alone", {{1.0, 0.1}}, {0.0, 0.0, 0.0, 0.3, 0.2}},
        {"rough X", {{1.0, 0.1}}, {10.0, 5.0, 0.3, 0.0, 0.0}},
    };
    return list;
}

// A material is a sum of parts, each a mixture with its own masking and colour: one part in the shared model, one for
// every lobe in the per-lobe model.
struct Part {
    Mixture mixture;
    test::Colour fresnel;
};

test::Colour colour_of_lobe(std::size_t k) {
    const double share = static_cast<double>(k + 1);
    return {1.0 / share, 0.1 * share, 0.5};
}

std::vector<Part> parts_of(const Case &c, smx_model model) {
    if (model == SMX_MODEL_SHARED) return {{{c.lobes, test::gaussian(c.x)}, test::channel_fresnel}};
    std::vector<Part> parts;
    for (const Lobe &l : c.lobes)
        parts.push_back({{{{1.0, l.alpha}}, test::gaussian(c.x)}, colour_of_lobe(parts.size())});
    return parts;
}

test::Material material_of(const Case &c, smx_model model) {
    if (model == SMX_MODEL_SHARED) return test::make_material(c.lobes, test::channel_fresnel);
    std::vector<test::Colour> colours;
    for (std::size_t k = 0; k < c.lobes.size(); ++k) colours.push_back(colour_of_lobe(k));
    return test::make_per_lobe_material(c.lobes, colours);
}

Directions random_directions() {
    test::Random random(7);
    Directions d;
    for (int k = 0; k < 3000; ++k) d.add(random.direction(), random.direction());
    return d;
}

// Near a mirror pair, where sharp lobes have all their value: wo is wi reflected about a facet of a random small slope.
Directions mirror_directions() {
    test::Random random(8);
    Directions d;
    while (d.count() < 3000) {
        const double slope = random.log_uniform(1e-6, 10.0), phi = random.uniform(0.0, 2.0 * oracle::pi);
        const Vec wi = random.direction(1e-3);
        const Vec wm = oracle::normalised({slope * std::cos(phi), slope * std::sin(phi), 1.0});
        const Vec wo = oracle::reflect(wi, wm);
        if (wo.z > 1e-4) d.add(wi, wo);
    }
    return d;
}

Directions hard_directions() {
    Directions d;
    std::vector<Vec> list;
    for (const double z : {1.0, 0.999, 0.5, 0.1, 1e-3, 1e-5})
        for (const double phi : {0.0, 0.3, oracle::pi / 2.0, oracle::pi, 5.0}) {
            const double r = std::sqrt(1.0 - z * z);
            list.push_back({r * std::cos(phi), r * std::sin(phi), z});
        }
    for (const Vec &wi : list)
        for (const Vec &wo : list) d.add(wi, wo);
    return d;
}

std::vector<float> eval(smx_material material, const smx_displacement &x, smx_masking g, const Directions &d) {
    std::vector<float> fcos(3 * d.count(), -1.0f);
    EXPECT_SMX_OK(
        smx_material_eval(test::context(), material, &x, g, nullptr, d.count(), d.wi.data(), d.wo.data(), fcos.data()));
    return fcos;
}

// How much the roundings of float32 inputs move a lobe's density: |d exponent / d slope| times the slope's error.
double exponent_error(const oracle::Gaussian &z, double sx, double sy) {
    const double det = z.cov_xx * z.cov_yy - z.cov_xy * z.cov_xy;
    const double condition = z.cov_xx * z.cov_yy / det;
    const double dx = sx - z.mean_x, dy = sy - z.mean_y;
    const double gx = std::abs(z.cov_yy * dx - z.cov_xy * dy) / det, gy = std::abs(z.cov_xx * dy - z.cov_xy * dx) / det;
    const double moved = gx * (std::abs(sx) + std::abs(z.mean_x)) + gy * (std::abs(sy) + std::abs(z.mean_y));
    return 8.0 * float_epsilon * (moved + condition * oracle::exponent(z, sx, sy));
}

// Relative error that float32 may have here: the base, the exponents weighted by their lobes' shares, and the
// cancellation in the mean plane's projected areas.
double allowed_error(const Mixture &m, const Vec &wi, const Vec &wo) {
    const Vec h = oracle::half_vector(wi, wo);
    double total = 0.0, error = 0.0;
    for (const Lobe &l : m.lobes) {
        const oracle::Gaussian z = oracle::widened(m.x, l.alpha);
        const double d = l.weight * oracle::p22(z, -h.x / h.z, -h.y / h.z);
        total += d;
        error += d * exponent_error(z, -h.x / h.z, -h.y / h.z);
    }
    double cancellation = 0.0;
    for (const Vec &k : {wi, wo})
        cancellation +=
            (std::abs(k.z) + std::abs(k.x * m.x.mean_x) + std::abs(k.y * m.x.mean_y)) / oracle::plane(m.x, k);
    return base_tolerance + (total > 0.0 ? error / total : 0.0) + 8.0 * float_epsilon * cancellation;
}

// What is lost where a lobe's exponential underflows: its peak times the smallest float.
double lost_to_underflow(const Mixture &m, smx_masking g, const Vec &wi, const Vec &wo) {
    const Vec h = oracle::half_vector(wi, wo);
    double peak = 0.0;
    for (const Lobe &l : m.lobes) {
        const oracle::Gaussian z = oracle::widened(m.x, l.alpha);
        peak += l.weight * oracle::p22(z, z.mean_x, z.mean_y);
    }
    const double masked = oracle::g2(test::masking(g), m, wi, wo) / (4.0 * oracle::plane(m.x, wo));
    return smallest_float * peak / std::pow(h.z, 4.0) * masked + floor_tolerance;
}

// The worst pair of a batch, by error in units of what is allowed.
struct Worst {
    double ratio = 0.0, got = 0.0, wanted = 0.0, allowed = 0.0;
    Vec wi, wo;

    void see(double value, double truth, double bound, const Vec &i, const Vec &o) {
        const double r = std::isfinite(value) ? std::abs(value - truth) / bound : HUGE_VAL;
        if (r > ratio) *this = {r, value, truth, bound, i, o};
    }
};

std::ostream &operator<<(std::ostream &out, const Worst &w) {
    return out << std::setprecision(9) << "wi (" << w.wi.x << ", " << w.wi.y << ", " << w.wi.z << "), wo (" << w.wo.x
               << ", " << w.wo.y << ", " << w.wo.z << ")\n  got " << w.got << ", wanted " << w.wanted << ", error "
               << w.got - w.wanted << ", allowed " << w.allowed;
}

bool above(const oracle::Gaussian &x, const Vec &k) { return k.z > 0.0 && oracle::plane(x, k) > 0.0; }

// The true value of a pair and how far from it float32 may be, per channel.
struct Truth {
    test::Colour value{}, bound{};
};

Truth truth_of(const std::vector<Part> &parts, smx_masking g, const Vec &wi, const Vec &wo) {
    Truth t;
    t.bound.fill(smallest_float);
    for (const Part &part : parts) {
        if (!above(part.mixture.x, wi) || !above(part.mixture.x, wo)) continue;
        const double value = oracle::fcos(part.mixture, test::masking(g), wi, wo);
        const double bound = value * allowed_error(part.mixture, wi, wo) + lost_to_underflow(part.mixture, g, wi, wo);
        for (std::size_t c = 0; c < 3; ++c) {
            t.value[c] += part.fresnel[c] * value;
            t.bound[c] += part.fresnel[c] * bound;
        }
    }
    return t;
}

Worst compare(const std::vector<Part> &parts, smx_masking g, const Directions &d, const std::vector<float> &fcos) {
    Worst worst;
    for (std::size_t k = 0; k < d.count(); ++k) {
        const Vec wi = Directions::at(d.wi, k), wo = Directions::at(d.wo, k);
        const Truth truth = truth_of(parts, g, wi, wo);
        for (std::size_t c = 0; c < 3; ++c) worst.see(fcos[3 * k + c], truth.value[c], truth.bound[c], wi, wo);
    }
    return worst;
}

void expect_oracle(const Directions &d) {
    for (const Case &c : cases())
        for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
            for (const smx_masking g : {SMX_G2_CORRELATED, SMX_G2_SEPARABLE}) {
                const Worst worst = compare(parts_of(c, model), g, d, eval(material_of(c, model), c.x, g, d));
                EXPECT_LE(worst.ratio, 1.0) << c.name << (model == SMX_MODEL_SHARED ? ", shared" : ", per lobe")
                                            << (g == SMX_G2_SEPARABLE ? ", separable: " : ", correlated: ") << worst;
            }
}

} // namespace

TEST(Eval, RandomDirections) { expect_oracle(random_directions()); }
TEST(Eval, MirrorDirections) { expect_oracle(mirror_directions()); }
TEST(Eval, HardDirections) { expect_oracle(hard_directions()); }

// The comparison sees a wrong masking, an alpha 0.1 % off, swapped axes and a wrong model.
TEST(Eval, ComparisonSeesWrongAnswers) {
    const Directions d = random_directions();
    const auto ratio = [&](const Case &wrong, smx_model wrong_model, smx_masking wrong_g, const Case &right) {
        const std::vector<float> fcos = eval(material_of(right, SMX_MODEL_SHARED), right.x, SMX_G2_CORRELATED, d);
        return compare(parts_of(wrong, wrong_model), wrong_g, d, fcos).ratio;
    };
    const Case &isotropic = cases()[5], &latitudinal = cases()[6], &longitudinal = cases()[7];
    EXPECT_GT(ratio(isotropic, SMX_MODEL_SHARED, SMX_G2_SEPARABLE, isotropic), 10.0);
    Case off = isotropic;
    off.x.alpha_x *= 1.001;
    EXPECT_GT(ratio(off, SMX_MODEL_SHARED, SMX_G2_CORRELATED, isotropic), 10.0);
    EXPECT_GT(ratio(longitudinal, SMX_MODEL_SHARED, SMX_G2_CORRELATED, latitudinal), 10.0);
    EXPECT_GT(ratio(latitudinal, SMX_MODEL_PER_LOBE, SMX_G2_CORRELATED, latitudinal), 10.0);
}

TEST(Eval, BelowTheSurfaceIsZero) {
    Directions d;
    const Vec up{0.0, 0.0, 1.0}, down{0.0, 0.0, -1.0}, edge{1.0, 0.0, 0.0}, under{0.8, 0.0, -0.6};
    for (const Vec &k : {down, edge, under}) {
        d.add(k, up);
        d.add(up, k);
        d.add(k, k);
    }
    const test::Material material = test::make_material({{1.0, 0.5}});
    for (const float v : eval(material, {0.3, 0.0, 0.0, 0.0, 0.0}, SMX_G2_CORRELATED, d)) EXPECT_EQ(v, 0.0f);
}

TEST(Eval, BehindTheMeanPlaneIsZero) {
    Directions d;
    d.add(oracle::spherical(1.2, 0.0), {0.0, 0.0, 1.0}); // tan 1.2 > 1 / 0.5
    d.add({0.0, 0.0, 1.0}, oracle::spherical(1.2, 0.0));
    const test::Material material = test::make_material({{1.0, 0.5}});
    for (const float v : eval(material, {0.3, 0.3, 0.0, 0.5, 0.0}, SMX_G2_CORRELATED, d)) EXPECT_EQ(v, 0.0f);
}

TEST(Eval, WritesExactlyItsResults) {
    const test::Material material = test::make_material({{1.0, 0.5}});
    const smx_displacement x{0.1, 0.1, 0.0, 0.0, 0.0};
    test::Random random(9);
    for (const std::size_t count : {std::size_t{1}, std::size_t{7}, std::size_t{93}, std::size_t{257 * 89}}) {
        Directions d;
        for (std::size_t k = 0; k < count; ++k) d.add(random.direction(0.1), random.direction(0.1));
        constexpr float canary = -12345.0f;
        std::vector<float> fcos(3 * count + 64, canary);
        ASSERT_SMX_OK(smx_material_eval(test::context(), material, &x, SMX_G2_CORRELATED, nullptr, count, d.wi.data(),
                                        d.wo.data(), fcos.data()));
        for (std::size_t k = 0; k < fcos.size(); ++k)
            ASSERT_EQ(fcos[k] == canary, k >= 3 * count) << k << " of " << count;
    }
}
