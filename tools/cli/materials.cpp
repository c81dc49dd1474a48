// slopemix materials: the catalogue of the MERL database, and which of its tables a folder has.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "handles.h"
#include "merl_catalogue.h"
#include "text.h"

namespace slopemix::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *table_ending = ".binary";

struct MaterialsJob {
    std::string folder; // empty: none was named
    bool json = false;
};

struct Row {
    std::optional<int> number; // of the document; none: a table that the catalogue does not have
    std::string name, kind;
    bool listed;
    std::optional<bool> present; // in the folder
};

std::vector<std::string> tables_in(const std::string &folder) {
    std::error_code error;
    fs::directory_iterator files(folder, error);
    if (error) throw CommandError("cannot read the folder '" + folder + "': " + error.message());
    std::vector<std::string> names;
    for (const fs::directory_entry &file : files)
        if (file.path().extension() == table_ending && file.is_regular_file(error))
            names.push_back(file.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<Row> rows_of(const MaterialsJob &job) {
    std::vector<Row> rows;
    for (const MerlMaterial &material : merl_catalogue())
        rows.push_back({material.number, material.name, material.kind, material.listed, std::nullopt});
    if (job.folder.empty()) return rows;

    const std::vector<std::string> tables = tables_in(job.folder);
    for (Row &row : rows) row.present = std::binary_search(tables.begin(), tables.end(), row.name);
    for (const std::string &name : tables)
        if (std::none_of(rows.begin(), rows.end(), [&](const Row &row) { return row.name == name; }))
            rows.push_back({std::nullopt, name, "other", false, true});
    return rows;
}

void print_json(const std::vector<Row> &rows) {
    Json list = Json::array();
    for (const Row &row : rows)
        list.push_back({{"number", row.number ? Json(*row.number) : Json()},
                        {"name", row.name},
                        {"kind", row.kind},
                        {"listed", row.listed},
                        {"file", row.name + table_ending},
                        {"present", row.present ? Json(*row.present) : Json()}});
    std::cout << list.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const std::vector<Row> &rows, bool with_tables) {
    std::vector<TextRow> lines{{"number", "name", "kind", "in the document"}};
    if (with_tables) lines[0].push_back("table");
    for (const Row &row : rows) {
        lines.push_back(
            {row.number ? std::to_string(*row.number) : "-", row.name, row.kind, row.listed ? "yes" : "no"});
        if (with_tables) lines.back().push_back(*row.present ? "here" : "missing");
    }
    print_table(std::cout, lines);
}

void run(const MaterialsJob &job) {
    const std::vector<Row> rows = rows_of(job);
    if (job.json)
        print_json(rows);
    else
        print_text(rows, !job.folder.empty());
}

} // namespace

void add_materials(CLI::App &app) {
    CLI::App *command = app.add_subcommand("materials", "List the 100 MERL materials as the document numbers them");
    const auto job = std::make_shared<MaterialsJob>();
    command->add_option("DIR", job->folder, "Say also which of their tables, NAME.binary, this folder has")
        ->type_name("");
    command->add_flag("--json", job->json, "Print JSON: a list of materials");
    command->footer(
        "The supplemental document prints 89 of them; its numbering leaves the others' places. A table of DIR that is\n"
        "none of theirs comes last, without a number. Kinds are ours, by the names.");
    command->callback([job] { run(*job); });
}

} // namespace slopemix::cli
