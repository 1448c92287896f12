// A question with right and wrong answers, analysed: shares correct, tests against chance, and differences of conditions.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/accuracy_by_speed.h"
#include "reports/analysis/instruction_analysis.h"
#include "reports/analysis/pair_comparisons.h"
#include "reports/analysis/question_claims.h"
#include "reports/analysis/question_effects.h"
#include "reports/analysis/speed_analysis.h"
#include "reports/cells/answer_cells.h"
#include "reports/data/analysis_options.h"
#include "stats/claims/match_sensitivity.h"
#include "stats/models/crossed_study.h"
#include "stats/tests/binomial.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/t_tests.h"

namespace reports {

struct CountCorrect {
    std::size_t correct = 0;
    std::size_t trials = 0;
};

/// One condition.
struct ConditionChoices {
    CountCorrect count;
    stats::Value matchesPerRendering;        ///< share correct x participants with an answer, as the paper reports it
    stats::BinomialTest againstChance;       ///< over trials, one-sided against 1/m; its Wilson and Clopper-Pearson intervals
    stats::Value pHolm;                      ///< p of that test after Holm's correction over the conditions
    stats::TTest participantsAgainstChance;  ///< the participants' shares against 1/m, two-sided
    stats::Value dPrime;                     ///< does not depend on m; of hits and false alarms in a same-different question
    stats::Value dPrimeSe;
    std::optional<stats::MatchSensitivity> matches;  ///< of a same-different question
    std::vector<CountCorrect> byFabric;              ///< in the order of the study's fabrics
    std::string noChance = {};  ///< why there is no test against 1/m (see whyNoChance()); empty: there is one
};

struct ParticipantShare {
    std::string participant;
    stats::Value share;  ///< correct, over all conditions and fabrics
};

/// Which fabric was chosen for which, over all conditions, and how often each place of the tray.
struct ChoiceConfusion {
    bool known = false;                            ///< any answer says which fabric was chosen
    std::vector<std::vector<std::size_t>> chosen;  ///< [true fabric x chosen fabric]
    std::vector<int> slots;                        ///< in the order of their first choice
    std::map<int, std::size_t> slotCounts;         ///< by slot, 0 = A
};

struct ChoiceAnalysis {
    int alternatives = 3;                      ///< m
    std::vector<ConditionChoices> conditions;  ///< in the order of the study's conditions
    stats::CochranTest cochran;
    std::vector<ParticipantShare> participants;
    stats::TTest participantsAgainstChance;  ///< their shares against 1/m, two-sided
    stats::ChoiceModel model;                ///< random intercepts of participant and fabric
    stats::ChoiceModel crossedModel;         ///< their interactions with condition, too
    stats::RatingModel linearModel;          ///< linear mixed model of the answers as 0 and 1; decides the claims
    ChoiceConfusion confusion;
    std::vector<PairComparison> comparisons;
    QuestionClaims claims;
    QuestionEffects effects;
    std::vector<ClusteredSensitivity> sensitivities;  ///< in the order of claims.aboveChance
    SpeedAnalysis speed;
    AccuracyBySpeed accuracyBySpeed;
    InstructionAnalysis instructions;  ///< empty where no block instructs the participant
};

/// m where some condition is tested against 1/m, so that figures show it as chance; otherwise 0.
int shownChance(const ChoiceAnalysis& choices);

/// The names of the conditions that are not tested against 1/m; figures that show chance name them.
std::vector<std::string> untestedConditions(const StudyData& data, const ChoiceAnalysis& choices);

/// Leaves out the tests of a condition against chance; shares and intervals stay. Nothing changes where `why` is empty.
void leaveUntested(ConditionChoices& choices, const std::string& why);

DPrimeRule ruleOfDPrime(const ChoiceAnalysis& choices);

/// Participants with an answer to the question: the number that matches per rendering are out of. Simulations in memory keep no
/// shares of participants; all of theirs count.
std::size_t answeringParticipants(const StudyData& data, const ChoiceAnalysis& choices);

ChoiceAnalysis analyseChoices(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const RightOrWrong& scoring, Depth depth);

}  // namespace reports
