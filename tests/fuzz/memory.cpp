// Allocations are counted by the sanitizer's hooks where there is one, and else in operator new, which stands in for
// all of the process. There what OpenEXR and C libraries take by malloc is not seen.
#include "memory.h"

#include <malloc.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "target.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FUZZ_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define FUZZ_SANITIZED 1
#endif
#endif

namespace {

constexpr std::int64_t none = INT64_MAX;

std::atomic<std::int64_t> held{0}, before{0}, most_held{0}, limit{none};

void count(std::size_t size) {
    const std::int64_t now = held += static_cast<std::int64_t>(size);
    for (std::int64_t most = most_held; now > most && !most_held.compare_exchange_weak(most, now);) {
    }
    if (now - before <= limit) return;
    limit = none; // the message allocates
    fuzz::require(false, "an input took more memory than what it declares allows");
}

void discount(std::size_t size) { held -= static_cast<std::int64_t>(size); }

} // namespace

namespace fuzz {

MemoryLimit::MemoryLimit(std::size_t bytes) {
    before = most_held = held.load();
    limit = static_cast<std::int64_t>(bytes);
}

MemoryLimit::~MemoryLimit() { limit = none; }

std::size_t MemoryLimit::most() const { return static_cast<std::size_t>(most_held - before); }

} // namespace fuzz

#ifdef FUZZ_SANITIZED

#include <sanitizer/allocator_interface.h>

namespace {

void on_malloc(const volatile void *, std::size_t size) { count(size); }
void on_free(const volatile void *memory) {
    if (memory) discount(__sanitizer_get_allocated_size(const_cast<const void *>(memory)));
}

[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);

} // namespace

#else

namespace {

void *allocate(std::size_t size, std::size_t alignment) {
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    void *memory = whole < size ? nullptr : std::aligned_alloc(alignment, whole ? whole : alignment);
    if (memory) count(malloc_usable_size(memory));
    return memory;
}

void *allocate_or_throw(std::size_t size, std::size_t alignment) {
    void *memory = allocate(size, alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}

void deallocate(void *memory) {
    discount(malloc_usable_size(memory));
    std::free(memory);
}

constexpr std::size_t plain = alignof(std::max_align_t);

} // namespace

#pragma GCC visibility push(default)
void *operator new(std::size_t size) { return allocate_or_throw(size, plain); }
void *operator new[](std::size_t size) { return allocate_or_throw(size, plain); }
void *operator new(std::size_t size, std::align_val_t align) { return allocate_or_throw(size, std::size_t(align)); }
void *operator new[](std::size_t size, std::align_val_t align) { return allocate_or_throw(size, std::size_t(align)); }
void *operator new(std::size_t size, const std::nothrow_t &) noexcept { return allocate(size, plain); }
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept { return allocate(size, plain); }
void operator delete(void *memory) noexcept { deallocate(memory); }
void operator delete[](void *memory) noexcept { deallocate(memory); }
void operator delete(void *memory, std::size_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::size_t) noexcept { deallocate(memory); }
void operator delete(void *memory, std::align_val_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::align_val_t) noexcept { deallocate(memory); }
void operator delete(void *memory, std::size_t, std::align_val_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::size_t, std::align_val_t) noexcept { deallocate(memory); }
#pragma GCC visibility pop

#endif
