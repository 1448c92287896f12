// The analysed study as every document shows it: the data, results.json and statistics.json.
#pragma once

#include <string>
#include <vector>

#include "reports/data/study_data.h"
#include "reports/text/number_text.h"

namespace reports {

struct Analysis {
    const StudyData& data;
    Json results;
    Json statistics;
};

Analysis analyse(const StudyData& data);

/// "Q1" -> "q1", as in the names of files and of statistics.
std::string lowerCase(std::string text);

/// A whole number of an object; 0 where it is missing or null.
std::size_t countOf(const Json& object, const std::string& key);

std::vector<std::string> conditionsOf(const Json& results);
/// Ids of the choice questions, and of the rating questions, in their order.
std::vector<std::string> choiceQuestions(const Json& results);
std::vector<std::string> ratingQuestions(const Json& results);

}  // namespace reports
