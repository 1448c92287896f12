// Variables of the environment with secrets. Programs that this one starts do not get them, unless they need one.
#pragma once

#include <array>

namespace protocols {

inline constexpr std::array<const char*, 2> secretVariables{"VIS2HAP_PASSPHRASE", "PGPASSWORD"};

}  // namespace protocols
