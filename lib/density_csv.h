// A slope density or a distribution of normals as a CSV file.
#pragma once

#include <string>
#include <string_view>

#include "density_samples.h"

namespace smx {

// Two columns: theta in radians, ascending, and the density there. The header is `theta,p22`, `theta,ndf`, or
// `theta,value`, which is p22; so is a file without. Empty lines and lines that start with # count for nothing; line
// ends of Unix and Windows, a byte order mark, and blanks around the values are legal. `path` is for messages, which
// name the line. Throws BadFormat.
DensitySamples parse_density_csv(std::string_view bytes, const std::string &path);

// The density of a file of at most 16 MiB; named like it. Throws CannotRead, BadFormat, NoSolution.
SlopeDensity read_density_csv(const std::string &path);

} // namespace smx
