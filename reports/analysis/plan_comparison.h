// What was planned beside what was done.
#pragma once

#include <string>
#include <vector>

namespace reports {

struct StudyAnalysis;

enum class Accord {
    AsPlanned,
    Deviates,
    Unknown,  ///< nothing was planned or registered, or it is left out while the study is blinded
};

struct PlanRow {
    std::string item;  ///< "participants"
    std::string planned;
    std::string done;
    Accord accord = Accord::Unknown;
};

/// A planned contrast and the questions in which it was tested.
struct ContrastDone {
    std::string a;
    std::string b;
    bool primary = false;
    std::vector<std::string> testedIn;    ///< ids of questions
    std::vector<std::string> untested;    ///< ids of questions in which there was no test
    std::vector<std::string> unanswered;  ///< its conditions without any answer
    std::string why;                      ///< reason of the first question without a test
};

struct PlanComparison {
    std::vector<PlanRow> rows;            ///< empty where no plan is known
    std::vector<ContrastDone> contrasts;  ///< in the order of the plan; empty while blinded
};

/// "h_g&f_g - h&f", as JSON and CSV have it.
std::string contrastName(const ContrastDone& contrast);

/// Compares the plan of `analysis.data` with its answers and claims.
PlanComparison comparePlan(const StudyAnalysis& analysis);

/// The rows that deviate.
std::vector<PlanRow> deviationsOf(const PlanComparison& plan);

/// "yes", "no" or "-".
std::string nameOf(Accord accord);

}  // namespace reports
