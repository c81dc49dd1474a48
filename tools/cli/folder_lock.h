// One run at a time in a folder. The lock goes with its process, however that ends.
#pragma once

#include <filesystem>

namespace slopemix::cli {

class FolderLock {
  public:
    // Makes the folder if it is missing. Throws CommandError where another process has it. A file system without locks
    // is not locked.
    explicit FolderLock(const std::filesystem::path &folder);
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &operator=(const FolderLock &) = delete;

  private:
    int descriptor_;
};

} // namespace slopemix::cli
