// Readers of what the window remembers between its runs.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// They write their inputs below `folder`.
std::vector<Reader> settingsReaders(const std::filesystem::path& folder);

}  // namespace fuzz
