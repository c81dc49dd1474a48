// A contact sheet as a PNG: tables of pictures with headings, row labels and captions. Knows nothing of what they show.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "parse.h"

namespace slopemix::cli {

struct Picture {
    std::uint32_t width, height;
    std::vector<std::uint8_t> rgb; // [height][width][3], sRGB
};

struct ContactSheet {
    struct Group { // neighbouring columns under one heading
        std::string heading;
        std::vector<std::string> columns;
    };
    struct Table {
        std::string heading; // an underscore makes the character after it a subscript
        std::vector<std::string> rows;
    };
    struct Cell {
        std::optional<Picture> picture; // none: a blank of the same size
        std::string caption;
    };

    std::string title, subtitle;
    std::vector<Group> groups;
    std::vector<Table> tables;
    std::vector<std::string> notes;
    Resolution resolution;                // of the pictures
    std::function<Cell(ImageId)> cell_at; // asked once per cell, so that the pictures need not be in memory together
};

// Throws CommandError if the file cannot be written.
void write_contact_sheet(const ContactSheet &sheet, const std::filesystem::path &file);

} // namespace slopemix::cli
