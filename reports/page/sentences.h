// Results as sentences for a paper, in the form of the American Psychological Association (Publication Manual, 7th edition).
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// The sentences about one question: all conditions at once, each condition against chance, then the contrasts.
struct QuestionSentences {
    std::string question;                ///< id, plain text
    std::vector<std::string> overall;    ///< HTML, as are the others
    std::vector<std::string> chance;     ///< choices only
    std::vector<std::string> contrasts;  ///< in the order of the claims, one for each pair of conditions
};

/// Every question with tests; none of a blinded study, whose analysis has no questions.
std::vector<QuestionSentences> paperSentences(const StudyAnalysis& analysis);

/// The section of the page: how to read the sentences, then those of each question. Empty where there are none.
std::string sentencesLead(const StudyAnalysis& analysis);

}  // namespace reports
