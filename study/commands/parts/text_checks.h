// Checks of words that people give on the command line: who they are and why they act. The log keeps these words.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "protocols/files/id_rule.h"

namespace study::commands {

inline CLI::Validator lineUpTo(std::size_t mostBytes)
{
    return CLI::Validator(
        [mostBytes](std::string& line) {
            const std::string fault = protocols::faultOfLine(line, mostBytes);
            return fault.empty() ? fault : "the text " + fault + " (expected " + protocols::lineRule(mostBytes) + ")";
        },
        "");
}

/// For --who and --operator.
inline CLI::Validator isName() { return lineUpTo(protocols::longestName); }

/// For --why.
inline CLI::Validator isReason() { return lineUpTo(protocols::longestReason); }

/// For --licence: letters, digits and . - +, as in CC-BY-4.0.
inline CLI::Validator isSpdxIdentifier()
{
    return CLI::Validator(
        [](std::string& text) {
            const auto fits = [](char c) {
                return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' ||
                       c == '+';
            };
            const bool isGood = !text.empty() && text.size() <= 60 && std::all_of(text.begin(), text.end(), fits);
            return isGood ? std::string() : "an SPDX identifier like CC-BY-4.0 is expected (https://spdx.org/licenses)";
        },
        "");
}

}  // namespace study::commands
