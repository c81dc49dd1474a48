#include "trials.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "choice_constants.h"
#include "fit_error.h"
#include "widening.h"

namespace smx {

namespace {

// More would take the pilot longer than small images take; the error is extrapolated from there.
constexpr std::uint32_t most_tried_spp = 1u << 16;

std::size_t index_of(Sampler sampler) { return static_cast<std::size_t>(sampler); }

} // namespace

Trials::Trials(const std::optional<ChoiceTable> &table, const std::vector<const Material *> &materials,
               const Scene &scene, Pilot pilot)
    : table_(table), materials_(materials), scene_(scene), pilot_(std::move(pilot)) {}

const PilotValues &Trials::counted(const PilotValues &values) {
    kernel_seconds_ += values.kernel_seconds;
    return values;
}

void Trials::set_speed(const PilotValues &values) {
    if (values.kernel_seconds > 0.0) device_speed_ = values.kernel_seconds / values.modelled_seconds;
}

void Trials::find_truth(double target, std::uint32_t most_spp) {
    truth_ = counted(pilot_.truth(table_->brdf, table_->proposal, target, most_spp));
    truth_error_ = pilot_.standard_error(truth_);
    tried_ = {};
    set_speed(truth_);
}

double Trials::extrapolated(Sampler sampler, std::uint32_t spp) const {
    const Tried &tried = tried_[index_of(sampler)];
    const double finer = static_cast<double>(spp) / tried.spp;
    return tried.error * std::pow(finer, -choice::fall[index_of(sampler)]);
}

bool Trials::is_hopeless(const Configuration &c, double limit) const {
    const Tried &tried = tried_[index_of(c.sampler)];
    if (!c.is_reference() || tried.spp == 0 || c.spp <= tried.spp || c.spp > most_tried_spp) return false;
    const double steepest = rough_axes(scene_.displacement) == 1 ? choice::steepest_on_a_line : choice::steepest;
    return tried.error * std::pow(static_cast<double>(c.spp) / tried.spp, -steepest) > limit;
}

double Trials::error(const Configuration &c) { return c.is_reference() ? reference_error(c) : filtered_error(c); }

std::optional<double> Trials::known_error(const Configuration &c) {
    if (!c.is_reference()) return filtered_error(c);
    if (tried_[index_of(c.sampler)].spp == 0) return std::nullopt;
    return extrapolated(c.sampler, c.spp);
}

void Trials::try_reference(Sampler sampler, std::uint32_t spp) {
    Tried &tried = tried_[index_of(sampler)];
    const PilotValues values = counted(pilot_.reference(table_->brdf, table_->proposal, sampler, spp));
    const double off = pilot_.error(values, truth_);
    // The difference has the truth's error in it. Where that is most of it, it is a bound and no more.
    tried.is_finest = off < 1.2 * truth_error_;
    const double bound = tried.spp == 0 ? off : std::min(off, extrapolated(sampler, spp));
    tried.error = tried.is_finest ? bound : std::sqrt(off * off - truth_error_ * truth_error_);
    tried.spp = spp;
}

double Trials::reference_error(const Configuration &c) {
    const Tried &tried = tried_[index_of(c.sampler)];
    const std::uint32_t spp = std::min(c.spp, most_tried_spp);
    if (spp > tried.spp && !tried.is_finest) try_reference(c.sampler, spp);
    return extrapolated(c.sampler, c.spp);
}

// Of a material by the highest order, which stands for its widening without error.
const PilotValues &Trials::finest(std::size_t material) {
    const auto found = finest_.find(material);
    if (found != finest_.end()) return found->second;
    const PilotValues values = counted(pilot_.filtered(*materials_[material], max_widening_order));
    if (finest_.empty()) set_speed(values);
    return finest_.emplace(material, values).first->second;
}

double Trials::filtered_error(const Configuration &c) {
    const Material &material = *materials_[*c.material];
    const PilotValues values = counted(pilot_.filtered(material, c.widening_order));
    if (!table_) {
        const double widening = pilot_.error(values, finest(*c.material));
        return std::hypot(predicted_fit_error(material), widening);
    }
    const double off = pilot_.error(values, truth_);
    // An error below half the truth's own is not known to be less than that.
    const double noise2 = truth_error_ * truth_error_;
    return std::sqrt(std::max(off * off - noise2, 0.25 * noise2));
}

} // namespace smx
