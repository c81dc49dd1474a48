// One way to make an image of the sphere, of those that lib/choose_configuration.h chooses from, and what it costs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "material.h"
#include "render.h"

namespace smx {

struct Configuration {
    std::optional<std::size_t> material; // filtered, by this one; none: the reference
    int widening_order = 0;              // of filtered shading
    Sampler sampler = Sampler::Mis;      // of the reference
    std::uint32_t spp = 0;               // of the reference
    double seconds = 0.0;                // on the device, as predicted
    double error = 0.0;                  // relRMSE of the image, as predicted

    bool is_reference() const { return !material; }
};

// Seconds on the device for which the constants were measured (choice_constants.h). Another one's differ by a factor
// that is much the same for all configurations.
double filtered_seconds(const Material &material, const Scene &scene, int widening_order);
double reference_seconds(const Scene &scene, Sampler sampler, std::uint64_t spp);

// The same for some pairs of directions.
double filtered_pairs_seconds(const Material &material, const Displacement &displacement, int widening_order,
                              std::size_t pairs);
double reference_pairs_seconds(const Displacement &displacement, Sampler sampler, std::uint64_t spp, std::size_t pairs);

// All that are chosen from, cheapest first: every material by some orders of widening, and unless `reference` is
// false every sampler by powers of two of samples. Where X is smooth, one order and one sample are exact.
std::vector<Configuration> configurations(const std::vector<const Material *> &materials, bool reference,
                                          const Scene &scene);

// "per-lobe, 8 lobes, widening order 3", "reference, mis, 1024 samples per pixel".
std::string description(const Configuration &configuration, const std::vector<const Material *> &materials);

} // namespace smx
