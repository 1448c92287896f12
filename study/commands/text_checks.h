// Checks of words that people give on the command line: who they are and why they act. The log keeps these words.
#pragma once

#include <CLI/CLI.hpp>
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

}  // namespace study::commands
