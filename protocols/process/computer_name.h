// The name of the computer on which the program runs.
#pragma once

#include <string>

namespace protocols {

/// As the system knows it; empty where it has none.
std::string computerName();

}  // namespace protocols
