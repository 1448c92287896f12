#include "reports/analysis/study_analysis.h"

#include "reports/write_report.h"

namespace reports {

Analysis analyse(const StudyData& data) { return {data, results(data), statistics(data)}; }

std::string lowerCase(std::string text)
{
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

std::size_t countOf(const Json& object, const std::string& key)
{
    return object.is_object() && object.contains(key) && object[key].is_number_integer() ? object[key].get<std::size_t>() : 0;
}

std::vector<std::string> conditionsOf(const Json& results) { return results["conditions"].get<std::vector<std::string>>(); }

namespace {

std::vector<std::string> questionsWith(const Json& results, const std::string& field)
{
    std::vector<std::string> ids;
    const auto conditions = conditionsOf(results);
    for (const auto& [key, part] : results.items())
        if (!conditions.empty() && part.is_object() && part.contains(conditions.front()) &&
            part[conditions.front()].contains(field))
            ids.push_back(key);
    return ids;
}

}  // namespace

std::vector<std::string> choiceQuestions(const Json& results) { return questionsWith(results, "trials"); }

std::vector<std::string> ratingQuestions(const Json& results) { return questionsWith(results, "participants"); }

}  // namespace reports
