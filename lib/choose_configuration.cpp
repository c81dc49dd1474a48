#include "choose_configuration.h"

#include <algorithm>
#include <cmath>

#include "error.h"
#include "shade_filtered.h"
#include "trials.h"

namespace smx {

namespace {

// What is taken for true has a third of the greatest error that is allowed: 5 % of what both have together.
constexpr double truth_share = 1.0 / 3.0;
constexpr std::uint32_t most_truth_spp = 1u << 19;

// Where there is no greatest error: so many times the samples that can be afforded, whose error is a third of theirs.
constexpr std::uint32_t truth_samples = 4;
constexpr double no_target = 1e-9;
constexpr std::uint32_t first_look_spp = 4096;

// The image's shape in closed form: of a material, or of the table's own mixture, without its colours.
Material shape_of(const std::optional<ChoiceTable> &table, const std::vector<const Material *> &materials,
                  const Scene &scene) {
    if (!table) return *materials.front();
    Material m;
    m.lobes = table->proposal(theta_d(scene));
    m.theta_d = uniform_knots(2);
    const std::vector<double> one = {1.0, 1.0};
    m.fresnel = {FresnelCurves{one, one, one}};
    return m;
}

PilotPixels pixels_for(Context &context, const std::optional<ChoiceTable> &table,
                       const std::vector<const Material *> &materials, const Scene &scene, const RenderOptions &options,
                       std::size_t wanted) {
    return pilot_pixels(scene, wanted, [&](const Scene &coarse) {
        const Material shape = shape_of(table, materials, scene);
        if (shape.lobes.empty()) return Image(coarse.width, coarse.height); // a black table
        RenderOptions closed = options;
        closed.widening_order = 0;
        return *shade_filtered(context, shape, coarse, closed, everything(shape, all_effects, coarse.masking)).image;
    });
}

// The walk through all configurations, cheapest first.
class Chooser {
  public:
    Chooser(std::vector<Configuration> all, Trials trials, const std::vector<const Material *> &materials)
        : all_(std::move(all)), trials_(std::move(trials)), materials_(materials) {}

    Choice cheapest_within(double max_error, bool has_table);
    Choice best_within(double max_seconds, bool has_table);

  private:
    Configuration tried(const Configuration &c);
    Configuration in_seconds_here(Configuration c) const;
    std::vector<Configuration> affordable(double max_seconds) const;
    void find_truth_beyond(double max_seconds);
    Choice finished(const Configuration &picked, const std::string &reason);
    std::optional<Configuration> better_than(const Configuration &picked);
    std::string told(const Configuration &c) const;

    std::vector<Configuration> all_; // seconds are the constants' device's
    Trials trials_;
    const std::vector<const Material *> &materials_;
    std::vector<Configuration> tried_;
};

Configuration Chooser::tried(const Configuration &c) {
    tried_.push_back(c);
    tried_.back().error = trials_.error(c);
    return tried_.back();
}

Configuration Chooser::in_seconds_here(Configuration c) const {
    c.seconds *= trials_.device_speed();
    return c;
}

std::string Chooser::told(const Configuration &c) const {
    return text(description(c, materials_), " (predicted: error ", c.error, ", ", in_seconds_here(c).seconds, " s)");
}

const Configuration &of_least_error(const std::vector<Configuration> &tried) {
    return *std::min_element(tried.begin(), tried.end(),
                             [](const Configuration &a, const Configuration &b) { return a.error < b.error; });
}

// The next one in cost that is known to be more accurate; references are not tried for it.
std::optional<Configuration> Chooser::better_than(const Configuration &picked) {
    for (Configuration c : all_) {
        if (c.seconds <= picked.seconds) continue;
        const std::optional<double> error = trials_.known_error(c);
        if (!error || *error >= picked.error) continue;
        c.error = *error;
        return c;
    }
    return std::nullopt;
}

Choice Chooser::finished(const Configuration &picked, const std::string &reason) {
    Choice choice;
    std::vector<Configuration> cheaper;
    std::copy_if(tried_.begin(), tried_.end(), std::back_inserter(cheaper),
                 [&](const Configuration &c) { return c.seconds < picked.seconds; });
    if (!cheaper.empty()) choice.cheaper = in_seconds_here(of_least_error(cheaper));
    if (const auto better = better_than(picked)) choice.better = in_seconds_here(*better);
    choice.picked = in_seconds_here(picked);
    for (const Configuration &c : tried_) choice.tried.push_back(in_seconds_here(c));
    choice.reason = text(told(picked), ", ", reason, " of ", tried_.size(), " tried");
    choice.pilot_pixels = trials_.pixels();
    choice.pilot_error = trials_.truth_error();
    choice.device_speed = trials_.device_speed();
    choice.cost.kernel_seconds = trials_.kernel_seconds();
    return choice;
}

Choice Chooser::cheapest_within(double max_error, bool has_table) {
    if (has_table) trials_.find_truth(truth_share * max_error, most_truth_spp);
    for (const Configuration &c : all_)
        if (!trials_.is_hopeless(c, max_error) && tried(c).error <= max_error)
            return finished(tried_.back(), text("the cheapest within an error of ", max_error));
    const Configuration &best = of_least_error(tried_);
    fail(Fault::NoSolution, "max_error is ", max_error, "; the least that can be reached is by ", told(best));
}

// Of a sampler, the most samples; of filtered shading, all.
std::vector<Configuration> worth_trying(const std::vector<Configuration> &affordable) {
    std::vector<Configuration> chosen;
    for (const Configuration &c : affordable) {
        const bool is_outdone = c.is_reference() && std::any_of(affordable.begin(), affordable.end(), [&](auto &other) {
                                    return other.is_reference() && other.sampler == c.sampler && other.spp > c.spp;
                                });
        if (!is_outdone) chosen.push_back(c);
    }
    return chosen;
}

std::vector<Configuration> Chooser::affordable(double max_seconds) const {
    std::vector<Configuration> within;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(within),
                 [&](const Configuration &c) { return in_seconds_here(c).seconds <= max_seconds; });
    return within;
}

// The truth has four times the samples of what can be afforded, which a first look at the device's speed tells.
void Chooser::find_truth_beyond(double max_seconds) {
    trials_.find_truth(no_target, first_look_spp);
    std::uint32_t spp = first_look_spp / truth_samples;
    for (const Configuration &c : affordable(max_seconds)) spp = std::max(spp, c.spp);
    trials_.find_truth(no_target, std::min(spp, most_truth_spp / truth_samples) * truth_samples);
}

Choice Chooser::best_within(double max_seconds, bool has_table) {
    if (has_table)
        find_truth_beyond(max_seconds);
    else
        trials_.error(all_.front()); // which tells the device's speed
    for (const Configuration &c : worth_trying(affordable(max_seconds))) tried(c);
    if (tried_.empty())
        fail(Fault::NoSolution, "max_seconds is ", max_seconds, "; the cheapest is ",
             description(all_.front(), materials_), ", predicted to take ", in_seconds_here(all_.front()).seconds,
             " s");
    return finished(of_least_error(tried_), text("the most accurate within ", max_seconds, " s"));
}

// What counts of an image's options. Nothing is left out of what is tried: the truth has all effects.
RenderOptions counted(const RenderOptions &of_image) {
    RenderOptions options;
    options.seed = of_image.seed;
    options.lookup = of_image.lookup;
    options.grade = of_image.grade;
    options.progress = of_image.progress;
    options.tiling = of_image.tiling;
    return options;
}

} // namespace

void validate(const ChoiceRequest &r) {
    require(r.max_error >= 0.0 && r.max_error <= 1.0, "max_error is ", r.max_error,
            "; it must be above 0 and at most 1, or 0 for none");
    require(r.max_seconds >= 0.0 && std::isfinite(r.max_seconds), "max_seconds is ", r.max_seconds,
            "; it must be above 0, or 0 for none");
    require((r.max_error > 0.0) != (r.max_seconds > 0.0), "max_error is ", r.max_error, " and max_seconds is ",
            r.max_seconds, "; one of them must be above 0, and only one");
    require(r.pilot_pixels >= 16 && r.pilot_pixels <= 65536, "pilot_pixels is ", r.pilot_pixels,
            "; it must be 16..65536");
}

Choice choose_configuration(Context &context, const std::optional<ChoiceTable> &table,
                            const std::vector<const Material *> &materials, const Scene &scene,
                            const RenderOptions &image_options, const ChoiceRequest &request) {
    validate(scene);
    require_directional(scene);
    const RenderOptions options = counted(image_options);
    validate(options.grade, context);
    validate(request);
    require(table || !materials.empty(), "there is neither a brdf nor a material to choose from");
    const CallTimer timer(context);
    PilotPixels pixels = pixels_for(context, table, materials, scene, options, request.pilot_pixels);
    std::vector<Configuration> all = configurations(materials, table.has_value(), scene);
    Choice choice;
    if (pixels.count() == 0) {
        choice.picked = all.front();
        choice.reason = text(description(choice.picked, materials), ": nothing is lit");
    } else {
        Trials trials(table, materials, scene, Pilot(context, scene, options, std::move(pixels)));
        Chooser chooser(std::move(all), std::move(trials), materials);
        choice = request.max_error > 0.0 ? chooser.cheapest_within(request.max_error, table.has_value())
                                         : chooser.best_within(request.max_seconds, table.has_value());
    }
    const double kernel_seconds = choice.cost.kernel_seconds;
    choice.cost = timer.finish(context, kernel_seconds, 0);
    return choice;
}

} // namespace smx
