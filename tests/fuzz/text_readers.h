// What becomes of texts from outside, for the fuzzing program: markup, LaTeX, sentences in the language of the window, and the
// catalogues of such a language.
#pragma once

#include "tests/fuzz/readers.h"

namespace fuzz {

std::vector<Reader> writtenTextReaders(const std::filesystem::path& folder);

}  // namespace fuzz
