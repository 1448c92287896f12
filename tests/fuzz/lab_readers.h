// Readers of what a laboratory brings: planted effects, the response of its display, the way to its server.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// They write their inputs below `folder`.
std::vector<Reader> labReaders(const std::filesystem::path& folder);

}  // namespace fuzz
