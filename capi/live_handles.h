// The handles that are alive: a released one is told, not used. Their memory is kept aside for a while, so that its
// address does not come back at once as another handle's.
#pragma once

#include <cstddef>

namespace smx {

// Released handles of which the address is surely not another's yet.
constexpr std::size_t handles_aside = 256;

void add_live_handle(const void *handle); // throws std::bad_alloc
void remove_live_handle(const void *handle) noexcept;
bool is_live_handle(const void *handle) noexcept;

// Frees a handle's memory once as many as handles_aside others have come after it.
void free_later(void *memory) noexcept;

} // namespace smx
