// Distinct types for the names in a study, so that nobody can pass a fabric where a condition is expected. They are plain
// values; files and tables show their text.
#pragma once

#include <string>  // brings <compare>, over which Qt's moc stumbles where that header comes first
#include <utility>

namespace protocols {

template <class Tag>
struct Id {
    std::string value;

    Id() = default;
    explicit Id(std::string text) : value(std::move(text)) {}
    bool empty() const { return value.empty(); }
    auto operator<=>(const Id&) const = default;
};

using ParticipantId = Id<struct ParticipantTag>;      ///< "P01"; scripted ones bring their own, "S01"
using FabricId = Id<struct FabricTag>;                ///< "F01"
using ConditionId = Id<struct ConditionTag>;          ///< "h_g&f_g"
using QuestionId = Id<struct QuestionTag>;            ///< "Q1"
using InstructionId = Id<struct InstructionTag>;      ///< "speed": what a block asks of the participant's speed
using FileCode = Id<struct FileCodeTag>;              ///< opaque name of a stimulus file in the study folder
using SealedCode = Id<struct SealedCodeTag>;          ///< the file code of one presentation, sealed with the station key
using ConditionLabel = Id<struct ConditionLabelTag>;  ///< "K3": a condition's masked name
using PresentationCode = Id<struct PresentationTag>;  ///< shown on the console; new for each participant and trial

/// Number of a presentation in a participant's list, from 1.
struct TrialNumber {
    int value = 0;
    auto operator<=>(const TrialNumber&) const = default;
};

/// A rating in whole tenths of a scale point, so that 5.4 stays 5.4.
struct Tenths {
    int value = 0;
    double inScaleUnits() const { return value / 10.0; }
    auto operator<=>(const Tenths&) const = default;
};

}  // namespace protocols
