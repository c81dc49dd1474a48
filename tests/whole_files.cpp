#include "whole_files.h"

#include <gtest/gtest.h>
#include <png.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "results.h"
#include "support.h"

namespace test {

namespace {

std::string fault_of_exr(const std::string &path) {
    Image image;
    return smx_image_read_exr(path.c_str(), image.out()) == SMX_OK ? "" : smx_last_error();
}

std::string fault_of_json(const std::string &path) {
    const auto document = nlohmann::json::parse(read_file(path), nullptr, false);
    if (!document.is_object()) return "no JSON object";
    if (document.value("format", "") != "slopemix-material") return "";
    Material material;
    return smx_material_load(path.c_str(), material.out()) == SMX_OK ? "" : smx_last_error();
}

// Lines that all have their ends and the fields of the first, in which each field is a name.
std::string fault_of_csv(const std::string &path) {
    const std::string text = read_file(path);
    if (!text.ends_with('\n')) return "its last line has no end";
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> heading = fields_of(line);
    for (const std::string &name : heading)
        if (name.empty() || name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
            return "'" + name + "' is no column's name";
    std::size_t rows = 0;
    for (; std::getline(lines, line); ++rows)
        if (const std::size_t count = fields_of(line).size(); count != heading.size())
            return std::to_string(count) + " fields under a heading of " + std::to_string(heading.size());
    return rows > 0 ? "" : "no rows";
}

// libpng decodes the pixels without a look at what follows them.
std::string fault_of_png(const std::string &path) {
    constexpr char end[] = "IEND\xae\x42\x60\x82";
    if (!read_file(path).ends_with(end)) return "it has no end";
    png_image png;
    std::memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&png, path.c_str())) return png.message;
    png.format = PNG_FORMAT_RGB;
    std::vector<png_byte> rgb(PNG_IMAGE_SIZE(png));
    return png_image_finish_read(&png, nullptr, rgb.data(), 0, nullptr) ? "" : png.message;
}

std::string fault_of_svg(const std::string &path) {
    const std::string text = read_file(path);
    if (text.find("<svg") == std::string::npos) return "no SVG";
    const std::size_t last = text.find_last_not_of(" \n");
    return text.substr(0, last + 1).ends_with("</svg>") ? "" : "it has no end";
}

} // namespace

std::string fault_of_file(const std::string &path) {
    if (path.ends_with(".exr")) return fault_of_exr(path);
    if (path.ends_with(".json")) return fault_of_json(path);
    if (path.ends_with(".csv")) return fault_of_csv(path);
    if (path.ends_with(".png")) return fault_of_png(path);
    if (path.ends_with(".svg")) return fault_of_svg(path);
    return "a file of a kind that nothing reads";
}

void expect_whole_files(const TempDir &dir) {
    for (const std::string &name : dir.names()) {
        const std::string fault = name.starts_with(".") ? "" : fault_of_file(dir / name);
        EXPECT_EQ(fault, "") << name;
    }
}

} // namespace test
