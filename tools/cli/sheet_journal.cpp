#include "sheet_journal.h"

#include <map>

#include "digest.h"
#include "sheet_entry.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

using Json = Journal::Json;

Json totals_json(const SheetResult &result) {
    return {{"total_seconds", result.total_seconds}, {"build_seconds", result.build_seconds}};
}

void take_totals(const Json &totals, SheetResult &result) {
    totals.at("total_seconds").get_to(result.earlier_seconds);
    totals.at("build_seconds").get_to(result.earlier_build_seconds);
}

Json digests_of(const std::vector<std::string> &files) {
    Json digests = Json::array();
    for (const std::string &file : files) digests.push_back(sha256_of_file(file));
    return digests;
}

// Of a whole sheet: the device too, and the materials that it does not fit itself.
Json settings_of(const SheetJob &job, const SheetResult &result) {
    Json settings = sheet_settings(job, result.material);
    settings["device"] = result.device;
    settings["material_files"] = digests_of(job.fit_files);
    return settings;
}

// The same of a sheet.json.
Json material_files_in(const Json &document) {
    Json digests = Json::array();
    for (const Json &fit : document.value("fits", Json::array()))
        if (fit.is_object() && fit.value("material_sha256", Json()).is_string())
            digests.push_back(fit["material_sha256"]);
    return digests;
}

std::vector<fs::path> files_of(const SheetJob &job, const SheetPlan &plan) {
    std::vector<fs::path> files = {job.journal_file(), job.file("sheet.json"), job.file("sheet.png")};
    for (const SheetImage &image : plan.images({})) files.push_back(job.image_file(image.id));
    return files;
}

} // namespace

void SheetJournal::open(SheetResult &result) {
    lock_.emplace(job_.out);
    remove_leftovers(files_of(job_, plan_));
    const Json settings = settings_of(job_, result);
    journal_.emplace(job_.journal_file(), settings);
    switch (journal_->start(job_.resume, job_.file("sheet.json"), "sheet")) {
        case Journal::Start::resumed:
            return take_over(result);
        case Journal::Start::complete:
            return require_complete(settings);
        case Journal::Start::anew:
            return;
    }
}

void SheetJournal::take_over(SheetResult &result) {
    const Journal::Content content = journal_->read();
    take_totals(content.totals, result);
    for (const Json &item : content.items) {
        const SheetEntry entry = entry_of(item, job_, plan_);
        if (sha256_of_file(entry.file) != entry.sha256) {
            note(entry.file.string() + " is not the image that was finished: rendering it again");
            continue;
        }
        result.entries.push_back(entry);
        items_.push_back(item);
    }
    result.kept_images = result.entries.size();
}

void SheetJournal::require_complete(const Json &settings) {
    const fs::path file = job_.file("sheet.json");
    Json document = Journal::read_object(file);
    document["material_files"] = material_files_in(document);
    Journal::require_settings(file, document, settings);
    std::map<std::string, Json> digests;
    for (const Json &image : document.value("images", Json::array())) {
        if (!image.is_object() || !image.value("id", Json()).is_string())
            Journal::refuse(file, "it is damaged, an image has no id");
        digests[image["id"].get<std::string>()] = image.value("sha256", Json());
    }
    for (const SheetImage &image : plan_.images({})) {
        const std::string id = to_string(image.id);
        if (digests[id] != sha256_of_file(job_.image_file(image.id)))
            Journal::refuse(file, id + ".exr is not the image that it describes");
    }
    is_complete_ = true;
}

void SheetJournal::displace_earlier_sheet(const SheetResult &result) {
    if (has_begun_) return;
    journal_->write({items_, totals_json(result)});
    remove_file(job_.file("sheet.json"));
    remove_file(job_.file("sheet.png"));
    has_begun_ = true;
}

void SheetJournal::keep(SheetEntry entry, const Image &image, SheetResult &result) {
    StagedFiles files;
    const fs::path temporary =
        files.write(entry.file, [&](const fs::path &file) { check(smx_image_write_exr(image.get(), file.c_str())); });
    entry.sha256 = sha256_of_file(temporary);
    displace_earlier_sheet(result);
    files.commit();
    result.entries.push_back(entry);
    items_.push_back(item_of(entry));
    journal_->write({items_, totals_json(result)});
}

} // namespace slopemix::cli
