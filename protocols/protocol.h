// What a study asks and of whom, as a value: phases, questions, scales, conditions, breaks, the
// equivalence bounds and planned contrasts. Reading it from JSON is protocol_json; drawing the
// running orders is allocation.
#pragma once

#include "protocols/ids.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace protocols {

/// The Haptic Analog Scale: 0 unrelated, 10 totally the same; spoken in steps of `step`.
struct Scale {
    Tenths min{0};
    Tenths max{100};
    Tenths step{1};
    int sections = 9;  ///< equal sections of the line the participant memorises

    bool holds(Tenths rating) const
    {
        return rating >= min && rating <= max && (rating.value - min.value) % step.value == 0;
    }
    bool operator==(const Scale&) const = default;
};

/// One question with the words said to the participant.
struct Question {
    QuestionId id;
    std::string text;
    bool operator==(const Question&) const = default;
};

/// A run of presentations, each condition x fabric once. Either a choice among `alternatives`
/// fabrics (Q1) or ratings on `scale` of one fabric (Q2-Q4, asked one after another).
struct Phase {
    std::vector<Question> questions;
    std::optional<int> alternatives;
    std::optional<Scale> scale;

    bool isChoice() const { return alternatives.has_value(); }
    bool operator==(const Phase&) const = default;
};

struct PlannedContrast {
    ConditionId a;
    ConditionId b;
    bool operator==(const PlannedContrast&) const = default;
};

struct Protocol {
    std::string name;
    int participants = 10;
    int fabricCount = 7;
    std::vector<FabricId> fabrics;  ///< named ones; empty: fabricCount are drawn by seed
    std::vector<ConditionId> conditions;
    std::vector<Phase> phases;
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};  ///< scale points
    std::vector<PlannedContrast> planned;
    double secondsPerPresentation = 25;
    int breakAfterPresentations = 21;
    int sittingMinutes = 60;
    std::vector<std::string> checklist;  ///< read out and ticked before a sitting
    std::vector<std::string> facts;      ///< asked about a participant, each optional: age, gender, ...

    int presentationsPerPhase() const { return fabricCount * static_cast<int>(conditions.size()); }
    bool operator==(const Protocol&) const = default;
};

/// Every fault at once, each "place: what is wrong, what was expected"; empty when the protocol can run.
std::vector<std::string> faultsOf(const Protocol& protocol);

}  // namespace protocols
