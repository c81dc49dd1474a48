// smx_image_read_exr: an image that is read is written, and reads back to the same bits.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "files.h"
#include "memory.h"
#include "target.h"

namespace {

// Of the file's length, for attributes and tables of offsets; and what the tables of a compression take.
constexpr std::size_t length_factor = 100, codec_bytes = std::size_t{1} << 20;

const test::TempDir &folder() {
    static const test::TempDir dir;
    return dir;
}

smx_image read_again(const std::string &path) {
    smx_image image = nullptr;
    fuzz::require_ok(smx_image_read_exr(path.c_str(), &image), "reading what was written");
    return image;
}

std::size_t values_of(smx_image image) {
    uint32_t width = 0, height = 0;
    fuzz::require_ok(smx_image_get_size(image, &width, &height), "a size");
    return std::size_t{4} * width * height;
}

void require_same(const float *a, const float *b, std::size_t count) {
    fuzz::require((a == nullptr) == (b == nullptr), "both have these values, or none");
    fuzz::require(!a || std::memcmp(a, b, count * sizeof(float)) == 0, "the same bits");
}

// Calls take(number...) for the numbers after each attribute of this name and type.
template <std::size_t count>
void for_each(std::string_view file, std::string_view attribute, auto take) {
    for (std::size_t at = 0; (at = file.find(attribute, at)) != std::string_view::npos;) {
        at += attribute.size();
        std::array<std::int32_t, count> numbers{};
        if (file.size() - at < sizeof numbers) return;
        std::memcpy(numbers.data(), file.data() + at, sizeof numbers);
        take(numbers);
    }
}

// Of the largest window or tile that a header declares: four floats of values and four of errors per pixel, and no
// fewer rows than the largest block of a compression has.
std::size_t declared_bytes(std::string_view file) {
    using namespace std::string_view_literals;
    constexpr double pixel = 32.0, block = 256.0, most = 1e15;
    double bytes = 0.0;
    for_each<4>(file, "dataWindow\0box2i\0\x10\0\0\0"sv, [&](const auto &window) {
        const double width = double(window[2]) - window[0] + 1.0, height = double(window[3]) - window[1] + 1.0;
        if (width > 0.0 && height > 0.0) bytes = std::max(bytes, pixel * width * std::max(height, block));
    });
    for_each<2>(file, "tiles\0tiledesc\0\x09\0\0\0"sv, [&](const auto &side) {
        bytes = std::max(bytes, pixel * std::uint32_t(side[0]) * std::uint32_t(side[1]));
    });
    return static_cast<std::size_t>(std::min(bytes, most));
}

// Ours, with an attribute.
std::string ours() {
    std::vector<float> rgba(std::size_t{4} * 19 * 17);
    for (std::size_t k = 0; k < rgba.size(); ++k) rgba[k] = 0.01f * static_cast<float>(k % 61);
    smx_image image = nullptr;
    fuzz::require_ok(smx_image_create(19, 17, rgba.data(), &image), "an image");
    fuzz::require_ok(smx_image_set_attribute(image, "slopemix.note", "a seed"), "an attribute");
    fuzz::require_ok(smx_image_write_exr(image, (folder() / "seed.exr").c_str()), "a write");
    smx_image_release(image);
    return test::read_file(folder() / "seed.exr");
}

// Another program's: half floats with standard errors, or tiles.
std::string foreign(Imf::Compression compression, bool tiled) {
    constexpr int width = 5, height = 37;
    const std::vector<half> values(width * height, half(0.5f));
    Imf::Header header(width, height);
    header.compression() = compression;
    Imf::FrameBuffer buffer;
    for (const char *name : {"R", "G", "B", "error.R", "error.G", "error.B"}) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        // OpenEXR's writer takes a mutable pointer but only reads.
        char *base = const_cast<char *>(reinterpret_cast<const char *>(values.data()));
        buffer.insert(name, Imf::Slice(Imf::HALF, base, sizeof(half), width * sizeof(half)));
    }
    const std::string path = folder() / "seed.exr";
    if (tiled) {
        header.setTileDescription(Imf::TileDescription(16, 16));
        Imf::TiledOutputFile file(path.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(height);
    }
    return test::read_file(path);
}

} // namespace

std::vector<std::string> fuzz::seeds() {
    std::vector<std::string> files{ours(), foreign(Imf::ZIP_COMPRESSION, true), "v/1\x01"};
    for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::PIZ_COMPRESSION,
                                               Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION})
        files.push_back(foreign(compression, false));
    return files;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static fuzz::MemoryFile file;
    static const std::string path = folder() / "again.exr";
    file.set(data, size);
    smx_image image = nullptr;
    smx_status status;
    {
        const std::string_view bytes(reinterpret_cast<const char *>(data), size);
        const fuzz::MemoryLimit limit(2 * declared_bytes(bytes) + length_factor * size + codec_bytes +
                                      fuzz::always_legal);
        status = smx_image_read_exr(file.path().c_str(), &image);
    }
    fuzz::require_outcome(status, image, {SMX_BAD_FORMAT, SMX_OUT_OF_MEMORY});
    if (!image) return 0;
    fuzz::require_ok(smx_image_write_exr(image, path.c_str()), "writing what was read");
    smx_image again = read_again(path);
    const std::size_t values = values_of(image);
    fuzz::require(values_of(again) == values, "the same size");
    require_same(smx_image_pixels(image), smx_image_pixels(again), values);
    require_same(smx_image_errors(image), smx_image_errors(again), values);
    smx_image_release(again);
    smx_image_release(image);
    return 0;
}
