// Temporary names and renames.
#include "output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <regex>
#include <set>
#include <system_error>

#include "handles.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char *probe_name = "probe"; // of a file that tells whether a folder takes one

[[noreturn]] void refuse(const fs::path &file, const std::string &reason) {
    throw CommandError("cannot write " + file.string() + ": " + reason);
}

fs::path folder_of(const fs::path &file) { return fs::absolute(file).parent_path(); }

fs::path temporary_name(const fs::path &file) {
    std::string name = ".";
    name += file.filename().string() + '.' + std::to_string(getpid()) + ".tmp";
    return folder_of(file) / name;
}

std::string replace_all(std::string text, const std::string &from, const std::string &to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

fs::path nearest_existing(fs::path folder) {
    std::error_code ignored;
    while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    return folder;
}

} // namespace

void require_writable(const fs::path &file) {
    if (!file.has_filename()) refuse(file, "it names a folder");
    std::error_code ignored;
    if (fs::is_directory(file, ignored)) refuse(file, "it is a folder");
    const fs::path folder = nearest_existing(folder_of(file));
    if (!fs::is_directory(folder, ignored)) refuse(file, folder.string() + " is not a folder");

    const fs::path probe = temporary_name(folder / probe_name);
    const int descriptor = open(probe.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
    if (descriptor < 0) refuse(file, std::strerror(errno));
    close(descriptor);
    fs::remove(probe, ignored);
}

void make_folder_of(const fs::path &file) {
    std::error_code error;
    fs::create_directories(folder_of(file), error);
    if (error) refuse(file, error.message());
}

StagedFiles::~StagedFiles() {
    std::error_code ignored;
    for (const Staged &staged : files_) fs::remove(staged.temporary, ignored);
}

fs::path StagedFiles::write(const fs::path &file, const std::function<void(const fs::path &)> &write) {
    make_folder_of(file);
    fs::path temporary = temporary_name(file);
    files_.push_back({temporary, file});
    try {
        write(temporary);
    } catch (const Cancelled &) {
        throw;
    } catch (const CommandError &error) {
        throw CommandError(replace_all(error.what(), temporary.string(), file.string()));
    }
    return temporary;
}

void StagedFiles::commit() {
    for (const Staged &staged : files_) {
        std::error_code error;
        fs::rename(staged.temporary, staged.file, error);
        if (error) refuse(staged.file, error.message());
    }
    files_.clear();
}

void remove_leftovers(const std::vector<fs::path> &files) {
    std::set<std::string> names = {probe_name};
    for (const fs::path &file : files) names.insert(file.filename().string());
    const std::regex temporary(R"(\.(.+)\.\d+\.tmp(\..*)?)"); // the library's own temporary files end in more
    std::error_code ignored;
    std::vector<fs::path> leftovers;
    for (const fs::directory_entry &entry : fs::directory_iterator(folder_of(files.at(0)), ignored)) {
        const std::string name = entry.path().filename().string();
        std::smatch parts;
        if (std::regex_match(name, parts, temporary) && names.contains(parts[1])) leftovers.push_back(entry.path());
    }
    for (const fs::path &leftover : leftovers) fs::remove(leftover, ignored);
}

void remove_file(const fs::path &file) {
    std::error_code error;
    fs::remove(file, error);
    if (error) throw CommandError("cannot remove " + file.string() + ": " + error.message());
}

void write_text(const fs::path &file, const std::string &text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) refuse(file, std::strerror(errno));
}

} // namespace slopemix::cli
