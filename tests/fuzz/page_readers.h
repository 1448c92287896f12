// Readers of the participant's page for the fuzzing program: requests of browsers, and the lines between app and page.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

std::vector<Reader> pageReaders();

}  // namespace fuzz
