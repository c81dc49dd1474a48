// The one exception of the library: a fault, in the C API's kinds, and a sentence with the value and the legal range.
#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>

namespace smx {

// The values are those of smx_status; capi/boundary.cpp checks that they agree.
enum class Fault {
    InvalidArgument = 1,
    CannotRead = 2,
    CannotWrite = 3,
    BadFormat = 4,
    NoDevice = 5,
    KernelBuild = 6,
    DeviceError = 7,
    OutOfMemory = 8,
    NoSolution = 9,
    Cancelled = 10,
    Internal = 11
};

class Error : public std::runtime_error {
  public:
    Error(Fault fault, const std::string &what) : std::runtime_error(what), fault_(fault) {}
    Fault fault() const { return fault_; }

  private:
    Fault fault_;
};

// The parts joined into one text, numbers in the classic locale.
template <typename... Parts>
std::string text(const Parts &...parts) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.exceptions(std::ios::badbit); // a stream swallows what it meets otherwise, such as the end of memory
    (out << ... << parts);
    return out.str();
}

template <typename... Parts>
[[noreturn]] void fail(Fault fault, const Parts &...parts) {
    throw Error(fault, text(parts...));
}

template <typename... Parts>
void require(bool holds, const Parts &...parts) {
    if (!holds) fail(Fault::InvalidArgument, parts...);
}

} // namespace smx
