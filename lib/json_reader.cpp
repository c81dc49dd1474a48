#include "json_reader.h"

#include <cmath>

#include "error.h"

namespace smx {

void JsonReader::refuse(const std::string &why) const { fail(Fault::BadFormat, path_, " ", why); }

void JsonReader::expect_object() const {
    if (!value_.is_object()) refuse(text("must be an object, not ", value_.type_name()));
}

JsonReader JsonReader::member(const std::string &key) {
    expect_object();
    const auto found = value_.find(key);
    if (found == value_.end()) fail(Fault::BadFormat, path_, ".", key, " is missing");
    read_.insert(key);
    return JsonReader(*found, path_ + "." + key);
}

std::size_t JsonReader::array_size() const {
    if (!value_.is_array()) refuse(text("must be an array, not ", value_.type_name()));
    return value_.size();
}

JsonReader JsonReader::element(std::size_t index) const {
    return JsonReader(value_.at(index), text(path_, "[", index, "]"));
}

void JsonReader::finish() const {
    expect_object();
    for (const auto &item : value_.items())
        if (!read_.contains(item.key())) fail(Fault::BadFormat, path_, ".", item.key(), " is not a known key");
}

double JsonReader::number() const {
    if (!value_.is_number()) refuse(text("must be a number, not ", value_.type_name()));
    const double number = value_.get<double>();
    if (!std::isfinite(number)) refuse("must be finite");
    return number;
}

unsigned JsonReader::count() const {
    if (!value_.is_number_unsigned() || value_.get<std::uint64_t>() > 0xffffffffu)
        refuse(text("must be a whole number from 0 to 4294967295, not ", value_.dump()));
    return value_.get<unsigned>();
}

std::string JsonReader::string() const {
    if (!value_.is_string()) refuse(text("must be a string, not ", value_.type_name()));
    return value_.get<std::string>();
}

} // namespace smx
