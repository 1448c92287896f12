// The readers of files and lines from outside, each with small sound inputs from which a fuzzing run begins.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fuzz {

struct Reader {
    std::string name;
    std::vector<std::string> corpus;  ///< inputs to begin with; the first one is sound
    /// Reads one input and uses the result. Throws protocols::Error for a refusal; anything else that it throws is a fault.
    std::function<void(const std::string& bytes)> read;
    std::function<std::vector<std::string>()> makeCorpus = {};  ///< instead of `corpus`, where that takes long to make
    std::size_t largestInput = 1 << 16;                         ///< bytes; longer mutations are cut
};

/// All readers. Those that read files write their inputs below `folder`.
std::vector<Reader> allReaders(const std::filesystem::path& folder);

}  // namespace fuzz
