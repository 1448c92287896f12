// The cache of signals as an attacker reads it, beside the stimuli: whether it names a code, and whether its entries follow the
// order of the stimuli. The cache must hold no finished image and must not be filled in the order of file codes.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "study/leaks/guessers.h"

namespace study::leaks {

/// Beside each stimulus, in the order of codes: size and time of the entry at the same place among the latest entries, by the
/// time of their last change and by their last use. Empty where the cache has fewer entries than there are stimuli.
std::vector<FileMark> marksOfCache(const std::filesystem::path& cache, const std::filesystem::path& stimuli);

/// One line for each entry whose name, or whose text within its first 64 kB, holds one of `codes` as a word. The bytes of arrays
/// and the numbers of JSON are no text.
std::vector<std::string> codesInCache(const std::filesystem::path& cache, const std::set<std::string>& codes);

}  // namespace study::leaks
