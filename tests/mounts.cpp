#include "mounts.h"

#include <sched.h>
#include <sys/mount.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace test {
namespace {

void mount_tmpfs(const std::string &folder, std::size_t bytes, unsigned long flags) {
    const std::string options = "size=" + std::to_string(bytes);
    if (mount("tmpfs", folder.c_str(), "tmpfs", flags, options.c_str()) != 0)
        throw std::runtime_error("cannot mount on " + folder + ": " + std::strerror(errno));
}

} // namespace

bool can_mount() {
    static const bool can = unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0;
    return can;
}

SmallDisk::SmallDisk(std::string folder, std::size_t bytes) : folder_(std::move(folder)), bytes_(bytes) {
    mount_tmpfs(folder_, bytes, 0);
}

SmallDisk::~SmallDisk() { umount2(folder_.c_str(), MNT_DETACH); }

void SmallDisk::resize(std::size_t bytes) {
    bytes_ = bytes;
    mount_tmpfs(folder_, bytes, MS_REMOUNT);
}

void SmallDisk::make_read_only() { mount_tmpfs(folder_, bytes_, MS_REMOUNT | MS_RDONLY); }

} // namespace test
