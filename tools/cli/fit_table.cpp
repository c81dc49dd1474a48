#include "fit_table.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "fit_row.h"
#include "handles.h"
#include "output.h"

namespace slopemix::cli {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char *format_name = "slopemix-fits";
constexpr unsigned format_version = 1;

[[noreturn]] void refuse(const fs::path &file, const std::string &reason) {
    throw CommandError("cannot read " + file.string() + ": " + reason +
                       "; mend it, or move it away to begin a new table");
}

std::string content_of(const fs::path &file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool is_cell(const Json &value) {
    const auto is_plain = [](const Json &v) { return v.is_string() || v.is_number() || v.is_null(); };
    return is_plain(value) || (value.is_array() && std::all_of(value.begin(), value.end(), is_plain));
}

// What is wrong with a row; empty: nothing.
std::string fault_of(const Json &row) {
    if (!row.is_object()) return "is no object";
    if (!row.contains("name") || !row["name"].is_string()) return "has no name";
    for (const auto &[key, value] : row.items())
        if (!is_cell(value)) return "holds no text, number, null or list of them under \"" + key + '"';
    return {};
}

void require_format(const fs::path &file, const Json &document) {
    if (!document.is_object() || document.value("format", Json()) != format_name)
        refuse(file, std::string("its format is not \"") + format_name + '"');
    if (const Json version = document.value("version", Json()); version != format_version)
        refuse(file, "its version is " + version.dump() + ", not " + std::to_string(format_version));
    if (!document.contains("materials") || !document["materials"].is_array())
        refuse(file, "it has no list of materials");
}

} // namespace

FitTable::FitTable(const fs::path &folder) : folder_(folder) {
    const fs::path file = json_in(folder);
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return;
    const Json document = Json::parse(content_of(file), nullptr, false);
    if (document.is_discarded()) refuse(file, "it is no JSON");
    require_format(file, document);
    for (const Json &row : document["materials"]) {
        const std::string place = "materials[" + std::to_string(rows_.size()) + "] ";
        if (const std::string fault = fault_of(row); !fault.empty()) refuse(file, place + fault);
        if (!rows_.emplace(row["name"].get<std::string>(), row).second)
            refuse(file, place + "has the name of another, " + row["name"].dump());
    }
}

const FitTable::Row *FitTable::find(const std::string &name) const {
    const auto found = rows_.find(name);
    return found == rows_.end() ? nullptr : &found->second;
}

void FitTable::put(const Row &row) { rows_[row["name"].get<std::string>()] = row; }

void FitTable::save() const {
    if (rows_.empty()) return;
    Json materials = Json::array();
    std::string csv = csv_heading();
    for (const auto &[name, row] : rows_) {
        materials.push_back(row);
        csv += csv_line(row);
    }
    const Json document = {{"format", format_name}, {"version", format_version}, {"materials", materials}};

    StagedFiles files;
    const auto stage = [&](const fs::path &file, const std::string &text) {
        if (content_of(file) != text)
            files.write(file, [&](const fs::path &temporary) { write_text(temporary, text); });
    };
    stage(json_in(folder_), document.dump(1, ' ') + '\n');
    stage(csv_in(folder_), csv);
    files.commit();
}

} // namespace slopemix::cli
