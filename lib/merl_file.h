// MERL `.binary` files: three little-endian int32 (theta_h 90, theta_d 90, phi_d 180 or 360), then the R, G and B
// planes as float64 in the grid's order, scaled per channel; a negative value marks an invalid cell.
#pragma once

#include <string>

#include "brdf.h"

namespace smx {

// Throws CannotRead, BadFormat (dimensions, length, content).
Brdf read_merl(const std::string &path);

// The bytes of the file; cells that were invalid hold -1.
std::string merl_bytes(const Brdf &brdf);

// What `.binary` bytes hash to when they hold these values (1/sr, negative = invalid): the identity of a table.
std::string merl_bytes(std::size_t phi_d_count, const std::vector<double> &values);

// Writes the file, whole or not at all. Throws CannotWrite.
void write_merl(const Brdf &brdf, const std::string &path);

} // namespace smx
