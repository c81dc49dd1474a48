// Where finished tiles go: an image in memory, or an EXR file that is written as they come, which keeps memory bounded.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "image.h"
#include "tile_queue.h"

namespace smx {

using Attributes = std::map<std::string, std::string>;

// A tile's rows: [rows][width][4]. `errors` is null where standard errors are not kept.
struct TileRows {
    float *rgba, *errors;
};

class Canvas {
  public:
    virtual ~Canvas() = default;

    // Starts the image, anew where one was begun.
    virtual void begin(const Attributes &attributes) = 0;

    // Where a tile's rows belong; any thread may ask, once for a tile.
    virtual TileRows rows(const Tile &tile) = 0;

    // The tile is complete; tiles come in their order.
    virtual void take(const Tile &tile) = 0;

    // The image is complete. A file keeps the attributes that it was begun with, and gives no image.
    virtual std::optional<Image> finish(const Attributes &attributes) = 0;

    // Tiles that may wait to be taken.
    virtual std::size_t ahead(std::size_t devices) const = 0;
};

// In memory for an empty path.
std::unique_ptr<Canvas> make_canvas(std::uint32_t width, std::uint32_t height, bool with_errors,
                                    const std::string &exr_path);

} // namespace smx
