#include "effect_trial.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rough_surface.h"

namespace smx {

namespace {

// G2 / p_o, by the effects that are on (cl/masking.clh).
double g2_over_po(Effects on, double p_i, double p_o, double beyond_i, double beyond_o) {
    double seen = p_o;
    if (on & masking_effect) seen += beyond_o;
    if (on & shadowing_effect) seen += beyond_i * ((on & height_correlation_effect) ? p_o : seen) / p_i;
    return 1.0 / seen;
}

} // namespace

EffectTrial::EffectTrial(const Material &material, const Scene &scene, const Simulated &all)
    : material_(material),
      scene_(scene),
      all_(all),
      samples_(image_samples(material, scene)),
      value_(values(all)),
      value2_(mean_square(value_)) {}

double EffectTrial::mean_square(const std::vector<double> &values) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < samples_.size(); ++p)
        for (std::size_t c = 0; c < 3; ++c) sum += samples_[p].weight * values[3 * p + c] * values[3 * p + c];
    return sum;
}

EffectTrial::Parts EffectTrial::parts_on(const Displacement &x) const {
    const RoughSurface surface(x);
    const std::size_t pixels = samples_.size(), lobes = material_.lobes.size();
    Parts parts;
    for (auto *of_pixels : {&parts.p_i, &parts.p_o}) of_pixels->resize(pixels);
    for (auto *of_lobes : {&parts.ndf, &parts.beyond_i, &parts.beyond_o}) of_lobes->resize(pixels * lobes);
    for (std::size_t p = 0; p < pixels; ++p) {
        const auto &[wi, wo] = samples_[p].d;
        const double p_i = surface.mean_plane(wi), p_o = surface.mean_plane(wo);
        if (!(p_i > 0.0 && p_o > 0.0)) continue;
        parts.p_i[p] = p_i, parts.p_o[p] = p_o;
        const double h_z = wi[2] + wo[2], slope_x = -(wi[0] + wo[0]) / h_z, slope_y = -(wi[1] + wo[1]) / h_z;
        const double inv_cos2 = 1.0 + slope_x * slope_x + slope_y * slope_y;
        for (std::size_t k = 0; k < lobes; ++k) {
            const double alpha2 = material_.lobes[k].alpha * material_.lobes[k].alpha;
            parts.ndf[p * lobes + k] = surface.p22(alpha2, slope_x, slope_y) * inv_cos2 * inv_cos2;
            parts.beyond_i[p * lobes + k] = sigma_beyond_p(p_i, surface.s2(alpha2, wi));
            parts.beyond_o[p * lobes + k] = sigma_beyond_p(p_o, surface.s2(alpha2, wo));
        }
    }
    return parts;
}

const EffectTrial::Parts &EffectTrial::parts(Effects on) const {
    Parts &made = parts_[(on & anisotropy_effect ? 1 : 0) + (on & mean_slope_effect ? 2 : 0)];
    if (made.p_i.size() != samples_.size()) made = parts_on(simplified(scene_.displacement, on));
    return made;
}

std::vector<Rgb> EffectTrial::fresnel(Effects on) const {
    const double angle = on & fresnel_effect ? theta_d(scene_) : 0.0;
    std::vector<Rgb> values;
    for (const FresnelCurves &curves : material_.fresnel)
        values.push_back(fresnel_at(material_.theta_d, curves, angle));
    if (is_per_lobe(on)) return values;
    Rgb sum{};
    for (const Rgb &value : values)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += value[c];
    return {sum};
}

std::vector<double> EffectTrial::values(const Simulated &simulated) const {
    const Effects on = simulated.on;
    const std::vector<Rgb> fresnel = this->fresnel(on);
    const Parts &parts = this->parts(on);
    const std::size_t lobes = material_.lobes.size();
    const bool per_lobe = is_per_lobe(on);
    std::vector<double> values(3 * samples_.size());
    for (std::size_t p = 0; p < samples_.size(); ++p) {
        if (parts.p_i[p] == 0.0) continue;
        double ndf = 0.0, beyond_i = 0.0, beyond_o = 0.0; // of the shared model
        for (std::size_t k = 0; k < lobes; ++k) {
            if (!simulated.lobes[k]) continue;
            const std::size_t at = p * lobes + k;
            if (per_lobe) {
                const double value =
                    parts.ndf[at] * g2_over_po(on, parts.p_i[p], parts.p_o[p], parts.beyond_i[at], parts.beyond_o[at]);
                for (std::size_t c = 0; c < 3; ++c) values[3 * p + c] += fresnel[k][c] * value;
            } else {
                const double weight = material_.lobes[k].weight;
                ndf += weight * parts.ndf[at];
                beyond_i += weight * parts.beyond_i[at], beyond_o += weight * parts.beyond_o[at];
            }
        }
        if (per_lobe) continue;
        const double value = ndf * g2_over_po(on, parts.p_i[p], parts.p_o[p], beyond_i, beyond_o);
        for (std::size_t c = 0; c < 3; ++c) values[3 * p + c] = fresnel[0][c] * value;
    }
    return values;
}

double EffectTrial::error(const Simulated &simulated) const {
    std::vector<double> excess = values(simulated);
    for (std::size_t n = 0; n < excess.size(); ++n) excess[n] -= value_[n];
    return std::sqrt(mean_square(excess) / value2_);
}

std::vector<double> EffectTrial::lobe_shares() const {
    Simulated one = {all_.on, std::vector<bool>(material_.lobes.size(), false)};
    std::vector<double> shares;
    const RoughSurface surface(scene_.displacement);
    const double narrow = 2.0 * pixel_slope(scene_);
    for (std::size_t k = 0; k < material_.lobes.size(); ++k) {
        const double alpha2 = material_.lobes[k].alpha * material_.lobes[k].alpha;
        if (std::min(surface.var_1(alpha2), surface.var_2(alpha2)) < narrow * narrow) {
            shares.push_back(std::numeric_limits<double>::infinity());
            continue;
        }
        one.lobes[k] = true;
        shares.push_back(std::sqrt(mean_square(values(one)) / value2_));
        one.lobes[k] = false;
    }
    return shares;
}

double EffectTrial::largest_lambda(bool towards_light) const {
    const Parts &parts = this->parts(all_.on);
    const std::vector<double> &plane = towards_light ? parts.p_i : parts.p_o;
    const std::vector<double> &beyond = towards_light ? parts.beyond_i : parts.beyond_o;
    const std::size_t lobes = material_.lobes.size();
    double largest = 0.0;
    for (std::size_t p = 0; p < samples_.size(); ++p) {
        if (plane[p] == 0.0) continue;
        double sum = 0.0;
        for (std::size_t k = 0; k < lobes; ++k) sum += material_.lobes[k].weight * beyond[p * lobes + k];
        largest = std::max(largest, sum / plane[p]);
    }
    return largest;
}

double EffectTrial::lost_energy() const {
    constexpr std::size_t most_pixels = 16;
    const RoughSurface surface(scene_.displacement);
    const std::size_t step = std::max<std::size_t>(samples_.size() / most_pixels, 1);
    double sum = 0.0;
    int pixels = 0;
    for (std::size_t p = 0; p < samples_.size(); p += step, ++pixels)
        sum += smx::lost_energy(surface, samples_[p].d.wo);
    return pixels > 0 ? sum / pixels : 0.0;
}

} // namespace smx
