// What files tell without being understood: modes, sizes, times, order, compression and entropy of the stimuli, and words in
// exports.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "study/leaks/guessers.h"

namespace study::leaks {

/// Size, times, number of the inode, place in the folder, compressed size, entropy and name of each stimulus.
std::vector<FileMark> marksOfStimuli(const std::filesystem::path& stimuli);

/// One line for each kind of difference that needs no guess: sizes or times that differ, content that can be compressed.
std::vector<std::string> differencesOfStimuli(const std::filesystem::path& stimuli);

/// One line for each file or folder of the study that other users may read: modes other than 0600 and 0700.
std::vector<std::string> openModes(const std::filesystem::path& study);

/// One line for each file of an export or a report of a blinded study that holds a condition's id, a K-label or the word
/// "correct" as a whole cell or text.
std::vector<std::string> namedInTexts(const std::filesystem::path& folder, const protocols::Protocol& protocol);

}  // namespace study::leaks
