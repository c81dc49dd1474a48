// The points of a sweep: which configurations of which methods are measured, and what each is called.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "parse.h"
#include "slopemix.h"

namespace slopemix::cli {

enum class Method { grid, sobol, mis, geometric, shared, per_lobe };

inline constexpr Choice<Method> methods[] = {{"grid", Method::grid},     {"sobol", Method::sobol},
                                             {"mis", Method::mis},       {"geometric", Method::geometric},
                                             {"shared", Method::shared}, {"per-lobe", Method::per_lobe}};

inline bool is_filtered(Method method) { return method == Method::shared || method == Method::per_lobe; }
inline bool is_sampler(Method method) { return !is_filtered(method) && method != Method::geometric; }
inline smx_model model_of(Method method) { return method == Method::shared ? SMX_MODEL_SHARED : SMX_MODEL_PER_LOBE; }

struct SweepAxes;

// A departure from the defaults, measured beside them.
struct Variant {
    const char *word;
    bool (*is_of)(Method method, const SweepAxes &axes); // whether it departs at all
    void (*apply)(Method method, smx_scene &scene, smx_render_options &options);
};

// The first one changes nothing, and its word is empty.
std::span<const Variant> variants();

struct Configuration {
    Method method;
    std::uint32_t samples = 0; // per pixel; of the references
    std::uint32_t lobes = 0;   // asked for; of the filter
    std::int32_t order = 0;    // of its widening
    std::size_t variant = 0;   // index into variants()

    bool is_as_is() const { return variant == 0; }
};

// "mis 4096", "per-lobe N=8 order 3", "mis 4096 double": no two of a plan are the same.
std::string name_of(const Configuration &configuration);

// What is swept; the lists in the order in which they are asked for.
struct SweepAxes {
    std::vector<Method> methods;
    std::uint32_t samples = 0; // the most per pixel
    std::vector<std::uint32_t> lobes;
    std::vector<std::int32_t> orders;
    bool anisotropic = false; // the surface
    bool has_double = true;   // the device
};

// The filter and the reference that variants are of: per-lobe before shared and mis before the other samplers, with the
// most lobes up to 8 and the most samples up to 4096 of those in the plan.
std::optional<Configuration> chosen_filter(const std::vector<Configuration> &plan);
std::optional<Configuration> chosen_reference(const std::vector<Configuration> &plan);

// The samplers at 1, 4, 16 ... samples, mis at 2 in place of 1, which it cannot take; the geometric reference at 16, 64
// ... 1024; the filter at all numbers of lobes and all orders; then the variants of one reference and of one filter.
std::vector<Configuration> plan_of(const SweepAxes &axes);

} // namespace slopemix::cli
