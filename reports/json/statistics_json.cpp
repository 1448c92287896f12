// statistics.json: the further numbers of the report, named and nested as the reference report has them.
#include "reports/analysis/answer_cells.h"
#include "reports/analysis/quality_flags.h"
#include "reports/analysis/screening.h"
#include "reports/json/statistic_parts.h"
#include "reports/text/number_text.h"
#include "reports/write_report.h"
#include "stats/tests/speed_accuracy.h"

namespace reports {
namespace {

Json missingPart(const StudyData& data, const Cells& cells)
{
    Json missing = Json::object();
    const std::size_t whole = data.participants.size() * data.fabrics.size();
    for (const QuestionInfo& question : data.questions)
        for (const std::string& condition : data.conditions) {
            const std::size_t present = cells.of(question.id, condition).size();
            missing[question.id][condition] = whole > present ? whole - present : 0;
        }
    return missing;
}

Json dataPart(const StudyData& data, const Cells& cells)
{
    const Completeness completeness = completenessOf(data, cells);
    Json questions = Json::array();
    for (const QuestionInfo& question : data.questions)
        questions.push_back({{"id", question.id}, {"text", question.text}, {"kind", question.isChoice ? "choice" : "rating"}});
    return {{"participants", data.participants},
            {"fabrics", data.fabrics},
            {"conditions", data.conditions},
            {"questions", questions},
            {"alternatives", data.alternatives},
            {"scale", {data.scaleMin, data.scaleMax}},
            {"scripted", data.scripted},
            {"stamps", data.stamps},
            {"responses", completeness.present},
            {"expected_responses", completeness.expected},
            {"missing_responses", completeness.missing()},
            {"missing_by_condition", missingPart(data, cells)},
            {"voided_presentations", data.voided}};
}

Json responseTimesPart(const StudyData& data, const Cells& cells)
{
    Json part = Json::object();
    for (const QuestionInfo& question : data.questions)
        for (const std::string& condition : data.conditions) {
            const stats::ResponseTimes times = stats::responseTimes(secondsOf(cells.of(question.id, condition)));
            Json row{{"n", times.n}};
            put(row, "median_seconds", times.median);
            put(row, "mean_seconds", times.mean);
            put(row, "log_mean", times.logMean);
            put(row, "geometric_mean_seconds", times.geometricMean);
            part[question.id][condition] = std::move(row);
        }
    return part;
}

}  // namespace

nlohmann::ordered_json statistics(const StudyData& data)
{
    const Cells cells(data);
    Json statistics{{"schema", "vis2hap.statistics/1"}, {"data", dataPart(data, cells)}};
    for (const QuestionInfo& question : data.questions) {
        if (!question.isChoice) {
            statistics[question.id] = ratingStatistics(data, cells, question.id);
            continue;
        }
        putChoiceStatistics(statistics, data, cells, question.id);
    }
    statistics["screening"] = screeningPart(data, cells);
    statistics["response_times"] = responseTimesPart(data, cells);
    return statistics;
}

}  // namespace reports
