// {"format", "version", "settings", "totals", "items", "sha256"}, the last one of the document without it.
#include "journal.h"

#include <fstream>
#include <iostream>
#include <utility>

#include "digest.h"
#include "handles.h"
#include "output.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char *format_name = "slopemix-journal";
constexpr unsigned format_version = 1;

std::string text_of(const Journal::Json &document) {
    return document.dump(1, ' ', false, Journal::Json::error_handler_t::replace) + '\n';
}

} // namespace

void note(const std::string &sentence) { std::cerr << "slopemix: " << sentence << '\n'; }

Journal::Journal(fs::path file, Json settings) : file_(std::move(file)), settings_(std::move(settings)) {}

bool Journal::exists() const {
    std::error_code ignored;
    return fs::exists(file_, ignored);
}

Journal::Start Journal::start(bool resume, const fs::path &finished, const std::string &work) const {
    std::error_code ignored;
    if (resume && exists()) return Start::resumed;
    if (resume && fs::exists(finished, ignored)) return Start::complete;
    if (resume)
        note("nothing to resume in " + finished.parent_path().string() + ": beginning anew");
    else if (exists())
        note(file_.string() + " is of an interrupted " + work + ": beginning anew, without --resume");
    return Start::anew;
}

void Journal::refuse(const fs::path &file, const std::string &reason) {
    throw CommandError("cannot resume from " + file.string() + ": " + reason + "; without --resume all begins anew");
}

Journal::Json Journal::read_object(const fs::path &file) {
    std::ifstream stream(file, std::ios::binary);
    Json document = Json::parse(stream, nullptr, false);
    if (!document.is_object()) refuse(file, "it is damaged, no JSON object");
    return document;
}

std::string Journal::difference(const Json &object, const Json &settings) {
    for (const auto &[name, wanted] : settings.items()) {
        const Json found = object.value(name, Json());
        if (found != wanted)
            return "it was made with " + name + " = " + found.dump() + ", and this run has " + wanted.dump();
    }
    return "";
}

void Journal::require_settings(const fs::path &file, const Json &object, const Json &settings) {
    const std::string reason = difference(object, settings);
    if (!reason.empty()) refuse(file, reason);
}

Journal::Content Journal::read() const {
    Json document = read_object(file_);
    const Json digest = document.value("sha256", Json());
    document.erase("sha256");
    if (document.value("format", Json()) != format_name || document.value("version", Json()) != format_version)
        refuse(file_, std::string("it is no ") + format_name + " of version " + std::to_string(format_version));
    if (digest != sha256_of(text_of(document))) refuse(file_, "it is damaged, its sha256 is another");
    require_settings(file_, document.at("settings"), settings_);
    return {document.at("items"), document.at("totals")};
}

void Journal::write(const Content &content) const {
    Json document = {{"format", format_name},
                     {"version", format_version},
                     {"settings", settings_},
                     {"totals", content.totals},
                     {"items", content.items}};
    document["sha256"] = sha256_of(text_of(document));
    StagedFiles files;
    files.write(file_, [&](const fs::path &temporary) { write_text(temporary, text_of(document)); });
    files.commit();
}

void Journal::remove() const { remove_file(file_); }

} // namespace slopemix::cli
