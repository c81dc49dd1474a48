// What a call allocates, against what its input declares.
#pragma once

#include <cstddef>

namespace fuzz {

// While it lives, the process ends with a reason in the allocation by which more than `bytes` are held beyond what was
// held before. One at a time.
class MemoryLimit {
  public:
    explicit MemoryLimit(std::size_t bytes);
    MemoryLimit(const MemoryLimit &) = delete;
    MemoryLimit &operator=(const MemoryLimit &) = delete;
    ~MemoryLimit();

    std::size_t most() const; // bytes held at once until now, beyond what was held before
};

// What a reader may hold, however short the file: buffers of streams, messages, tables of its own.
inline constexpr std::size_t always_legal = std::size_t{256} << 10;

} // namespace fuzz
