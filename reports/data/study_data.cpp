#include "reports/data/study_data.h"

#include <algorithm>

namespace reports {

int StudyData::alternativesOf(const std::string& question) const
{
    const auto found = std::find_if(questions.begin(), questions.end(), [&](const QuestionInfo& q) { return q.id == question; });
    return found == questions.end() || found->alternatives == 0 ? alternatives : found->alternatives;
}

}  // namespace reports
