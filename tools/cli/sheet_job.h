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
    std::vector<std::string> fit_files;        // in place of fits: one for each, in the columns' order
    std::vector<ImageId> only;
    bool collect = false;
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
    std::filesystem::path record_file(const ImageId &id) const { return file(to_string(id) + ".json"); }
};

struct SheetEntry {
    SheetImage image;
    std::filesystem::path file;
    smx_render_report report;
    std::string sha256 = {};                   // of the file
    std::optional<smx_comparison> errors = {}; // of filtered images, once they are measured
};

struct SheetFit {
    smx_model model;
    std::uint32_t lobes;        // asked for
    std::uint32_t fitted_lobes; // as many or fewer
    double log_likelihood, residual, seconds;
    std::string material_sha256; // of the material file that it was read from; empty: it was made here
};

struct SheetResult {
    smx_brdf_info material;
    std::string device;
    std::vector<SheetFit> fits;
    std::vector<SheetEntry> entries;
    double geometry_bright = 0.0;                            // largest 99th percentile of the geometry images
    std::array<double, light_degrees.size()> light_bright{}; // and of the references, light by light
    std::size_t kept_images = 0; // rendered by other runs; what is known of their times is in the totals
    double earlier_seconds = 0.0, earlier_build_seconds = 0.0;
    double total_seconds = 0.0;
    double build_seconds = 0.0; // of these, compiling kernels

    double reference_seconds() const; // without compilation
    double seconds_per_reference_sample() const;
};

class SheetJournal;

// Renders all of the plan's images that the journal does not have. Where it has the whole sheet, nothing is done.
SheetResult render_sheet(const SheetJob &job, const SheetPlan &plan, SheetJournal &journal);

// The images that were rendered one by one (sheet_record.h), whose folder the caller has locked. Throws CommandError
// where one is missing, damaged or made with other settings, and names it.
SheetResult collect_sheet(const SheetJob &job, const SheetPlan &plan);

// Reads the images: the errors of the filtered ones, and what the exposures need.
void measure_sheet(const SheetJob &job, const SheetPlan &plan, SheetResult &result);

// The contact sheet of what was rendered.
void draw_sheet(const SheetJob &job, const SheetPlan &plan, const SheetResult &result,
                const std::filesystem::path &file);

// What an image depends on: members of sheet.json, which what is resumed or collected must have too.
nlohmann::ordered_json sheet_settings(const SheetJob &job, const smx_brdf_info &material);

// An image and a fit as they stand in sheet.json; the fit is that of a filtered image.
nlohmann::ordered_json image_json(const SheetEntry &entry, const SheetFit *fit);
nlohmann::ordered_json fit_json(const SheetFit &fit);

// sheet.json, and the summary on standard output.
std::string sheet_json(const SheetJob &job, const SheetResult &result);
void print_summary(const SheetJob &job, const SheetResult &result);

} // namespace slopemix::cli
