// One run at a time in a folder, or several that do not disturb each other. The lock goes with its process, however
// that ends.
#pragma once

#include <filesystem>

namespace slopemix::cli {

class FolderLock {
  public:
    enum class Mode { alone, beside_others };

    // Makes the folder if it is missing. Throws CommandError where another process has it, alone or where this one
    // wants to be alone. A file system without locks is not locked.
    explicit FolderLock(const std::filesystem::path &folder, Mode mode = Mode::alone);
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    int descriptor_;
};

} // namespace slopemix::cli
