// slopemix fit --compare: a table against its source, in BRDF space.
#pragma once

#include <string>

namespace slopemix::cli {

// Prints the errors of `other` against `source`, both tables; nothing is fitted.
void compare_tables(const std::string &other, const std::string &source, bool json);

} // namespace slopemix::cli
