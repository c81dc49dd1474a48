#include "device.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "error.h"

namespace smx {

namespace {

std::string lower(std::string s) {
    std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
    return s;
}

// Some drivers pad with blanks or count the terminator.
std::string trimmed(std::string s) {
    while (!s.empty() && (s.back() == '\0' || s.back() == ' ')) s.pop_back();
    return s.substr(std::min(s.find_first_not_of(' '), s.size()));
}

// Lanes per work-item: a GPU's work-items are lanes themselves; a CPU's hold its native float vector, of which the
// kernels know 4, 8 and 16.
std::uint32_t vector_width(const cl::Device &device) {
    if (!(device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU)) return 1;
    const auto native = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    return native >= 16 ? 16 : native >= 8 ? 8 : 4;
}

cl::Device root_of(const cl::Device &device) {
    const auto parent = device.getInfo<CL_DEVICE_PARENT_DEVICE>();
    return parent() ? root_of(parent) : device;
}

std::vector<cl::Device> parts_of(cl::Device device, std::uint32_t count) {
    const auto units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    require(count <= units, "sub_devices is ", count, "; it must be 0..", units, " on ",
            trimmed(device.getInfo<CL_DEVICE_NAME>()));
    const cl_device_partition_property equally[] = {CL_DEVICE_PARTITION_EQUALLY,
                                                    static_cast<cl_device_partition_property>(units / count), 0};
    std::vector<cl::Device> parts;
    device.createSubDevices(equally, &parts);
    parts.resize(count); // where the units do not divide, there is one too many
    return parts;
}

std::string list_of(const std::vector<cl::Device> &devices) {
    std::string list;
    for (std::size_t k = 0; k < devices.size(); ++k)
        list += text(k ? ", " : "", k, " \"", trimmed(devices[k].getInfo<CL_DEVICE_NAME>()), "\"");
    return list;
}

} // namespace

std::vector<cl::Device> all_devices() {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error &) {
        return {}; // the loader's way to say that there is no platform
    }
    std::vector<cl::Device> all;
    for (const cl::Platform &platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        } catch (const cl::Error &) {
            continue; // a platform without a device
        }
        all.insert(all.end(), devices.begin(), devices.end());
    }
    return all;
}

DeviceInfo device_info(const cl::Device &device) {
    DeviceInfo info;
    const std::vector<cl::Device> all = all_devices();
    const cl::Device root = root_of(device);
    const auto found = std::find_if(all.begin(), all.end(), [&](const cl::Device &d) { return d() == root(); });
    info.index = static_cast<std::uint32_t>(found - all.begin());
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.platform_version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.vector_width = vector_width(device);
    info.has_double = device.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
    info.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.shares_memory = device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
    return info;
}

cl::Device choose_device(const std::string &wanted) {
    const std::vector<cl::Device> devices = all_devices();
    if (devices.empty())
        fail(
            Fault::NoDevice,
            "no OpenCL device; install one for the CPU, such as the package pocl-opencl-icd (which shows none where it "
            "cannot write its cache, POCL_CACHE_DIR or ~/.cache/pocl)");
    if (wanted.empty()) {
        const auto cpu = std::find_if(devices.begin(), devices.end(), [](const cl::Device &d) {
            return (d.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
        });
        return cpu != devices.end() ? *cpu : devices.front();
    }
    std::size_t index = 0;
    const auto parsed = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
    if (parsed.ptr == wanted.data() + wanted.size()) {
        if (parsed.ec == std::errc() && index < devices.size()) return devices[index];
        fail(Fault::NoDevice, "no device ", wanted, "; there are ", list_of(devices));
    }
    for (const cl::Device &device : devices)
        if (lower(device.getInfo<CL_DEVICE_NAME>()).find(lower(wanted)) != std::string::npos) return device;
    fail(Fault::NoDevice, "no device whose name holds \"", wanted, "\"; there are ", list_of(devices));
}

std::vector<cl::Device> choose_devices(const std::string &wanted, std::uint32_t sub_devices) {
    std::vector<cl::Device> chosen;
    for (std::size_t at = 0; at <= wanted.size();) {
        const std::size_t end = std::min(wanted.find(',', at), wanted.size());
        require(end > at || wanted.empty(), "device is \"", wanted,
                "\"; between its commas there must be names or numbers");
        chosen.push_back(choose_device(wanted.substr(at, end - at)));
        at = end + 1;
    }
    if (sub_devices <= 1) return chosen;
    std::vector<cl::Device> parts;
    for (const cl::Device &device : chosen)
        for (const cl::Device &part : parts_of(device, sub_devices)) parts.push_back(part);
    return parts;
}

} // namespace smx
