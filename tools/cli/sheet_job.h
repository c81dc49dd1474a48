// What `slopemix sheet` is asked for and what comes out.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "flags.h"
#include "handles.h"
#include "output.h"
#include "sheet_plan.h"

namespace slopemix::cli {

struct SheetJob {
    std::string input, out;
    RenderFlags flags;
    std::vector<double> radii = {0.1, 0.25, 0.5};
    std::vector<std::uint32_t> lobes = {1, 8};
    bool with_per_lobe = false;
    std::vector<std::int32_t> widening_orders; // more columns of the per-lobe model
    std::vector<ImageId> only;
    bool resume = false;
    bool json = false;

    bool is_asked_for(std::int32_t order) const {
        return std::find(widening_orders.begin(), widening_orders.end(), order) != widening_orders.end();
    }
    bool has_auto_order() const { return is_asked_for(SMX_WIDENING_AUTO); }

    // Widening orders of the per-lobe columns, the closed form first.
    std::vector<std::int32_t> per_lobe_orders() const {
        std::vector<std::int32_t> orders = widening_orders;
        std::erase(orders, 0);
        if (with_per_lobe || is_asked_for(0)) orders.insert(orders.begin(), 0);
        return orders;
    }

    std::filesystem::path file(const std::string &name) const { return std::filesystem::path(out) / name; }
    std::filesystem::path journal_file() const { return file("sheet.partial.json"); }
    std::filesystem::path image_file(const ImageId &id) const { return file(to_string(id) + ".exr"); }
};

struct SheetEntry {
    SheetImage image;
    std::filesystem::path file;
    smx_render_report report;
    std::optional<smx_comparison> errors; // of filtered images
    double bright;                        // bright_value() of what sets its exposure: a filtered image's reference
    std::string sha256 = {};              // of the file
};

struct SheetFit {
    smx_model model;
    std::uint32_t lobes; // asked for
    smx_fit_report report;
};

struct SheetResult {
    smx_brdf_info material;
    std::string device;
    std::vector<SheetFit> fits;
    std::vector<SheetEntry> entries;
    double geometry_bright = 0.0;                            // largest 99th percentile of the geometry images
    std::array<double, light_degrees.size()> light_bright{}; // and of the references, light by light
    double reference_seconds = 0.0;                          // of references that were rendered
    std::uint64_t reference_samples = 0;
    std::size_t kept_images = 0; // of an interrupted run; its times are in the totals
    double earlier_seconds = 0.0, earlier_build_seconds = 0.0;
    double total_seconds = 0.0;
    double build_seconds = 0.0; // of these, compiling kernels

    double seconds_per_reference_sample() const {
        return reference_samples == 0 ? 0.0 : reference_seconds / static_cast<double>(reference_samples);
    }
};

class SheetJournal;

// Renders the plan's images, without those that the journal has. Where it has the whole sheet, nothing is done.
SheetResult render_sheet(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal);

// The contact sheet of what was rendered.
void draw_sheet(const SheetJob &job, const SheetPlan &plan, const SheetResult &result,
                const std::filesystem::path &file);

// What the images depend on: members of sheet.json, which a resumed run must have too.
nlohmann::ordered_json sheet_settings(const SheetJob &job, const SheetResult &result);

// sheet.json, and the summary on standard output.
std::string sheet_json(const SheetJob &job, const SheetResult &result);
void print_summary(const SheetJob &job, const SheetResult &result);

} // namespace slopemix::cli
