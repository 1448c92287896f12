#include "study/records/blinded_report.h"

#include <nlohmann/json.hpp>

#include "reports/cells/blinded_means.h"
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
    Table table{"balance", "Balance of other running orders by the same rules", {"what", "least", "greatest"}, {}};
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

Aggregates aggregatesOf(const std::optional<reports::StudyData>& data)
{
    if (!data) return {ordered_json::array(), withoutKey};
    const reports::BlindedMeans means = reports::blindedMeans(*data);
    Aggregates aggregates{ordered_json::array(), means.why};
    for (const reports::BlindedQuestion& question : means.questions)
        for (const reports::BlindedMean& mean : question.conditions) {
            const ordered_json value = mean.mean.exists() ? ordered_json(*mean.mean) : ordered_json();
            aggregates.rows.push_back({{"question", question.question.id},
                                       {"condition", mean.condition},
                                       {"n", mean.n},
                                       {"share", question.isChosen() ? value : ordered_json()},
                                       {"mean", question.isRated() ? value : ordered_json()}});
        }
    return aggregates;
}

}  // namespace study::records
