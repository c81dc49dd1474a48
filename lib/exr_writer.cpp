#include "exr_writer.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "exr_rows.h"

namespace smx {

namespace {

void add_channels(Imf::Header &header, const ChannelNames &names) {
    for (const char *name : names)
        if (name) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
}

Imf::Header header_of(std::uint32_t width, std::uint32_t height, const std::map<std::string, std::string> &attributes,
                      bool with_errors) {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    add_channels(header, image_channels);
    if (with_errors) add_channels(header, error_channels);
    for (const auto &[key, value] : attributes) header.insert(key, Imf::StringAttribute(value));
    return header;
}

} // namespace

struct ExrWriter::File {
    std::uint32_t width;
    bool with_errors;
    Imf::OutputFile output;
};

ExrWriter::ExrWriter(const std::string &path, std::uint32_t width, std::uint32_t height,
                     const std::map<std::string, std::string> &attributes, bool with_errors)
    : file_(new File{width, with_errors, {path.c_str(), header_of(width, height, attributes, with_errors)}}) {}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write(const float *rgba, const float *errors, std::uint32_t rows) {
    const int row = file_->output.currentScanLine();
    Imf::FrameBuffer buffer;
    // OpenEXR only reads from the rows, but takes them as not const.
    insert_rows(buffer, image_channels, const_cast<float *>(rgba), file_->width, 0, row);
    if (file_->with_errors) insert_rows(buffer, error_channels, const_cast<float *>(errors), file_->width, 0, row);
    file_->output.setFrameBuffer(buffer);
    file_->output.writePixels(static_cast<int>(rows));
}

} // namespace smx
