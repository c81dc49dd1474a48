#include "atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "error.h"

namespace smx {

namespace fs = std::filesystem;

namespace {

// Unique among the threads and processes that write to one folder.
std::string temporary_name(const std::string &path) {
    static std::atomic<unsigned> counter{0};
    return text(path, ".part-", getpid(), "-", counter++);
}

struct Removal {
    std::string path;
    ~Removal() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
};

} // namespace

void write_atomically(const std::string &path, const std::function<void(const std::string &)> &write) {
    std::error_code status;
    if (fs::is_directory(path, status)) fail(Fault::CannotWrite, "cannot write ", path, ": it is a folder");

    Removal temporary{temporary_name(path)};
    try {
        write(temporary.path);
    } catch (const Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &e) {
        fail(Fault::CannotWrite, "cannot write ", path, ": ", e.what());
    }
    fs::rename(temporary.path, path, status);
    if (status) fail(Fault::CannotWrite, "cannot write ", path, ": ", status.message());
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
