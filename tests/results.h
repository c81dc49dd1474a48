// What the runs of a command left in a folder, without what differs from run to run: times.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "files.h"

namespace test {

// Takes every time away, at any depth.
inline nlohmann::json without_times(nlohmann::json value) {
    if (value.is_object()) {
        for (const char *key : {"seconds", "check_seconds", "total_seconds", "build_seconds", "kernel_seconds",
                                "reference_seconds", "seconds_per_reference_sample", "kept_images"})
            value.erase(key);
        for (auto &[name, member] : value.items()) member = without_times(member);
    }
    if (value.is_array())
        for (nlohmann::json &element : value) element = without_times(element);
    return value;
}

// Every file by its name: JSON without times, of a CSV the names alone (its rows are those of a JSON file), and the
// bytes of all others.
inline std::map<std::string, std::string> results_in(const TempDir &dir) {
    std::map<std::string, std::string> results;
    for (const std::string &name : dir.names()) {
        const std::string bytes = read_file(dir / name);
        results[name] = name.ends_with(".json")  ? without_times(nlohmann::json::parse(bytes)).dump()
                        : name.ends_with(".csv") ? ""
                                                 : bytes;
    }
    return results;
}

} // namespace test
