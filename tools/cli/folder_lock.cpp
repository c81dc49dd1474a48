#include "folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "handles.h"
#include "output.h"

namespace slopemix::cli {

FolderLock::FolderLock(const std::filesystem::path &folder, Mode mode) {
    make_folder_of(folder / "file");
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const int kind = mode == Mode::alone ? LOCK_EX : LOCK_SH;
    if (descriptor_ < 0 || flock(descriptor_, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    close(descriptor_);
    throw CommandError("another run is at work in " + folder.string());
}

FolderLock::~FolderLock() {
    if (descriptor_ >= 0) close(descriptor_);
}

} // namespace slopemix::cli
