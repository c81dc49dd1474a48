// What the runs of a command left in a folder, without what differs from run to run: times.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

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

// Fields of a line of a CSV, as they are written: a comma between quotes is not one that parts them.
inline std::vector<std::string> fields_of(const std::string &line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        quoted ^= c == '"';
        if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

// Without the columns whose heading says that they are times. A line of another length than the heading stays whole.
inline std::string csv_without_times(const std::string &csv) {
    std::istringstream in(csv);
    std::vector<std::string> heading;
    std::string left;
    for (std::string line; std::getline(in, line); left += '\n') {
        const std::vector<std::string> fields = fields_of(line);
        if (heading.empty()) heading = fields;
        for (std::size_t k = 0; k < fields.size(); ++k)
            if (fields.size() != heading.size() || !heading[k].ends_with("seconds")) left += fields[k] + ',';
    }
    return left;
}

// What a sweep measured but for times, and what follows from them: the Pareto set and the number of runs.
inline nlohmann::json errors_of_sweep(const nlohmann::json &document) {
    nlohmann::json points = without_times(document.at("points"));
    for (nlohmann::json &point : points)
        for (const char *key : {"runs", "ns_per_evaluation", "pareto"}) point.erase(key);
    return points;
}

// Every file by its name: JSON and CSV without times, and the bytes of all others. Of a sweep's files
// only tradeoff.json is told: the others show times.
inline std::map<std::string, std::string> results_in(const TempDir &dir) {
    std::map<std::string, std::string> results;
    for (const std::string &name : dir.names()) {
        if (name == "tradeoff.csv" || name == "tradeoff.svg") continue;
        const std::string bytes = read_file(dir / name);
        results[name] = name == "tradeoff.json"   ? errors_of_sweep(nlohmann::json::parse(bytes)).dump()
                        : name.ends_with(".json") ? without_times(nlohmann::json::parse(bytes)).dump()
                        : name.ends_with(".csv")  ? csv_without_times(bytes)
                                                  : bytes;
    }
    return results;
}

} // namespace test
