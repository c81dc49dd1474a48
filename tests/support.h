// What every test of the C API needs: handles that release themselves, checks that show the library's last error, and
// makers of the objects that the tests are about.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "oracle.h"
#include "oracle_table.h"
#include "slopemix.h"

// A call that must succeed; on failure shows its name, the status and the library's message.
#define EXPECT_SMX_OK(call) EXPECT_PRED_FORMAT1(test::succeeded, (call))
#define ASSERT_SMX_OK(call) ASSERT_PRED_FORMAT1(test::succeeded, (call))

// A call that must fail with this status and a message that holds `needle`, in any case.
#define EXPECT_SMX_FAILS(status, needle, call) EXPECT_PRED_FORMAT3(test::failed_with, (call), (status), (needle))

namespace test {

::testing::AssertionResult succeeded(const char *expression, smx_status status);
::testing::AssertionResult failed_with(const char *expression, const char *, const char *, smx_status got,
                                       smx_status wanted, const std::string &needle);

// An owned reference. `out()` is where a create function writes.
template <class T, void (*release)(T)>
class Handle {
  public:
    Handle() = default;
    Handle(Handle &&other) noexcept : value_(std::exchange(other.value_, nullptr)) {}
    Handle &operator=(Handle &&other) noexcept {
        std::swap(value_, other.value_);
        return *this;
    }
    ~Handle() { release(value_); }

    T *out() {
        release(std::exchange(value_, nullptr));
        return &value_;
    }
    T get() const { return value_; }
    operator T() const { return value_; } // NOLINT(google-explicit-constructor): stands for the handle in calls

  private:
    T value_ = nullptr;
};

using Context = Handle<smx_context, smx_context_release>;
using Brdf = Handle<smx_brdf, smx_brdf_release>;
using Density = Handle<smx_density, smx_density_release>;
using Material = Handle<smx_material, smx_material_release>;
using Image = Handle<smx_image, smx_image_release>;

// One context for a test executable: PoCL on the CPU, kernels kept between tests. Null, with a failure, without one.
smx_context context();

// Whether its device has the grade double.
bool has_double();

Brdf make_brdf(const oracle::Table &table, const char *name = "test");

// The library's table with its holes filled, for the oracle's lookups.
oracle::Table filled_table(smx_brdf brdf);

// Lobes under one Fresnel value per channel.
using Colour = std::array<double, 3>;
Material make_material(const std::vector<oracle::Lobe> &lobes, const Colour &fresnel = {1.0, 1.0, 1.0});

// Lobes with a Fresnel value each; their weights mean nothing.
Material make_per_lobe_material(const std::vector<oracle::Lobe> &lobes, const std::vector<Colour> &fresnel);

// Any material from arrays; fresnel: [sets][3][knots], equidistant.
Material make_material(smx_model model, const std::vector<oracle::Lobe> &lobes, const std::vector<double> &fresnel,
                       std::size_t knots);

smx_material_info info_of(smx_material material);
std::vector<smx_lobe> lobes_of(smx_material material);

struct Curves {
    std::vector<double> theta_d, fresnel; // [knots], [sets][3][knots]
};
Curves curves_of(smx_material material);

Density make_density(smx_brdf brdf, smx_masking_kernel kernel);
Material fit(smx_density density, uint32_t lobes, smx_model model = SMX_MODEL_SHARED);

oracle::Gaussian gaussian(const smx_displacement &x);
oracle::Masking masking(smx_masking g);

// A Beckmann table with Fresnel 1 for red, 0.5 for green, 0.25 for blue.
inline constexpr Colour channel_fresnel{1.0, 0.5, 0.25};
oracle::Table beckmann_table(const std::vector<oracle::Lobe> &lobes, oracle::Masking masking, int phi_d = 180);

// Pixels of an image: [row][column][rgba].
struct Pixels {
    uint32_t width = 0, height = 0;
    const float *rgba = nullptr;

    const float *at(uint32_t column, uint32_t row) const {
        return rgba + 4 * (static_cast<std::size_t>(row) * width + column);
    }
};
Pixels pixels(smx_image image);

smx_scene make_scene(uint32_t width, uint32_t height, double light_phi, const smx_displacement &x,
                     smx_masking masking = SMX_G2_CORRELATED);
// Of the grid.
smx_render_options make_options(uint32_t spp, uint64_t seed = 0, smx_lookup lookup = SMX_LOOKUP_LINEAR);

Image render_filtered(smx_material material, const smx_scene &scene, smx_context where = nullptr);
Image render_reference(smx_brdf brdf, const smx_scene &scene, const smx_render_options &options,
                       smx_context where = nullptr);

double relrmse(smx_image image, smx_image reference);

inline constexpr double radians(double degrees) { return degrees * oracle::pi / 180.0; }

} // namespace test
