// {"schema", "material", "source", the settings, "device", "fit", "image", "report"}; image and fit as in sheet.json.
#include "sheet_record.h"

#include <nlohmann/json.hpp>

#include "digest.h"
#include "folder_lock.h"
#include "journal.h"
#include "sheet_entry.h"
#include "sheet_painter.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int schema_version = 1;

Json document_of(const SheetJob &job, const smx_brdf_info &material, const SheetRecord &record) {
    const SheetFit *fit = record.fit ? &*record.fit : nullptr;
    Json document = {{"schema", schema_version}, {"material", material.name}, {"source", material.source}};
    document.update(sheet_settings(job, material));
    document["device"] = record.device;
    document["fit"] = fit ? fit_json(*fit) : Json();
    document["image"] = image_json(record.entry, fit);
    document["report"] = report_json(record.entry.report);
    return document;
}

SheetFit fit_of(const Json &json) {
    SheetFit fit = {};
    fit.model = parse_choice(json.at("model").get<std::string>(), models);
    json.at("lobes").get_to(fit.lobes);
    json.at("fitted_lobes").get_to(fit.fitted_lobes);
    json.at("log_likelihood").get_to(fit.log_likelihood);
    json.at("residual").get_to(fit.residual);
    json.at("seconds").get_to(fit.seconds);
    const Json &sha256 = json.at("material_sha256");
    if (!sha256.is_null()) sha256.get_to(fit.material_sha256);
    return fit;
}

SheetRecord record_of(const Json &document, const SheetJob &job, const SheetImage &image) {
    SheetRecord record = {{image, job.image_file(image.id), report_of(document.at("report")),
                           document.at("image").at("sha256").get<std::string>()},
                          std::nullopt,
                          document.at("device").get<std::string>()};
    if (image.role == Role::filtered) record.fit = fit_of(document.at("fit"));
    return record;
}

[[noreturn]] void refuse(const fs::path &file, const SheetImage &image, const std::string &reason) {
    throw CommandError(file.string() + ": " + reason + "; render it with --only " + to_string(image.id));
}

bool is_there(const SheetJob &job, const SheetImage &image, const smx_brdf_info &material) {
    try {
        read_record(job, image, material);
        return true;
    } catch (const CommandError &) {
        return false;
    }
}

} // namespace

void write_record(const SheetJob &job, const smx_brdf_info &material, SheetRecord record, const Image &image) {
    StagedFiles files;
    const fs::path rendered = files.write(
        record.entry.file, [&](const fs::path &file) { check(smx_image_write_exr(image.get(), file.c_str())); });
    record.entry.sha256 = sha256_of_file(rendered);
    const std::string text = document_of(job, material, record).dump(2, ' ', false, Json::error_handler_t::replace);
    files.write(job.record_file(record.entry.image.id), [&](const fs::path &file) { write_text(file, text + '\n'); });
    if (sha256_of_file(record.entry.file) != record.entry.sha256)
        for (const char *name : {"sheet.json", "sheet.png"}) remove_file(job.file(name));
    files.commit();
}

SheetRecord read_record(const SheetJob &job, const SheetImage &image, const smx_brdf_info &material) {
    const fs::path file = job.record_file(image.id);
    std::error_code ignored;
    if (!fs::exists(file, ignored)) refuse(file, image, "it is not there");
    std::ifstream stream(file, std::ios::binary);
    const Json document = Json::parse(stream, nullptr, false);
    if (!document.is_object()) refuse(file, image, "it is damaged, no JSON object");
    const std::string difference = Journal::difference(document, sheet_settings(job, material));
    if (!difference.empty()) refuse(file, image, difference);
    SheetRecord record;
    try {
        record = record_of(document, job, image);
    } catch (const std::exception &error) { // of JSON, or of a word that is not one of ours
        refuse(file, image, std::string("it is damaged, ") + error.what());
    }
    if (sha256_of_file(record.entry.file) != record.entry.sha256)
        refuse(file, image, record.entry.file.filename().string() + " is not the image that it describes");
    return record;
}

std::vector<SheetRecord> render_records(const SheetJob &job, const SheetPlan &plan) {
    const FolderLock lock(job.out, FolderLock::Mode::beside_others);
    const std::vector<SheetImage> images = plan.images(job.only);
    SheetPainter painter(job, plan, images);
    const smx_brdf_info material = painter.material();

    std::vector<SheetImage> missing;
    for (const SheetImage &image : images)
        if (job.resume && is_there(job, image, material))
            painter.skip(image);
        else
            missing.push_back(image);

    painter.prepare(missing);
    for (const SheetImage &image : missing) {
        const Rendering rendering = painter.paint(image);
        SheetRecord record = {{image, job.image_file(image.id), rendering.report}, {}, painter.device().name};
        if (image.role == Role::filtered) record.fit = painter.fits().fit_of(image);
        write_record(job, material, record, rendering.image);
    }

    std::vector<SheetRecord> records;
    for (const SheetImage &image : images) records.push_back(read_record(job, image, material));
    return records;
}

} // namespace slopemix::cli
