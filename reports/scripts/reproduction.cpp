#include "reports/scripts/reproduction.h"

#include <variant>
#include <vector>

#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "reports/cells/response_time.h"
#include "reports/scripts/script_texts.h"

namespace reports {
namespace {

using protocols::safeCell;

/// Rows of one group of numbers: a condition, or a pair of conditions.
class NumberRows {
public:
    NumberRows(std::string& text, const char* section, const std::string& question, const std::string& a, const std::string& b)
        : m_text(text), m_begin{section, safeCell(question), safeCell(a), safeCell(b), "", ""}
    {
    }
    NumberRows& within(double low, const std::string& high)
    {
        m_begin[4] = protocols::shortest(low);
        m_begin[5] = high;
        return *this;
    }
    NumberRows& put(const char* quantity, const stats::Value& value)
    {
        auto cells = m_begin;
        cells.insert(cells.end(), {quantity, value.exists() ? protocols::shortest(*value) : ""});
        m_text += protocols::csvRow(cells);
        return *this;
    }
    NumberRows& count(const char* quantity, std::size_t number) { return put(quantity, static_cast<double>(number)); }

private:
    std::string& m_text;
    std::vector<std::string> m_begin;
};

void addComparisonNumbers(std::string& text, const std::string& question, const PairComparison& one)
{
    const stats::TTest& test = one.test;
    NumberRows(text, "comparison", question, one.pair.a, one.pair.b)
        .count("n", test.n)
        .put("mean_difference", test.estimate)
        .put("statistic", test.t)
        .put("df", test.df)
        .put("p", test.p)
        .put("p_holm", one.pHolm)
        .put("ci95_low", test.ci.low)
        .put("ci95_high", test.ci.high)
        .put("d_z", test.dZ);
}

void addEquivalenceNumbers(std::string& text, const std::string& question, const PairEquivalence& one)
{
    const stats::EquivalenceTest& test = one.test;
    NumberRows(text, "equivalence", question, one.pair.a, one.pair.b)
        .within(one.low, protocols::shortest(one.high))
        .count("n", test.n)
        .put("mean_difference", test.estimate)
        .put("p_lower", test.pLower)
        .put("p_upper", test.pUpper)
        .put("ci90_low", test.ci.low)
        .put("ci90_high", test.ci.high);
}

void addNumbers(std::string& text, const StudyData& data, const std::string& question, const ChoiceAnalysis& choices)
{
    for (std::size_t c = 0; c < data.conditions.size(); ++c) {
        const ConditionChoices& one = choices.conditions[c];
        NumberRows(text, "matches", question, data.conditions[c], "")
            .within(1.0 / choices.alternatives, "")
            .count("correct", one.count.correct)
            .count("trials", one.count.trials)
            .put("proportion", one.againstChance.estimate)
            .put("p_chance", one.againstChance.pGreater)
            .put("p_chance_participants", one.participantsAgainstChance.p);
    }
    for (const PairComparison& one : choices.comparisons) addComparisonNumbers(text, question, one);
}

void addNumbers(std::string& text, const StudyData& data, const std::string& question, const RatingAnalysis& ratings)
{
    for (std::size_t c = 0; c < data.conditions.size(); ++c) {
        const ConditionRatings& one = ratings.conditions[c];
        NumberRows(text, "ratings", question, data.conditions[c], "")
            .count("n", one.ratings)
            .put("mean", one.mean)
            .put("sd", one.sd)
            .put("ci95_low", one.ci95.low)
            .put("ci95_high", one.ci95.high);
    }
    for (const PairComparison& one : ratings.comparisons) addComparisonNumbers(text, question, one);
    for (const PairEquivalence& one : ratings.equivalences) addEquivalenceNumbers(text, question, one);
}

void addNumbers(std::string&, const StudyData&, const std::string&, const WordedAnalysis&) {}

std::string scaleOf(const StudyData& data)
{
    std::string text;
    for (const QuestionInfo& question : data.questions)
        if (const auto scoring = scoringOf(question.kind); const auto* scale = std::get_if<NumberOnScale>(&scoring))
            text += (text.empty() ? "" : "; ") + question.id + ": " + protocols::shortest(scale->min) + " to " +
                    protocols::shortest(scale->max);
    return text;
}

std::string namesOf(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
    return text;
}

std::string codebookCsv(const StudyData& data)
{
    std::vector<std::string> questions;
    for (const QuestionInfo& question : data.questions) questions.push_back(question.id);
    const std::vector<std::vector<std::string>> rows{
        {"file", "column", "type", "unit", "values", "meaning"},
        {"answers.csv", "participant", "text", "", "", "who answered"},
        {"answers.csv", "question", "text", "", safeCell(namesOf(questions)), "id of the question"},
        {"answers.csv", "fabric", "text", "", safeCell(namesOf(data.fabrics)), "the true fabric"},
        {"answers.csv", "condition", "text", "", safeCell(namesOf(data.conditions)), "input condition of the rendering"},
        {"answers.csv", "instruction", "text", "", "", "what the block asked of the speed; empty where it asked nothing"},
        {"answers.csv", "repetition", "text", "", "", "of a cell that is asked more than once"},
        {"answers.csv", "trial", "whole number", "", "from 1", "place in the running order; empty where unknown"},
        {"answers.csv", "correct", "whole number", "", "0; 1", "of a choice: 1 is right"},
        {"answers.csv", "rating", "number", "points of the scale", safeCell(scaleOf(data)), "of a rating"},
        {"answers.csv", "seconds", "number", "s", "", "time that the report uses; empty where there is none"},
        {"expected.csv", "section", "text", "", "matches; ratings; comparison; equivalence", "kind of test"},
        {"expected.csv", "question", "text", "", "", "id of the question"},
        {"expected.csv", "a", "text", "", "", "condition, or the first of a pair"},
        {"expected.csv", "b", "text", "", "", "second condition of a pair; differences are a - b"},
        {"expected.csv", "low", "number", "", "", "chance of a match, or the lower bound of equivalence"},
        {"expected.csv", "high", "number", "", "", "upper bound of equivalence"},
        {"expected.csv", "quantity", "text", "", "", "name as in results.json; ci95_low and ci95_high are the ends of ci95"},
        {"expected.csv", "value", "number", "", "", "as the report has it; empty where it does not exist"}};
    std::string text;
    for (const auto& row : rows) text += protocols::csvRow(row);
    return text;
}

template <class T, class ToText>
std::string textIfThere(const std::optional<T>& value, ToText toText)
{
    return value ? toText(*value) : std::string();
}

}  // namespace

std::string expectedNumbersCsv(const StudyAnalysis& analysis)
{
    std::string text = protocols::csvRow({"section", "question", "a", "b", "low", "high", "quantity", "value"});
    for (const QuestionAnalysis& question : analysis.questions)
        std::visit([&](const auto& findings) { addNumbers(text, analysis.data, question.question.id, findings); },
                   question.findings);
    return text;
}

std::string analysedAnswersCsv(const StudyData& data)
{
    std::string text = protocols::csvRow(
        {"participant", "question", "fabric", "condition", "instruction", "repetition", "trial", "correct", "rating", "seconds"});
    const auto number = [](double value) { return protocols::shortest(value); };
    for (const StudyResponse& response : data.responses) {
        const auto* chosen = std::get_if<ChosenAnswer>(&response.content);
        const auto* rated = std::get_if<RatedAnswer>(&response.content);
        if (chosen == nullptr && rated == nullptr) continue;
        text += protocols::csvRow({safeCell(response.participant), safeCell(response.question), safeCell(response.fabric),
                                   safeCell(response.condition), safeCell(response.instruction), safeCell(response.repetition),
                                   textIfThere(response.trial, [](int trial) { return std::to_string(trial); }),
                                   chosen ? std::string(chosen->correct ? "1" : "0") : "", rated ? number(rated->rating) : "",
                                   textIfThere(responseTimeOf(response), number)});
    }
    return text;
}

void writeReproduction(const StudyAnalysis& analysis, const std::filesystem::path& folder)
{
    const auto write = [&](const char* name, std::string_view text) {
        protocols::writeWholeFile(folder / name, text, protocols::Sync::Later);
    };
    write("answers.csv", analysedAnswersCsv(analysis.data));
    write("expected.csv", expectedNumbersCsv(analysis));
    write("codebook.csv", codebookCsv(analysis.data));
    write("analysis.R", scripts::inR());
    write("analysis.py", scripts::inPython());
}

}  // namespace reports
