// Values beside trials in the forms that guessers compare: parts of texts, equal values, and numbers or ranks.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace study::leaks {

/// A part of a value.
struct ValuePart {
    const char* name;
    std::string (*of)(const std::string& value);
};
/// The whole value, its beginnings, its ends, and its length.
std::span<const ValuePart> valueParts();

/// The finite number that the whole text is.
std::optional<double> numberIn(const std::string& text);

/// A value beside each trial in the forms that guessers compare.
struct CodedValues {
    std::vector<int> equal;      ///< equal numbers for equal values; -1: none
    bool repeats = false;        ///< some value stands beside two trials
    std::vector<double> places;  ///< the number, or the rank of the text
    bool isText = false;         ///< not a number
};

CodedValues coded(const std::vector<std::string>& values);

/// Equal numbers for equal values; -1 for empty ones. `repeats`: some value stands beside two trials.
std::vector<int> numbersOfEqual(const std::vector<std::string>& values, bool& repeats);

}  // namespace study::leaks
