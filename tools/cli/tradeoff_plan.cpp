#include "tradeoff_plan.h"

#include <algorithm>

#include "flags.h"
#include "geometric_flags.h"

namespace slopemix::cli {

namespace {

constexpr std::uint32_t realisations = GeometricFlags{}.realisations; // the fewest samples of that reference
constexpr std::uint32_t geometric_most = 1024; // each costs it a hundred times what a sampler's does
constexpr std::uint32_t variant_samples = 4096, variant_lobes = 8;

bool any(Method, const SweepAxes &) { return true; }
bool filters(Method method, const SweepAxes &) { return is_filtered(method); }
bool own_curves(Method method, const SweepAxes &) { return method == Method::per_lobe; }
bool anisotropic_surfaces(Method, const SweepAxes &axes) { return axes.anisotropic; }
bool devices_with_double(Method, const SweepAxes &axes) { return axes.has_double; }

template <smx_effect effect>
void without(Method method, smx_scene &, smx_render_options &options) {
    constexpr std::uint32_t surface = SMX_EFFECT_MASKING | SMX_EFFECT_SHADOWING | SMX_EFFECT_HEIGHT_CORRELATION |
                                      SMX_EFFECT_ANISOTROPY | SMX_EFFECT_MEAN_SLOPE;
    constexpr std::uint32_t material = SMX_EFFECT_FRESNEL | SMX_EFFECT_LOBE_COLOR; // the table's, of references
    const std::uint32_t all = is_filtered(method) ? surface | material : surface;
    options.effects = all & ~std::uint32_t{effect};
}

// The surfaces of a sweep have no mean slope that could be left out.
constexpr Variant all_variants[] = {
    {"", any, [](Method, smx_scene &, smx_render_options &) {}},
    {"fast", any, [](Method, smx_scene &, smx_render_options &options) { options.grade = SMX_GRADE_FAST; }},
    {"double", devices_with_double,
     [](Method, smx_scene &, smx_render_options &options) { options.grade = SMX_GRADE_DOUBLE; }},
    {"separable", any, [](Method, smx_scene &scene, smx_render_options &) { scene.masking = SMX_G2_SEPARABLE; }},
    {"no-masking", any, without<SMX_EFFECT_MASKING>},
    {"no-shadowing", any, without<SMX_EFFECT_SHADOWING>},
    {"no-fresnel", filters, without<SMX_EFFECT_FRESNEL>},
    {"no-lobe-color", own_curves, without<SMX_EFFECT_LOBE_COLOR>},
    {"no-anisotropy", anisotropic_surfaces, without<SMX_EFFECT_ANISOTROPY>},
    {"effects-auto", filters,
     [](Method, smx_scene &, smx_render_options &options) { options.effects = SMX_EFFECTS_AUTO; }},
};

std::vector<Configuration> samplings(Method method, std::uint32_t most) {
    std::vector<Configuration> points;
    const bool is_geometric = method == Method::geometric;
    if (is_geometric) most = std::min(most, geometric_most);
    for (std::uint64_t samples = is_geometric ? realisations : 1; samples <= most; samples *= 4) {
        const std::uint64_t taken = method == Method::mis ? std::max<std::uint64_t>(samples, 2) : samples;
        if (taken <= most) points.push_back({method, static_cast<std::uint32_t>(taken)});
    }
    return points;
}

std::vector<Configuration> filterings(Method method, const SweepAxes &axes) {
    std::vector<Configuration> points;
    for (const std::int32_t order : axes.orders)
        for (const std::uint32_t lobes : axes.lobes) points.push_back({method, 0, lobes, order});
    return points;
}

// The configuration of the last of these methods that is swept, `size` being what is to be as large as `limit` lets it.
std::optional<Configuration> largest(const std::vector<Configuration> &points, bool (*is_wanted)(Method),
                                     std::uint32_t Configuration::*size, std::uint32_t limit) {
    std::optional<Configuration> best;
    for (const Configuration &point : points) {
        if (!is_wanted(point.method) || point.*size > limit) continue;
        if (!best || point.method > best->method || (point.method == best->method && point.*size > (*best).*size))
            best = point;
    }
    return best;
}

} // namespace

std::optional<Configuration> chosen_filter(const std::vector<Configuration> &plan) {
    return largest(plan, is_filtered, &Configuration::lobes, variant_lobes);
}

std::optional<Configuration> chosen_reference(const std::vector<Configuration> &plan) {
    return largest(plan, is_sampler, &Configuration::samples, variant_samples);
}

std::span<const Variant> variants() { return all_variants; }

std::string name_of(const Configuration &configuration) {
    std::string name = word_for(configuration.method, methods);
    if (is_filtered(configuration.method))
        name += " N=" + std::to_string(configuration.lobes) + " order " + widening_text(configuration.order);
    else
        name += ' ' + std::to_string(configuration.samples);
    if (!configuration.is_as_is()) name += std::string(" ") + variants()[configuration.variant].word;
    return name;
}

std::vector<Configuration> plan_of(const SweepAxes &axes) {
    std::vector<Configuration> points;
    for (const Method method : axes.methods) {
        const std::vector<Configuration> some =
            is_filtered(method) ? filterings(method, axes) : samplings(method, axes.samples);
        points.insert(points.end(), some.begin(), some.end());
    }
    for (const std::optional<Configuration> &base : {chosen_reference(points), chosen_filter(points)})
        for (std::size_t variant = 1; base && variant < variants().size(); ++variant) {
            if (!variants()[variant].is_of(base->method, axes)) continue;
            points.push_back(*base);
            points.back().variant = variant;
        }
    return points;
}

} // namespace slopemix::cli
