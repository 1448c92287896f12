// What a study asks and of whom, as a value: phases, questions, scales, conditions, breaks, the
// equivalence bounds and planned contrasts. Reading it from JSON is protocol_json; drawing the
// running orders is allocation.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/ids.h"

namespace protocols {

/// One question with the sentence that is said to the participant.
struct Question {
    QuestionId id;
    std::string text;
    AnswerKind kind;
    bool operator==(const Question&) const = default;
};

/// A run of presentations, each condition x fabric once. Its questions are asked one after another in every presentation.
/// `catchTrials` more presentations leave the glass blank.
struct Phase {
    std::vector<Question> questions;
    AnswerKind task;  ///< what a question asks for unless it is answered in free text; decides what lies on the tray
    int catchTrials = 0;
    bool operator==(const Phase&) const = default;
};

struct PlannedContrast {
    ConditionId a;
    ConditionId b;
    bool operator==(const PlannedContrast&) const = default;
};

/// The neutral codes that the fabric pieces carry, so that no name suggests an answer.
enum class SwatchCodes {
    Once,            ///< labelled once for the whole study
    PerParticipant,  ///< labelled anew for each participant, by the preparation sheet
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
    int breakAfterPresentations = 21;      ///< a block: the presentations between two breaks
    std::optional<int> breakAfterMinutes;  ///< a break also after so long without one
    int sittingMinutes = 60;
    std::vector<std::string> checklist;  ///< read out and ticked before a sitting
    std::vector<std::string> readings;   ///< measured with the checklist: "temperature in °C", ...
    std::vector<std::string> facts;      ///< asked about a participant, each optional: age, gender, ...
    std::string consent;                 ///< what the experimenter confirms when the participant has agreed
    std::string strokeWords;             ///< how to stroke, said the same for glass and cloth
    SwatchCodes swatchCodes = SwatchCodes::Once;
    int familiarisationFabrics = 0;  ///< at most so many, outside the study's own; fewer where the data set has fewer
    bool secondEntry = false;        ///< every answer is entered twice and must agree

    /// Condition x fabric; catch trials not counted.
    int presentationsPerPhase() const { return fabricCount * static_cast<int>(conditions.size()); }
    /// Of one participant, catch trials counted.
    int presentations() const;
    int answersPerParticipant() const;
    /// By secondsPerPresentation, breaks not counted.
    double minutesPerParticipant() const { return presentations() * secondsPerPresentation / 60; }
    /// At least one.
    int sittingsPerParticipant() const;
    bool operator==(const Protocol&) const = default;
};

/// The question with this id; null where the protocol asks no such question.
const Question* questionWith(const Protocol& protocol, const QuestionId& id);

/// The scale that the participants memorise: that of the first phase with ratings; null where nothing is rated.
const RatingScale* memorisedScaleOf(const Protocol& protocol);

/// What `changed` may not change once participants have trials by `kept`: "phases", "conditions" ...;
/// empty where only words, times, bounds, contrasts, checklist and facts differ.
std::vector<std::string> fixedPartsChanged(const Protocol& kept, const Protocol& changed);

/// Every fault at once, each "place: what is wrong, what was expected"; empty when the protocol can run.
std::vector<std::string> faultsOf(const Protocol& protocol);

}  // namespace protocols
