#include "live_handles.h"

#include <array>
#include <mutex>
#include <new>
#include <unordered_set>
#include <utility>

namespace smx {

namespace {

struct Registry {
    std::mutex mutex;
    std::unordered_set<const void *> live;
    std::array<void *, handles_aside> aside{}; // a ring
    std::size_t next = 0;
};

// Never destroyed: a program may release handles as it ends.
Registry &registry() {
    static Registry &only = *new Registry;
    return only;
}

} // namespace

void add_live_handle(const void *handle) {
    Registry &r = registry();
    const std::lock_guard lock(r.mutex);
    r.live.insert(handle);
}

void remove_live_handle(const void *handle) noexcept {
    Registry &r = registry();
    const std::lock_guard lock(r.mutex);
    r.live.erase(handle);
}

bool is_live_handle(const void *handle) noexcept {
    Registry &r = registry();
    const std::lock_guard lock(r.mutex);
    return r.live.contains(handle);
}

void free_later(void *memory) noexcept {
    Registry &r = registry();
    {
        const std::lock_guard lock(r.mutex);
        std::swap(r.aside[r.next], memory);
        r.next = (r.next + 1) % handles_aside;
    }
    ::operator delete(memory);
}

} // namespace smx
