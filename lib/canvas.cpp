#include "canvas.h"

#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "atomic_file.h"
#include "exr_writer.h"

namespace smx {

namespace {

class ImageCanvas : public Canvas {
  public:
    ImageCanvas(std::uint32_t width, std::uint32_t height, bool with_errors) : image_(width, height) {
        if (with_errors) image_.errors.assign(image_.rgba.size(), 0.0f);
    }
    void begin(const Attributes &) override {}
    TileRows rows(const Tile &tile) override {
        const std::size_t at = 4 * std::size_t{tile.first_row} * image_.width;
        return {image_.rgba.data() + at, image_.errors.empty() ? nullptr : image_.errors.data() + at};
    }
    void take(const Tile &) override {}
    std::optional<Image> finish(const Attributes &attributes) override {
        image_.attributes = attributes;
        return std::move(image_);
    }
    std::size_t ahead(std::size_t) const override { return std::numeric_limits<std::int32_t>::max(); }

  private:
    Image image_;
};

class FileCanvas : public Canvas {
  public:
    FileCanvas(std::uint32_t width, std::uint32_t height, bool with_errors, const std::string &path)
        : width_(width), height_(height), with_errors_(with_errors), file_(path) {}

    void begin(const Attributes &attributes) override {
        writer_.reset();
        waiting_.clear();
        file_.write([&](const std::string &temporary) {
            writer_ = std::make_unique<ExrWriter>(temporary, width_, height_, attributes, with_errors_);
        });
    }
    TileRows rows(const Tile &tile) override {
        const std::size_t count = 4 * std::size_t{tile.rows} * width_;
        const std::lock_guard lock(mutex_);
        Waiting &held = waiting_[tile.first_row];
        held.rgba.resize(count);
        held.errors.resize(with_errors_ ? count : 0);
        return {held.rgba.data(), with_errors_ ? held.errors.data() : nullptr};
    }
    void take(const Tile &tile) override {
        const Waiting done = [&] {
            const std::lock_guard lock(mutex_);
            return std::move(waiting_.extract(tile.first_row).mapped());
        }();
        file_.write([&](const std::string &) { writer_->write(done.rgba.data(), done.errors.data(), tile.rows); });
    }
    std::optional<Image> finish(const Attributes &) override {
        file_.write([&](const std::string &) { writer_->finish(); });
        writer_.reset();
        file_.commit();
        return std::nullopt;
    }
    std::size_t ahead(std::size_t devices) const override { return 2 * devices; }

  private:
    struct Waiting {
        std::vector<float> rgba, errors;
    };

    std::uint32_t width_, height_;
    bool with_errors_;
    AtomicFile file_;
    std::unique_ptr<ExrWriter> writer_; // goes before the file it writes
    std::mutex mutex_;
    std::map<std::uint32_t, Waiting> waiting_; // by first row
};

} // namespace

std::unique_ptr<Canvas> make_canvas(std::uint32_t width, std::uint32_t height, bool with_errors,
                                    const std::string &exr_path) {
    if (exr_path.empty()) return std::make_unique<ImageCanvas>(width, height, with_errors);
    return std::make_unique<FileCanvas>(width, height, with_errors, exr_path);
}

} // namespace smx
