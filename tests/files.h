// Files for tests: a folder that removes itself, whole-file reads and writes, and a disk that is "full".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace test {

class TempDir {
  public:
    TempDir();
    TempDir(const TempDir &) = delete;
    TempDir &operator=(const TempDir &) = delete;
    ~TempDir();

    std::string operator/(const std::string &name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }

    // Names of everything in the folder, sorted: shows leftovers.
    std::vector<std::string> names() const;

  private:
    std::filesystem::path path_;
};

void write_file(const std::string &path, const std::string &bytes);
std::string read_file(const std::string &path);
bool exists(const std::string &path);

// While it lives, this process cannot make a regular file longer than `bytes`: every longer write fails, for root too.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::size_t bytes);
    FileSizeLimit(const FileSizeLimit &) = delete;
    FileSizeLimit &operator=(const FileSizeLimit &) = delete;
    ~FileSizeLimit();

  private:
    std::size_t before_;
};

} // namespace test
