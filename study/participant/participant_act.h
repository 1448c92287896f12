// What the participant does on their page, as a value: agrees or does not agree, sends facts, taps a place on the line. It comes
// from a browser, so it is read strictly and within limits.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "study/participant/instruction.h"

namespace study::participant {

inline constexpr std::size_t mostFacts = 200;
inline constexpr std::size_t longestFact = 1000;  ///< bytes

struct Agreement {
    bool agrees = false;
    bool operator==(const Agreement&) const = default;
};
/// In the order of the questions; a question that was left out is empty.
struct FactsTold {
    std::vector<std::string> answers;
    bool operator==(const FactsTold&) const = default;
};
struct PlaceTapped {
    protocols::Tenths place;
    bool operator==(const PlaceTapped&) const = default;
};

/// An act with the number of the instruction that the participant saw.
struct ParticipantAct {
    int number = 0;
    std::variant<Agreement, FactsTold, PlaceTapped> what;
    bool operator==(const ParticipantAct&) const = default;
};

/// {"number": 7, "agrees": true}, {"number": 7, "facts": ["31", ""]} or {"number": 7, "tapped": 32}.
std::string jsonOf(const ParticipantAct& act);

/// Throws badInput for anything else, for text with control characters, and for more or longer facts than the limits above. Marks
/// that change the direction of a fact's text are left out.
ParticipantAct actFromJson(std::string_view json, const std::string& where);

/// Whether the instruction asks for this act: consent, as many facts as questions, a place on the scale.
bool isAskedFor(const ParticipantAct& act, const Instruction& instruction);

}  // namespace study::participant
