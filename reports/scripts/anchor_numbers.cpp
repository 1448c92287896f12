#include "reports/scripts/anchor_numbers.h"

#include <vector>

#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "reports/cells/anchor_answers.h"

namespace reports {
namespace {

/// A rating, or the alternative that was chosen, or its outcome; empty for words, and where only right and wrong are known.
std::string anchorCell(const StudyResponse& response, bool byOutcome)
{
    if (const auto* rated = std::get_if<RatedAnswer>(&response.content)) return protocols::shortest(rated->rating);
    const auto* chosen = std::get_if<ChosenAnswer>(&response.content);
    if (chosen != nullptr && byOutcome) return chosen->correct ? "right" : "wrong";
    return chosen != nullptr ? protocols::safeCell(chosen->answer.value_or("")) : std::string();
}

void addAnchorRow(std::string& text, const StudyResponse& first, const StudyResponse* second, bool byOutcome = false)
{
    const std::string before = anchorCell(first, byOutcome);
    const std::string after = second != nullptr ? anchorCell(*second, byOutcome) : std::string();
    if (before.empty() || (second != nullptr && after.empty())) return;
    text += protocols::csvRow({protocols::safeCell(first.participant), protocols::safeCell(first.question),
                               protocols::safeCell(first.fabric), protocols::safeCell(first.condition),
                               second != nullptr ? "repeated" : "mismatched", before, after});
}

}  // namespace

std::string anchorAnswersCsv(const StudyData& data)
{
    if (data.mismatchedResponses.empty() && data.repeatedResponses.empty()) return {};
    std::string text = protocols::csvRow({"participant", "question", "fabric", "condition", "kind", "first", "second"});
    for (const StudyResponse& response : data.mismatchedResponses) addAnchorRow(text, response, nullptr);
    for (const QuestionInfo& question : data.questions)
        for (const auto& [participant, pairs] : answersTwice(data, question.id))
            for (const auto& [first, second] : pairs) addAnchorRow(text, *first, second, agreesByOutcome(data, question));
    return text;
}

std::string anchorCodebookRows()
{
    const std::vector<std::vector<std::string>> rows{
        {"anchors.csv", "participant", "text", "", "", "who answered"},
        {"anchors.csv", "question", "text", "", "", "id of the question"},
        {"anchors.csv", "fabric", "text", "", "", "fabric of the image"},
        {"anchors.csv", "condition", "text", "", "", "input condition of the image"},
        {"anchors.csv", "kind", "text", "", "mismatched; repeated",
         "mismatched: another fabric lay on the tray; repeated: the presentation came twice"},
        {"anchors.csv", "first", "text", "", "",
         "the rating or the choice; right or wrong where a choice came again beside other foils; of a repeated presentation the "
         "earlier one"},
        {"anchors.csv", "second", "text", "", "", "the later one of a repeated presentation"}};
    std::string text;
    for (const auto& row : rows) text += protocols::csvRow(row);
    return text;
}

}  // namespace reports
