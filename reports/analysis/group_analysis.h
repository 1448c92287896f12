// Groups of participants (one factor between them): their means, and whether groups differ. For these fabrics only: those that
// every group answered, so that a fabric which one group lacks does not look like a difference of groups.
#pragma once

#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "stats/kernels/value.h"

namespace reports {

/// Test of equal means of the groups. Two groups: Welch's t test, as F = t^2. More: one-way analysis of variance, which takes
/// their variances as equal.
struct GroupTest {
    std::string why;                        ///< empty when there is a test
    std::vector<std::size_t> participants;  ///< by group
    std::vector<stats::Value> means;        ///< by group
    stats::Value difference;                ///< first - second group; for two groups only
    stats::Interval ci95;                   ///< of the difference
    stats::Value f;
    stats::Value df1;
    stats::Value df2;
    stats::Value p;
    stats::Value pHolm;  ///< corrected over the contrasts of the question; as p for the test of the overall means
    std::vector<std::string> fabricsLeftOut;  ///< answered, but not in every group; in the order of the study
};

/// How a contrast of conditions differs between the groups (group x condition).
struct GroupContrast {
    std::string a;
    std::string b;
    GroupTest test;  ///< on the participants' differences a - b
};

struct GroupedQuestion {
    std::string question;
    std::vector<std::vector<stats::Value>> means;          ///< [group x condition] mean of the participants' means
    std::vector<std::vector<std::string>> fabricsLeftOut;  ///< by condition, of these means; answered, but not in every group
    GroupTest overall;                                     ///< on the means over all conditions of the complete participants
    std::vector<GroupContrast> contrasts;                  ///< planned contrasts, else all pairs of at most mostGroupPairs
};

inline constexpr std::size_t mostGroupPairs = 36;

struct GroupAnalysis {
    std::vector<std::string> groups;         ///< in the order of their names
    std::vector<std::size_t> participants;   ///< by group
    std::vector<GroupedQuestion> questions;  ///< questions with numbers; empty where there are no groups
};

/// The fabrics that some comparison of a question leaves out, in the order of the study.
std::vector<std::string> fabricsNotInEveryGroup(const StudyData& data, const GroupAnalysis& groups);

/// The groups come from StudyData::groupOf. A participant without a group belongs to none.
GroupAnalysis analyseGroups(const StudyData& data, const AnswerCells& cells);

}  // namespace reports
