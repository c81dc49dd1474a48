// A fuzz target: a file fuzz_NAME.cpp that defines the two functions below. It is linked with replay.cpp, for a run of
// fixed length and seed under CTest, or with libFuzzer (tools/fuzz).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "slopemix.h"

namespace fuzz {

// Inputs to begin with, made by the project's own writers.
std::vector<std::string> seeds();

// Ends the process, with a reason, where this does not hold.
void require(bool holds, const char *what);

// A call that must succeed, for what was read or written before.
void require_ok(smx_status status, const char *what);

// A file in memory whose path can be read like any other's.
class MemoryFile {
  public:
    MemoryFile();
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;
    ~MemoryFile();

    const std::string &path() const { return path_; }
    void set(const void *bytes, std::size_t size); // the whole content
    void resize(std::size_t size);                 // 0 where nothing was written
    void put(std::size_t at, const void *bytes, std::size_t size);
    std::string content() const;

  private:
    int descriptor_;
    std::string path_;
};

// The outcome of a reader: a handle, or one of the statuses that its documentation has, with a message.
template <class Handle>
void require_outcome(smx_status status, Handle handle, const std::vector<smx_status> &legal) {
    require((status == SMX_OK) == (handle != nullptr), "a handle comes with success only");
    if (status == SMX_OK) return;
    bool is_legal = false;
    for (const smx_status one : legal) is_legal = is_legal || status == one;
    require(is_legal, smx_status_name(status));
    require(smx_last_error()[0] != '\0', "an error has a message");
}

} // namespace fuzz

// Calls what is fuzzed; any fault is a crash. Returns 0.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
