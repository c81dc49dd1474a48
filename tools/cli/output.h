// Output files that are whole or untouched.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace slopemix::cli {

// Throws CommandError if the file could not be made, without leaving anything behind: asked before long work.
void require_writable(const std::filesystem::path &file);

// Makes the folder that is to hold the file.
void make_folder_of(const std::filesystem::path &file);

// Files that appear together: each is written under a temporary name beside its own, and commit() renames all of them.
// What was not committed is removed.
class StagedFiles {
  public:
    StagedFiles() = default;
    ~StagedFiles();
    StagedFiles(const StagedFiles &) = delete;
    StagedFiles &operator=(const StagedFiles &) = delete;

    // Calls write(temporary) with the temporary name of `file`, and returns that name. The folder is made if it is
    // missing. A CommandError comes out with the file's own name in place of the temporary one.
    std::filesystem::path write(const std::filesystem::path &file,
                                const std::function<void(const std::filesystem::path &)> &write);
    void commit();

  private:
    struct Staged {
        std::filesystem::path temporary, file;
    };
    std::vector<Staged> files_;
};

// Removes what killed processes left of these files, all of one folder. Only where no other process writes them.
void remove_leftovers(const std::vector<std::filesystem::path> &files);

// Throws CommandError; a file that is not there is no error.
void remove_file(const std::filesystem::path &file);

void write_text(const std::filesystem::path &file, const std::string &text);

} // namespace slopemix::cli
