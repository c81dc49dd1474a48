// Strict reading of JSON objects: every key is asked for by type, and none may be left over. An error names the path
// of the key, like $.lobes[2].alpha.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace smx {

class JsonReader {
  public:
    JsonReader(const nlohmann::json &value, std::string path) : value_(value), path_(std::move(path)) {}

    JsonReader member(const std::string &key);   // of an object
    JsonReader element(std::size_t index) const; // of an array
    std::size_t array_size() const;
    void finish() const; // no member of this object was left unread

    bool is_null() const { return value_.is_null(); }
    double number() const;
    unsigned count() const;
    std::string string() const;
    [[noreturn]] void refuse(const std::string &why) const;

  private:
    void expect_object() const;

    const nlohmann::json &value_;
    std::string path_;
    std::set<std::string> read_;
};

} // namespace smx
