// A program of the lab's own that makes the friction images of a condition: how a call names it, and where it lies.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/protocol.h"

namespace study::making {

struct OwnProgram {
    protocols::ConditionId condition;
    std::string command;                 ///< as it was typed
    std::filesystem::path program;       ///< absolute
    std::vector<std::string> arguments;  ///< those that come before the two files
};

/// For one fabric.
struct ProgramLimits {
    std::chrono::seconds time{60};
    int memoryMib = 4096;  ///< that each of its processes may write to
};

/// The words of a command. Blanks separate them; a word in "..." or '...' may hold blanks. No other character has a meaning,
/// because no shell reads the command. Throws badInput for a quote that is not closed.
std::vector<std::string> wordsOf(std::string_view command);

/// From "ID=COMMAND". A name without a slash is looked for in the folders of PATH. Throws badInput: no command, an id that no
/// condition of a lab can have, a program that is missing or not executable.
OwnProgram ownProgramFrom(const std::string& text);

/// Throws badInput, naming `protocolFile`, unless each condition that comes from a program has one, and no other has.
void requirePrograms(const protocols::Protocol& protocol, const std::vector<OwnProgram>& programs,
                     const std::string& protocolFile);

}  // namespace study::making
