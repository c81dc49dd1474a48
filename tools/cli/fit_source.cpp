#include "fit_source.h"

namespace slopemix::cli {

FitSource::FitSource(const std::string &input, const FitFlags &flags)
    : input_(input), flags_(fit_flags_for(input, flags)) {
    if (is_density(input))
        density_ = open_density(input);
    else
        brdf_ = open_brdf(input);
}

std::string FitSource::sha256() const { return brdf_ ? info_of(brdf_).sha256 : info_of(density_).sha256; }

const Density &FitSource::density() {
    if (!density_) density_ = invert(brdf_);
    return density_;
}

const Material &FitSource::other_model() {
    FitFlags flags = flags_;
    flags.model = flags.model == SMX_MODEL_SHARED ? SMX_MODEL_PER_LOBE : SMX_MODEL_SHARED;
    if (!other_model_) other_model_ = fit(density(), flags);
    return other_model_;
}

} // namespace slopemix::cli
