// What was planned before the answers: the plans that a study registered in its log, and the design that they or a protocol
// state.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "protocols/answer_kind.h"

namespace reports {

/// A plan in the log of the study.
struct Registration {
    int number = 1;                 ///< from 1; the later ones are amendments
    std::string time;               ///< ISO 8601
    std::string sha256;             ///< of the registered JSON
    std::size_t answersBefore = 0;  ///< given before it; those that were erased since count, too
    bool afterUnblinding = false;
    std::vector<std::string> changes;  ///< parts of the plan that an amendment changed: "planned", "equivalence_bounds"
    bool isFollowed = false;           ///< the analysis follows this one
};

/// "before the first answer", "after 12 answers", "after 12 answers and after the unblinding".
std::string timingText(std::size_t answersBefore, bool afterUnblinding);

/// Whether a plan was registered before anything could be known.
bool isInTime(const Registration& registration);

/// Name of the bounds among the parts of a plan that a protocol changed (StudyData::protocolChanges).
inline constexpr const char* equivalenceBoundsChanged = "equivalence bounds";

/// What states the bounds of equivalence, or the planned contrasts, that a report uses.
enum class PlanOrigin {
    Program,         ///< nobody: the default of this program
    Option,          ///< the call of the report, by --bounds or --planned
    Protocol,        ///< the protocol, or the version of it that counts
    RegisteredPlan,  ///< the registered plan alone: the latest protocol states something else, or nothing
};

/// The rule of bounds that nobody states: "a twentieth of the scale either way", or of the shortest one of these questions.
std::string usualBoundsRule(const std::vector<protocols::AnswerKind>& questions);

/// What a plan lets participants be asked or told.
struct PlannedText {
    std::string name;  ///< "wording of Q2", "deadline of the instruction quick"
    std::string text;
};

/// PlannedText::name of the sentence of a question.
std::string wordingNameOf(const std::string& question);

/// The numbers and names of a plan.
struct PlannedDesign {
    std::size_t participants = 0;
    std::size_t fabrics = 0;
    std::vector<std::string> fabricIds;  ///< empty where only their number is planned
    std::size_t conditions = 0;
    std::vector<std::string> conditionIds;  ///< empty while blinded
    std::vector<std::string> questions;
    std::size_t contrasts = 0;
    std::vector<std::pair<std::string, std::string>> contrastPairs;  ///< the primary one first; empty while blinded
    std::pair<double, double> equivalenceBounds{-0.5, 0.5};
    bool hasUsualBounds = false;  ///< the protocol states no bounds
    std::string protocolSha256;
    std::vector<PlannedText> texts;  ///< of questions and instructions; empty where they are unknown
    /// Of one participant to one fabric under one condition, over questions and instructions; 0: one to each question.
    std::size_t answersPerRendering = 0;

    std::size_t answers() const
    {
        return participants * fabrics * conditions * (answersPerRendering != 0 ? answersPerRendering : questions.size());
    }
};

}  // namespace reports
