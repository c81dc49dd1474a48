// The one scheduler: an image's tiles in a queue, from which every device of a context takes the next one. What comes
// out does not depend on the tiling or on the devices, as long as a tile's result does not depend on its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "context.h"

namespace smx {

// Whole rows of an image, or of whatever else has rows.
struct Tile {
    std::uint32_t first_row, rows;
};

// How an image is cut. Zeros leave it to the library; tests ask for other tilings, which give the same bits.
struct Tiling {
    std::uint32_t rows = 0;       // of a tile
    std::uint32_t work_group = 0; // work-items of a work-group
    std::uint32_t facets = 0;     // of the reference, by a technique, that a launch adds at most
};

// Tiles of at most 2^18 items, enough to keep a device busy and few enough to bound its memory; several for each device
// where there is more than one.
std::vector<Tile> tiles_of(std::uint32_t rows, std::uint32_t row_items, std::size_t devices, const Tiling &tiling);

// Rows of the largest tile.
std::uint32_t most_rows(const std::vector<Tile> &tiles);

// Tells how much of a tile is done, 0..1. Throws when the work is to stop: let it pass.
using Step = std::function<void(double share)>;

// Does one tile and returns the seconds that the device took.
using TileWork = std::function<double(const Tile &, const Step &)>;

struct TileJob {
    std::vector<Tile> tiles;
    std::function<TileWork(Context &device)> start; // what a device does, made once for each in a thread of its own
    std::function<void(const Tile &)> take;         // finished tiles in their order, in the caller's thread
    std::function<bool(double share)> progress;     // in the caller's thread; true to stop. May be empty
    std::size_t ahead;                              // tiles that may be under way or wait to be taken
};

// Returns the seconds of the busiest device. Throws what the work threw, or Cancelled; the devices are idle then.
double run_tiles(Context &context, const TileJob &job);

} // namespace smx
