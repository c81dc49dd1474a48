// What is written from the command line's own definitions.
#pragma once

#include <string>

#include "program.h"
#include "words.h"

namespace slopemix::manual {

std::string man_page(const Program &program); // section 1, roff with the man macros
std::string bash_completion(const Program &program);
std::string zsh_completion(const Program &program);
std::string fish_completion(const Program &program);

} // namespace slopemix::manual
