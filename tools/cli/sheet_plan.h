// The sheet's images: which there are, and what each shows. Three tables by the direction of the roughness, a row per
// radius r, and the columns: geometry, then for each light the reference and one filtered image of the shared model per
// number of lobes; then, for each widening order that is asked for, the per-lobe model with the last of these numbers,
// light by light.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "parse.h"
#include "slopemix.h"

namespace slopemix::cli {

inline constexpr std::uint32_t table_count = 3;
inline constexpr std::array<double, 3> light_degrees = {90.0, 0.0, -25.0};

enum class Role { geometry, reference, filtered };

struct SheetImage {
    ImageId id;
    Role role;
    double alpha_x, alpha_y;
    std::size_t light;   // index into light_degrees; not of geometry
    std::uint32_t lobes; // asked for; of filtered images only, as is the model
    smx_model model = SMX_MODEL_SHARED;
    std::int32_t widening_order = 0;

    bool has_light() const { return role != Role::geometry; }
};

class SheetPlan {
  public:
    SheetPlan(std::vector<double> radii, std::vector<std::uint32_t> lobes, std::vector<std::int32_t> orders);

    const std::vector<double> &radii() const { return radii_; }
    const std::vector<std::uint32_t> &lobes() const { return lobes_; }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(radii_.size()); }
    std::uint32_t columns() const { return shared_columns() + lights * static_cast<std::uint32_t>(orders_.size()); }
    const std::vector<std::int32_t> &per_lobe_orders() const { return orders_; }

    SheetImage image(ImageId id) const;

    // Table by table, row by row, column by column: all images, or `only` these, each once. Throws
    // std::invalid_argument for one that the sheet does not have.
    std::vector<SheetImage> images(const std::vector<ImageId> &only) const;

    // What a filtered image is compared with.
    SheetImage reference_of(const SheetImage &filtered) const;

  private:
    static constexpr auto lights = static_cast<std::uint32_t>(light_degrees.size());
    std::uint32_t shared_columns() const { return 1 + lights * per_light(); }
    std::uint32_t per_light() const { return 1 + static_cast<std::uint32_t>(lobes_.size()); }
    std::vector<ImageId> all() const;

    std::vector<double> radii_;
    std::vector<std::uint32_t> lobes_;
    std::vector<std::int32_t> orders_; // of the per-lobe columns
};

} // namespace slopemix::cli
