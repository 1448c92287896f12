#include "study/records/blinded_report.h"

#include <map>
#include <nlohmann/json.hpp>

#include "reports/formats/table_cells.h"
#include "study/records/display_response_record.h"
#include "study/records/stored_study.h"
#include "study/records/study_status.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;
using reports::countCell;
using reports::Table;
using reports::textCell;

constexpr const char* withoutKey = "the study is blinded, and nobody gave its passphrase";

std::string textIn(const ordered_json& row, const char* field)
{
    return row.contains(field) && row[field].is_string() ? row[field].get<std::string>() : std::string();
}

reports::TableCell countIn(const ordered_json& row, const char* field)
{
    return row.contains(field) ? countCell(row[field].get<std::size_t>()) : reports::blankCell();
}

Table progressTable(const ordered_json& status)
{
    Table table{"progress",
                "Progress of each participant",
                {"participant", "slot", "kind", "state", "answers", "expected", "voided", "corrected", "flagged"},
                {}};
    const auto addRow = [&](const ordered_json& row, const std::string& state) {
        table.rows.push_back({textCell(textIn(row, "participant")), countIn(row, "slot"), textCell(textIn(row, "kind")),
                              textCell(state), countIn(row, "answers"), countIn(status, "answers_per_participant"),
                              countIn(row, "voided"), countIn(row, "corrected"), countIn(row, "flagged")});
    };
    for (const auto& row : status["slots"]) addRow(row, textIn(row, "state"));
    for (const auto& row : status["withdrawn"]) addRow(row, "withdrawn");
    return table;
}

Table balanceTable(const ordered_json& status)
{
    Table table{"balance", "Planned balance of the running orders", {"what", "least", "greatest"}, {}};
    for (const auto& range : status["balance"])
        table.rows.push_back({textCell(textIn(range, "what")), countIn(range, "min"), countIn(range, "max")});
    return table;
}

Table flagTable(const ordered_json& status)
{
    Table table{"flags", "Flags on the data", {"participant", "flag", "reason"}, {}};
    for (const auto& flag : status["quality"])
        table.rows.push_back(
            {textCell(textIn(flag, "participant")), textCell(textIn(flag, "flag")), textCell(textIn(flag, "why"))});
    return table;
}

}  // namespace

reports::ProgressReport blindedReport(const database::StudyStore& store)
{
    const ordered_json status = statusOf(store, {});
    reports::ProgressReport report;
    report.study = textIn(status, "study");
    report.sentences = {
        "This study is blinded. Without the owner's passphrase its report holds progress, balance and flags only."};
    for (const auto& stamp : status["stamps"]) report.sentences.push_back(stamp.get<std::string>());
    report.sentences.push_back(displayResponseSentence(store.facts()));
    report.sentences.push_back("Head of the log: " + textIn(status, "head"));
    if (status["quality"].empty()) report.sentences.emplace_back("The data have no flags.");
    report.tables = {progressTable(status), balanceTable(status), flagTable(status)};
    const ordered_json results{{"schema", "vis2hap.results/2"},
                               {"study",
                                {{"name", status["study"]},
                                 {"protocol_sha256", status["protocol_sha256"]},
                                 {"participants", status["slots"].size()},
                                 {"fabrics", store.facts().fabrics.size()},
                                 {"blinded", true},
                                 {"log_head", status["head"]}}},
                               {"questions", nullptr},
                               {"progress", status},
                               {"quality", status["quality"]},
                               {"why", {{"questions", withoutKey}}}};
    report.results = results.dump(1) + "\n";
    return report;
}

ordered_json aggregatesOf(const reports::StudyData& data)
{
    struct Sum {
        std::size_t n = 0, correct = 0;
        double sum = 0;
        bool isRating = false;
    };
    std::map<std::pair<std::string, std::string>, Sum> sums;
    for (const auto& response : data.responses) {
        Sum& sum = sums[{response.question, response.condition}];
        if (const auto* rated = std::get_if<reports::RatedAnswer>(&response.content)) {
            sum.isRating = true;
            sum.sum += rated->rating;
        } else if (const auto* chosen = std::get_if<reports::ChosenAnswer>(&response.content)) {
            sum.correct += chosen->correct;
        }
        ++sum.n;
    }
    ordered_json rows = ordered_json::array();
    for (const auto& question : data.questions)
        for (const auto& condition : data.conditions) {
            const auto found = sums.find({question.id, condition});
            const Sum sum = found == sums.end() ? Sum{} : found->second;
            ordered_json row{{"question", question.id}, {"condition", condition}, {"n", sum.n}};
            row["correct"] = sum.isRating || sum.n == 0 ? ordered_json() : ordered_json(sum.correct);
            row["mean"] = sum.isRating ? ordered_json(sum.sum / static_cast<double>(sum.n)) : ordered_json();
            rows.push_back(row);
        }
    return rows;
}

}  // namespace study::records
