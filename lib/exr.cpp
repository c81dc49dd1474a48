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
#include "exr_header.h"
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

// Memory is touched as rows come: a header may declare far more than its file holds.
class ExrReader {
  public:
    explicit ExrReader(const std::string &path) : file_(path.c_str()), window_(file_.header().dataWindow()) {
        expect_rgb(file_.header(), path);
        const std::int64_t width = std::int64_t{window_.max.x} - window_.min.x + 1;
        const std::int64_t height = std::int64_t{window_.max.y} - window_.min.y + 1;
        if (width < 1 || height < 1 || width > max_side || height > max_side)
            fail(Fault::BadFormat, path, ": ", width, " x ", height, " pixels; sides must be 1..", max_side);
        if (!file_.isComplete()) fail(Fault::BadFormat, path, ": rows are missing");
        width_ = static_cast<std::uint32_t>(width);
        height_ = static_cast<std::uint32_t>(height);
    }

    Image read() {
        constexpr std::uint32_t band = 256; // rows; no compression has larger blocks
        const bool with_errors = has_errors(file_.header());
        std::vector<float> rgba, errors;
        for (std::uint32_t y = 0; y < height_; y += band) {
            const std::uint32_t rows = std::min(band, height_ - y);
            Imf::FrameBuffer buffer;
            append_rows(buffer, image_channels, rgba, y, rows);
            if (with_errors) append_rows(buffer, error_channels, errors, y, rows);
            file_.setFrameBuffer(buffer);
            file_.readPixels(line(y), line(y + rows - 1));
        }
        for (std::size_t at = 3; at < errors.size(); at += 4) errors[at] = rgba[at];
        Image image(width_, height_, std::move(rgba));
        image.errors = std::move(errors);
        read_attributes(image);
        return image;
    }

  private:
    int line(std::uint32_t row) const { return window_.min.y + static_cast<int>(row); }

    // Room for the rows, whose place the buffer learns.
    void append_rows(Imf::FrameBuffer &buffer, const ChannelNames &names, std::vector<float> &values, std::uint32_t y,
                     std::uint32_t rows) const {
        const std::size_t row = std::size_t{4} * width_;
        values.reserve(row * height_);
        values.resize(row * (y + rows));
        insert_rows(buffer, names, values.data() + row * y, width_, window_.min.x, line(y));
    }

    void read_attributes(Image &image) const {
        for (auto at = file_.header().begin(); at != file_.header().end(); ++at)
            if (const auto *value = dynamic_cast<const Imf::StringAttribute *>(&at.attribute()))
                image.attributes[at.name()] = value->value();
    }

    Imf::InputFile file_;
    const Imath::Box2i window_;
    std::uint32_t width_ = 0, height_ = 0;
};

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
        expect_sound_exr_header(path);
        return ExrReader(path).read();
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
        ExrWriter writer(temporary, image.width, image.height, image.attributes, !image.errors.empty());
        writer.write(image.rgba.data(), image.errors.data(), image.height);
        writer.finish();
    });
}

} // namespace smx
