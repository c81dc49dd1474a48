// The boundary between C and C++: handles, the one catch, and the checks of arguments that only C can get wrong.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "error.h"
#include "live_handles.h"
#include "slopemix.h"

namespace smx {

// The message of this thread's last failure.
void set_last_error(const char *message) noexcept;

// Runs the body of an API function and turns what it throws into a status and a message.
smx_status translate_exception() noexcept;

template <typename Body>
smx_status guarded(Body &&body) noexcept {
    try {
        body();
        return SMX_OK;
    } catch (...) {
        return translate_exception();
    }
}

inline void require_pointer(const void *pointer, const char *name) { require(pointer != nullptr, name, " is null"); }

// Options of the caller's, or the defaults for NULL. There is one size yet: the first version that adds a field takes
// the shorter struct too, and copies what it has over the defaults.
template <typename Options>
Options checked(const Options *options, const Options &defaults, const char *name) {
    if (!options) return defaults;
    require(options->size == sizeof(Options), name, "->size is ", options->size, "; it must be ", sizeof(Options),
            " (initialise with the macro)");
    return *options;
}

template <typename Struct>
void check_output(const Struct *output, const char *name) {
    require_pointer(output, name);
    require(output->size == sizeof(Struct), name, "->size is ", output->size, "; it must be ", sizeof(Struct),
            " (initialise with the macro)");
}

// Copies a text into a fixed field, cut to fit between characters of UTF-8.
template <std::size_t N>
void copy_text(char (&field)[N], const std::string &value) {
    std::size_t length = std::min(value.size(), N - 1);
    while (length < value.size() && length > 0 && (value[length] & 0xC0) == 0x80) --length;
    std::memcpy(field, value.data(), length);
    field[length] = '\0';
}

// What every handle is: a shared object with a count of the caller's references. Children hold the object itself, so a
// parent may be released first.
template <typename T>
struct Handle {
    explicit Handle(std::shared_ptr<T> shared) : object(std::move(shared)) { add_live_handle(this); }
    ~Handle() { remove_live_handle(this); }
    Handle(const Handle &) = delete;
    Handle &operator=(const Handle &) = delete;
    static void operator delete(void *memory) noexcept { free_later(memory); }

    std::atomic<unsigned> references{1};
    std::shared_ptr<T> object;
};

template <typename T>
void require_pointer(const Handle<T> *handle, const char *name) {
    require(handle != nullptr, name, " is null");
    require(is_live_handle(handle), name, " was released, or is no handle");
}

template <typename H>
smx_status retain(H *handle, const char *name) noexcept {
    return guarded([&] {
        require_pointer(handle, name);
        handle->references.fetch_add(1);
    });
}

// Does nothing with a handle that was released already.
template <typename H>
void release(H *handle) noexcept {
    if (handle && is_live_handle(handle) && handle->references.fetch_sub(1) == 1) delete handle;
}

} // namespace smx
