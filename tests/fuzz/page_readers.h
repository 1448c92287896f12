// Readers of the participant's page and sound for the fuzzing program: requests of browsers, lines between programs, recordings.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

std::vector<Reader> pageReaders();

}  // namespace fuzz
