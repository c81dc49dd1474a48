// EXR files, by OpenEXR.
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "atomic_file.h"
#include "error.h"
#include "image.h"
#include "scene.h"

namespace smx {

namespace {

constexpr const char *channels[] = {"R", "G", "B", "A"};

// The image's rows as OpenEXR sees them; (x, y) is the data window's first pixel.
Imf::FrameBuffer frame_buffer(float *rgba, std::size_t width, std::ptrdiff_t x, std::ptrdiff_t y) {
    const std::size_t pixel = 4 * sizeof(float), row = width * pixel;
    char *origin =
        reinterpret_cast<char *>(rgba) - x * static_cast<std::ptrdiff_t>(pixel) - y * static_cast<std::ptrdiff_t>(row);
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < 4; ++c)
        buffer.insert(channels[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), pixel, row, 1, 1, c == 3));
    return buffer;
}

void expect_rgb(const Imf::Header &header, const std::string &path) {
    for (std::size_t c = 0; c < 3; ++c)
        if (!header.channels().findChannel(channels[c]))
            fail(Fault::BadFormat, path, ": no channel ", channels[c], "; an image needs R, G and B");
}

Image read_pixels(const std::string &path) {
    Imf::InputFile file(path.c_str());
    expect_rgb(file.header(), path);
    const auto window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width < 1 || height < 1 || width > max_side || height > max_side)
        fail(Fault::BadFormat, path, ": ", width, " x ", height, " pixels; sides must be 1..", max_side);

    Image image(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    file.setFrameBuffer(frame_buffer(image.rgba.data(), image.width, window.min.x, window.min.y));
    file.readPixels(window.min.y, window.max.y);
    for (auto at = file.header().begin(); at != file.header().end(); ++at)
        if (const auto *value = dynamic_cast<const Imf::StringAttribute *>(&at.attribute()))
            image.attributes[at.name()] = value->value();
    return image;
}

} // namespace

void validate_attribute_key(const std::string &key) {
    require(!key.empty() && key.size() <= 255, "an attribute's key has 1..255 characters, not ", key.size());
    const Imf::Header header(1, 1);
    const bool own = header.find(key.c_str()) != header.end();
    require(!own, "\"", key, "\" is one of EXR's own attributes");
}

Image read_exr(const std::string &path) {
    std::error_code status;
    if (std::filesystem::is_directory(path, status)) fail(Fault::CannotRead, "cannot read ", path, ": it is a folder");
    errno = 0;
    if (!std::ifstream(path))
        fail(Fault::CannotRead, "cannot read ", path, ": ", std::strerror(errno ? errno : ENOENT));
    try {
        return read_pixels(path);
    } catch (const Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &e) {
        fail(Fault::BadFormat, path, ": not a readable EXR file: ", e.what());
    }
}

void write_exr(const Image &image, const std::string &path) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    for (const char *name : channels) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    for (const auto &[key, value] : image.attributes) header.insert(key, Imf::StringAttribute(value));
    write_atomically(path, [&](const std::string &temporary) {
        Imf::OutputFile file(temporary.c_str(), header);
        // OpenEXR only reads from the buffer, but takes it as not const.
        file.setFrameBuffer(frame_buffer(const_cast<float *>(image.rgba.data()), image.width, 0, 0));
        file.writePixels(static_cast<int>(image.height));
    });
}

} // namespace smx
