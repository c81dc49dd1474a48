#include "exr_writer.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cerrno>
#include <fstream>
#include <functional>
#include <new>
#include <optional>
#include <system_error>

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

// OpenEXR's own stream drops what fails when it closes: the last bytes, and the offsets of the rows.
class CheckedStream : public Imf::OStream {
  public:
    explicit CheckedStream(const std::string &path) : OStream(path.c_str()) {
        errno = 0;
        out_.open(path, std::ios::binary);
        check();
    }
    void write(const char bytes[], int count) override {
        out_.write(bytes, count);
        check();
    }
    uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(out_.tellp())); }
    void seekp(uint64_t position) override {
        out_.seekp(static_cast<std::streamoff>(position));
        check();
    }
    void close() {
        out_.close();
        check();
    }
    bool is_sound() const { return out_.good(); }

  private:
    void check() const {
        if (!out_) throw std::system_error(errno ? errno : EIO, std::generic_category());
    }

    std::ofstream out_;
};

// OpenEXR makes the parts of a file in streams in memory, whose end it tells as a failure of output like any other:
// where the file's own stream is sound, that is what it was.
void tell_end_of_memory(const CheckedStream &stream, const std::function<void()> &write) {
    try {
        write();
    } catch (const Iex::IoExc &) {
        if (stream.is_sound()) throw std::bad_alloc();
        throw;
    } catch (const Iex::ErrnoExc &) {
        if (stream.is_sound()) throw std::bad_alloc();
        throw;
    }
}

} // namespace

struct ExrWriter::File {
    File(const std::string &path, std::uint32_t image_width, const Imf::Header &header, bool errors)
        : width(image_width), with_errors(errors), stream(path) {
        tell_end_of_memory(stream, [&] { output.emplace(stream, header); });
    }

    std::uint32_t width;
    bool with_errors;
    CheckedStream stream;
    std::optional<Imf::OutputFile> output; // goes before its stream
};

ExrWriter::ExrWriter(const std::string &path, std::uint32_t width, std::uint32_t height,
                     const std::map<std::string, std::string> &attributes, bool with_errors)
    : file_(new File(path, width, header_of(width, height, attributes, with_errors), with_errors)) {}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write(const float *rgba, const float *errors, std::uint32_t rows) {
    const int row = file_->output->currentScanLine();
    Imf::FrameBuffer buffer;
    // OpenEXR only reads from the rows, but takes them as not const.
    insert_rows(buffer, image_channels, const_cast<float *>(rgba), file_->width, 0, row);
    if (file_->with_errors) insert_rows(buffer, error_channels, const_cast<float *>(errors), file_->width, 0, row);
    file_->output->setFrameBuffer(buffer);
    tell_end_of_memory(file_->stream, [&] { file_->output->writePixels(static_cast<int>(rows)); });
}

void ExrWriter::finish() {
    file_->output.reset();
    file_->stream.close();
}

} // namespace smx
