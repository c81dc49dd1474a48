#include "atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "error.h"

namespace smx {

namespace fs = std::filesystem;

namespace {

// Unique among the threads and processes that write to one folder.
std::string temporary_name(const std::string &path) {
    static std::atomic<unsigned> counter{0};
    return text(path, ".part-", getpid(), "-", counter++);
}

} // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), temporary_(temporary_name(path_)) {
    std::error_code status;
    if (fs::is_directory(path_, status)) fail(Fault::CannotWrite, "cannot write ", path_, ": it is a folder");
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
}

void AtomicFile::write(const std::function<void(const std::string &)> &action) {
    try {
        action(temporary_.string());
    } catch (const Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &e) {
        fail(Fault::CannotWrite, "cannot write ", path_, ": ", e.what());
    }
}

void AtomicFile::commit() {
    std::error_code status;
    fs::rename(temporary_, path_, status);
    if (status) fail(Fault::CannotWrite, "cannot write ", path_, ": ", status.message());
}

void write_atomically(const std::string &path, const std::function<void(const std::string &)> &write) {
    AtomicFile file(path);
    file.write(write);
    file.commit();
}

void write_atomically(const std::string &path, std::string_view bytes) {
    write_atomically(path, [&](const std::string &temporary) {
        errno = 0;
        std::ofstream out(temporary, std::ios::binary);
        out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out.close();
        if (!out) fail(Fault::CannotWrite, "cannot write ", path, ": ", std::strerror(errno ? errno : EIO));
    });
}

} // namespace smx
