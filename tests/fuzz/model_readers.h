// Readers of weights, of training runs, of the files between the program and vis2hap-nn, and of kept friction images.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// They write their inputs below `folder`.
std::vector<Reader> modelReaders(const std::filesystem::path& folder);

}  // namespace fuzz
