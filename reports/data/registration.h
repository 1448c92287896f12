// What was planned before the answers: the plans that a study registered in its log, and the design that they or a protocol
// state.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace reports {

/// A plan in the log of the study.
struct Registration {
    int number = 1;      ///< from 1; the later ones are amendments
    std::string time;    ///< ISO 8601
    std::string sha256;  ///< of the registered JSON
    std::size_t answersBefore = 0;
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
    std::string protocolSha256;

    std::size_t answers() const { return participants * fabrics * conditions * questions.size(); }
};

}  // namespace reports
