// Owners of the C API's handles, and its statuses as exceptions.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "slopemix.h"

namespace slopemix::cli {

// A command cannot do what it was asked to; what() is the sentence for the user.
class CommandError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Cancelled : public CommandError {
  public:
    Cancelled() : CommandError("cancelled") {}
};

inline void check(smx_status status) {
    if (status == SMX_OK) return;
    if (status == SMX_CANCELLED) throw Cancelled();
    const std::string message = smx_last_error();
    throw CommandError(message.empty() ? smx_status_text(status) : message);
}

template <auto release>
struct Release {
    void operator()(auto *handle) const noexcept { release(handle); }
};

using Context = std::unique_ptr<smx_context_s, Release<smx_context_release>>;
using Brdf = std::unique_ptr<smx_brdf_s, Release<smx_brdf_release>>;
using Density = std::unique_ptr<smx_density_s, Release<smx_density_release>>;
using Material = std::unique_ptr<smx_material_s, Release<smx_material_release>>;
using Evaluator = std::unique_ptr<smx_evaluator_s, Release<smx_evaluator_release>>;
using Image = std::unique_ptr<smx_image_s, Release<smx_image_release>>;

// Calls a function of the API whose last argument receives a new handle.
template <class Owner>
Owner acquire(auto create, auto... arguments) {
    typename Owner::pointer handle = nullptr;
    check(create(arguments..., &handle));
    return Owner(handle);
}

inline smx_device_info info_of(const Context &context) {
    smx_device_info info = SMX_DEVICE_INFO_INIT;
    check(smx_context_get_info(context.get(), &info));
    return info;
}

inline smx_brdf_info info_of(const Brdf &brdf) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    check(smx_brdf_get_info(brdf.get(), &info));
    return info;
}

inline smx_density_info info_of(const Density &density) {
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    check(smx_density_get_info(density.get(), &info));
    return info;
}

inline smx_material_info info_of(const Material &material) {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    check(smx_material_get_info(material.get(), &info));
    return info;
}

inline std::vector<smx_lobe> lobes_of(const Material &material) {
    std::vector<smx_lobe> lobes(info_of(material).lobes);
    check(smx_material_get_lobes(material.get(), lobes.data(), lobes.size()));
    return lobes;
}

inline smx_fit_report report_of(const Material &material) {
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    check(smx_material_get_report(material.get(), &report));
    return report;
}

} // namespace slopemix::cli
