// "KIND,key=value,...": what a material by formula is made of.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

#include "brdf.h"

namespace smx {

struct NumberRange {
    double low, high;
};

// Everything here throws InvalidArgument that names the specification, the key, the value and its range.
class Parameters {
  public:
    explicit Parameters(const std::string &specification);

    const std::string &kind() const { return kind_; }

    // Refuses every key that is not one of these, and the lack of one that is.
    void expect(std::initializer_list<std::string_view> keys) const;

    double number(const std::string &key, NumberRange range) const;
    Rgb colour(const std::string &key, NumberRange range) const; // "v" for all channels, or "r/g/b"

  private:
    double parse(const std::string &key, std::string_view text, NumberRange range) const;

    std::string specification_, kind_;
    std::map<std::string, std::string, std::less<>> values_;
};

} // namespace smx
