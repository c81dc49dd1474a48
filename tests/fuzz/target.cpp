#include "target.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace fuzz {

void require(bool holds, const char *what) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: %s; last error: %s\n", what, smx_last_error());
    std::abort();
}

void require_ok(smx_status status, const char *what) { require(status == SMX_OK, what); }

MemoryFile::MemoryFile() : descriptor_(memfd_create("fuzz", 0)) {
    require(descriptor_ >= 0, "a file in memory");
    path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::~MemoryFile() { close(descriptor_); }

void MemoryFile::set(const void *bytes, std::size_t size) {
    resize(0);
    put(0, bytes, size);
}

void MemoryFile::resize(std::size_t size) {
    require(ftruncate(descriptor_, 0) == 0 && ftruncate(descriptor_, static_cast<off_t>(size)) == 0, "resizing");
}

void MemoryFile::put(std::size_t at, const void *bytes, std::size_t size) {
    require(pwrite(descriptor_, bytes, size, static_cast<off_t>(at)) == static_cast<ssize_t>(size), "writing");
}

std::string MemoryFile::content() const {
    std::string bytes(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    require(pread(descriptor_, bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()), "reading");
    return bytes;
}

} // namespace fuzz
