// Readers of numbers for the fuzzing program: requests for analyses, finished counts, friction records and traces.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// Those that read files write their inputs below `folder`.
std::vector<Reader> numberReaders(const std::filesystem::path& folder);

}  // namespace fuzz
