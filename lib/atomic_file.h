// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace smx {

// For a file that is written over a while, under a temporary name until commit(); without that the temporary goes, and
// the path is as it was. All throw CannotWrite.
class AtomicFile {
  public:
    explicit AtomicFile(std::string path);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    // Calls action(temporary).
    void write(const std::function<void(const std::string &temporary)> &action);
    void commit();

  private:
    std::string path_;
    std::filesystem::path temporary_; // a path, so that removing it allocates nothing
};

// Calls write(temporary) and renames the result to `path`. Whatever fails, `path` is as it was and the temporary is
// gone. Throws CannotWrite.
void write_atomically(const std::string &path, const std::function<void(const std::string &temporary)> &write);

// The same for bytes at hand.
void write_atomically(const std::string &path, std::string_view bytes);

} // namespace smx
