// slopemix info: versions, platforms, devices.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "commands.h"
#include "handles.h"
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

// The device that commands without --device use.
std::optional<std::uint32_t> default_device() {
    smx_context context = nullptr;
    if (smx_context_create(nullptr, &context) != SMX_OK) return std::nullopt;
    return info_of(Context(context)).index;
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

void print_json(const std::vector<smx_device_info> &devices, std::optional<std::uint32_t> chosen) {
    Json document = {{"version", SMX_VERSION_STRING}, {"library_version", smx_version()}};
    document["platforms"] = platforms_json(devices);
    document["devices"] = Json::array();
    for (const smx_device_info &device : devices)
        document["devices"].push_back(to_json(device, chosen == device.index));
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

void print_text(const std::vector<smx_device_info> &devices, std::optional<std::uint32_t> chosen) {
    std::cout << "slopemix " << SMX_VERSION_STRING << ", library " << smx_version() << '\n';
    if (devices.empty()) std::cout << "no OpenCL device found\n";
    for (const smx_device_info &device : devices) print_device(device, chosen == device.index);
}

void run(bool json) {
    const std::vector<smx_device_info> devices = all_devices();
    (json ? print_json : print_text)(devices, default_device());
}

} // namespace

void add_info(CLI::App &app) {
    CLI::App *command = app.add_subcommand("info", "Show versions, OpenCL platforms and devices");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print JSON");
    command->callback([json] { run(*json); });
}

} // namespace slopemix::cli
