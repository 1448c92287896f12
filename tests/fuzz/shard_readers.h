// Readers of the files of shards. The hash of a file hides its values from mutations, so these have a reader of their own.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// They write their inputs below `folder`.
std::vector<Reader> shardReaders(const std::filesystem::path& folder);

}  // namespace fuzz
