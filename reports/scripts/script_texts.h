// The scripts beside this file, built into the program.
#pragma once

#include <string_view>

namespace reports::scripts {

std::string_view inR();
std::string_view inPython();

}  // namespace reports::scripts
