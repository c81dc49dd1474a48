#include "packed_material.h"

#include <array>
#include <cmath>
#include <numbers>

#include "lobe_weights.h"

namespace smx {

namespace {

// As in cl/packed.clh.
constexpr float packed_magic = 0x534d58, packed_version = 1;
constexpr std::size_t header_words = 16, lobe_words = 4;

float f(double value) { return static_cast<float>(value); }
float f(std::size_t value) { return static_cast<float>(value); }

// The device finds its place among equidistant knots without a search, exact to a float's rounding.
bool is_equidistant(const std::vector<double> &theta_d) {
    const std::vector<double> even = uniform_knots(theta_d.size());
    for (std::size_t k = 0; k < even.size(); ++k)
        if (std::abs(theta_d[k] - even[k]) > 1e-9) return false;
    return true;
}

struct Places {
    std::size_t lobes, knots, curves, end;

    explicit Places(const Material &m)
        : lobes(header_words),
          knots(lobes + lobe_words * m.lobes.size()),
          curves(knots + m.theta_d.size()),
          end(curves + 4 * m.fresnel.size() * m.theta_d.size()) {}
};

} // namespace

std::size_t packed_size(const Material &material) { return Places(material).end; }

std::vector<float> packed(const Material &m) {
    const Places at(m);
    std::vector<float> words = {packed_magic,
                                packed_version,
                                f(at.end),
                                m.model == Model::PerLobe ? 1.0f : 0.0f,
                                f(m.lobes.size()),
                                f(m.theta_d.size()),
                                is_equidistant(m.theta_d) ? 1.0f : 0.0f,
                                f(at.lobes),
                                f(at.knots),
                                f(at.curves)};
    words.resize(header_words);
    const auto model = lobe_weights(m, LobeWeight::Model), surface = lobe_weights(m, LobeWeight::Surface);
    const auto drawn = lobe_weights(m, LobeWeight::Drawn);
    for (std::size_t k = 0; k < m.lobes.size(); ++k)
        words.insert(words.end(), {f(m.lobes[k].alpha), f(model[k]), f(surface[k]), f(drawn[k])});
    for (const double angle : m.theta_d) words.push_back(f(angle / (std::numbers::pi / 2)));
    for (const FresnelCurves &curves : m.fresnel)
        for (std::size_t k = 0; k < m.theta_d.size(); ++k)
            words.insert(words.end(), {f(curves[0][k]), f(curves[1][k]), f(curves[2][k]), 0.0f});
    return words;
}

} // namespace smx
