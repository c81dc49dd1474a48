// An EXR file written row by row, so that the image need not be in memory.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace smx {

class ExrWriter {
  public:
    // Channels as image.h has them, those of the standard errors if asked for. All throw OpenEXR's exceptions, and
    // std::system_error for what the file system refuses.
    ExrWriter(const std::string &path, std::uint32_t width, std::uint32_t height,
              const std::map<std::string, std::string> &attributes, bool with_errors);
    ~ExrWriter();
    ExrWriter(const ExrWriter &) = delete;
    ExrWriter &operator=(const ExrWriter &) = delete;

    // The next rows from the top, [rows][width][4]; `errors` is not read where there are none.
    void write(const float *rgba, const float *errors, std::uint32_t rows);

    // After the last row: only then is it known that all of the file is on its disk.
    void finish();

  private:
    struct File;
    std::unique_ptr<File> file_;
};

} // namespace smx
