// EXR files, by OpenEXR.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "atomic_file.h"
#include "error.h"
#include "exr_rows.h"
#include "exr_writer.h"
#include "image.h"
#include "scene.h"

namespace smx {

namespace {

bool has_errors(const Imf::Header &header) {
    return std::all_of(error_channels.begin(), error_channels.end(),
                       [&](const char *name) { return !name || header.channels().findChannel(name); });
}

void expect_rgb(const Imf::Header &header, const std::string &path) {
    for (std::size_t c = 0; c < 3; ++c)
        if (!header.channels().findChannel(image_channels[c]))
            fail(Fault::BadFormat, path, ": no channel ", image_channels[c], "; an image needs R, G and B");
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
    Imf::FrameBuffer buffer;
    insert_rows(buffer, image_channels, image.rgba.data(), image.width, window.min.x, window.min.y);
    if (has_errors(file.header())) {
        image.errors.resize(image.rgba.size());
        insert_rows(buffer, error_channels, image.errors.data(), image.width, window.min.x, window.min.y);
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    for (std::size_t at = 3; at < image.errors.size(); at += 4) image.errors[at] = image.rgba[at];
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
    write_atomically(path, [&](const std::string &temporary) {
        ExrWriter(temporary, image.width, image.height, image.attributes, !image.errors.empty())
            .write(image.rgba.data(), image.errors.data(), image.height);
    });
}

} // namespace smx
