// slopemix info: versions, platforms, devices, and how long kernels take to compile.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "commands.h"
#include "handles.h"
#include "renderings.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

std::vector<smx_device_info> all_devices() {
    std::uint32_t count = 0;
    check(smx_device_count(&count));
    std::vector<smx_device_info> devices(count, smx_device_info SMX_DEVICE_INFO_INIT);
    for (std::uint32_t index = 0; index < count; ++index) check(smx_device_get_info(index, &devices[index]));
    return devices;
}

// The device that commands without --device use, and what a small image costs there.
struct DefaultDevice {
    std::uint32_t index;
    double build_seconds, run_seconds; // compiling the filtered shading's kernel, or loading it; all else
};

Material smooth_metal() {
    const smx_lobe lobe = {1.0, 0.1};
    const double fresnel[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.lobes = &lobe;
    desc.lobe_count = 1;
    desc.knots = 2;
    desc.fresnel = fresnel;
    return acquire<Material>(smx_material_create, &desc);
}

std::optional<DefaultDevice> default_device() {
    smx_context handle = nullptr;
    if (smx_context_create(nullptr, &handle) != SMX_OK) return std::nullopt;
    const Context context(handle);
    const smx_scene scene = SMX_SCENE_INIT;
    const smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    const smx_render_report report = render_filtered(context, smooth_metal(), scene, options).report;
    return DefaultDevice{info_of(context).index, report.build_seconds, report.seconds - report.build_seconds};
}

Json to_json(const smx_device_info &device, bool is_default) {
    return {{"index", device.index},
            {"default", is_default},
            {"name", device.name},
            {"vendor", device.vendor},
            {"version", device.version},
            {"driver", device.driver},
            {"platform", device.platform},
            {"compute_units", device.compute_units},
            {"global_memory", device.global_memory},
            {"vector_width", device.vector_width}};
}

// Devices come platform by platform; two platforms that share a name differ in nothing that could be shown.
Json platforms_json(const std::vector<smx_device_info> &devices) {
    Json platforms = Json::array();
    for (const smx_device_info &device : devices) {
        Json platform = {{"name", device.platform}, {"version", device.platform_version}};
        if (platforms.empty() || platforms.back() != platform) platforms.push_back(std::move(platform));
    }
    return platforms;
}

void print_json(const std::vector<smx_device_info> &devices, const std::optional<DefaultDevice> &chosen) {
    Json document = {{"version", SMX_VERSION_STRING}, {"library_version", smx_version()}};
    document["platforms"] = platforms_json(devices);
    document["devices"] = Json::array();
    for (const smx_device_info &device : devices)
        document["devices"].push_back(to_json(device, chosen && chosen->index == device.index));
    document["build_seconds"] = chosen ? Json(chosen->build_seconds) : Json();
    document["run_seconds"] = chosen ? Json(chosen->run_seconds) : Json();
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_device(const smx_device_info &device, bool is_default) {
    std::cout << "\ndevice " << device.index << (is_default ? " (default)" : "") << '\n';
    print_facts(std::cout, {{"  name", device.name},
                            {"  vendor", device.vendor},
                            {"  version", device.version},
                            {"  driver", device.driver},
                            {"  platform", device.platform + std::string(", ") + device.platform_version},
                            {"  compute units", std::to_string(device.compute_units)},
                            {"  memory", std::to_string(device.global_memory >> 20) + " MiB"},
                            {"  vector width", std::to_string(device.vector_width)}});
}

void print_text(const std::vector<smx_device_info> &devices, const std::optional<DefaultDevice> &chosen) {
    std::cout << "slopemix " << SMX_VERSION_STRING << ", library " << smx_version() << '\n';
    if (devices.empty()) std::cout << "no OpenCL device found\n";
    for (const smx_device_info &device : devices) print_device(device, chosen && chosen->index == device.index);
    if (!chosen) return;
    std::cout << "\na filtered image of 128 x 128 on the default device\n";
    print_facts(std::cout, {{"  compiling kernels", fixed(chosen->build_seconds, 3) + " s"},
                            {"  all else", fixed(chosen->run_seconds, 3) + " s"}});
}

void run(bool json) {
    const std::vector<smx_device_info> devices = all_devices();
    (json ? print_json : print_text)(devices, default_device());
}

} // namespace

void add_info(CLI::App &app) {
    CLI::App *command =
        app.add_subcommand("info", "Show versions, OpenCL platforms and devices, and the time that compiling takes");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print JSON");
    command->callback([json] { run(*json); });
}

} // namespace slopemix::cli
