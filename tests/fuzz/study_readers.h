// Readers of the files of a study for the fuzzing program: the database, its rows, rescue files, keys, registered plans, heads of
// the log, and passphrases.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

/// Makes a small study below `folder`; each input is tried on a copy.
std::vector<Reader> studyReaders(const std::filesystem::path& folder);

}  // namespace fuzz
