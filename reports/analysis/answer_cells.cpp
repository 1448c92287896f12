#include "reports/analysis/answer_cells.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string placeOf(const StudyResponse& response)
{
    return response.participant + ", " + response.fabric + ", " + response.condition + ", " + response.question;
}

bool fits(const AnswerContent& content, const Scoring& scoring)
{
    return std::visit(protocols::Overloaded{
                          [&](const ChosenAnswer&) { return std::holds_alternative<RightOrWrong>(scoring); },
                          [&](const RatedAnswer&) { return std::holds_alternative<NumberOnScale>(scoring); },
                          [&](const WordedAnswer&) { return std::holds_alternative<OpenWords>(scoring); },
                      },
                      content);
}

void requireListed(const StudyData& data, const std::map<std::string, Scoring>& scorings, const StudyResponse& response)
{
    const auto question = scorings.find(response.question);
    const bool isListed = question != scorings.end() && holds(data.participants, response.participant) &&
                          holds(data.fabrics, response.fabric) && holds(data.conditions, response.condition);
    if (!isListed)
        throw protocols::workFailed({"an answer belongs to nothing that the study lists", placeOf(response),
                                     "a listed participant, fabric, condition and question", ""});
    if (!fits(response.content, question->second))
        throw protocols::workFailed({"an answer is of another kind than its question", placeOf(response),
                                     "a choice, a rating or words, as the question asks", ""});
}

std::optional<double> numberOf(const AnswerContent& content)
{
    using Number = std::optional<double>;
    return std::visit(protocols::Overloaded{
                          [](const ChosenAnswer& choice) { return Number(choice.correct ? 1 : 0); },
                          [](const RatedAnswer& rated) { return Number(rated.rating); },
                          [](const WordedAnswer&) { return Number(); },
                      },
                      content);
}

}  // namespace

AnswerCells::AnswerCells(const StudyData& data) : m_data(data), m_participants(data.participants)
{
    std::sort(m_participants.begin(), m_participants.end());
    std::map<std::string, Scoring> scorings;
    for (const QuestionInfo& question : data.questions) scorings[question.id] = scoringOf(question.kind);
    for (const StudyResponse& response : data.responses) {
        requireListed(data, scorings, response);
        auto& cell = m_cells[{response.question, response.condition}][response.participant][response.fabric];
        if (cell != nullptr)
            throw protocols::workFailed({"a question has two current answers", placeOf(response), "one answer", ""});
        cell = &response;
    }
}

const AnswerCells::ByParticipant* AnswerCells::find(const std::string& question, const std::string& condition) const
{
    const auto found = m_cells.find({question, condition});
    return found == m_cells.end() ? nullptr : &found->second;
}

std::vector<const StudyResponse*> AnswerCells::of(const std::string& question, const std::string& condition) const
{
    std::vector<const StudyResponse*> result;
    if (const ByParticipant* cells = find(question, condition))
        for (const auto& [participant, fabrics] : *cells)
            for (const auto& [fabric, response] : fabrics) result.push_back(response);
    return result;
}

std::vector<const StudyResponse*> AnswerCells::of(const std::string& question, const std::string& condition,
                                                  const std::string& participant) const
{
    std::vector<const StudyResponse*> result;
    if (const ByParticipant* cells = find(question, condition))
        if (const auto found = cells->find(participant); found != cells->end())
            for (const auto& [fabric, response] : found->second) result.push_back(response);
    return result;
}

std::vector<const StudyResponse*> AnswerCells::ofParticipant(const std::string& question, const std::string& participant) const
{
    std::vector<const StudyResponse*> result;
    for (const std::string& condition : m_data.conditions) {
        const auto part = of(question, condition, participant);
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

stats::Value AnswerCells::participantMean(const std::string& question, const std::string& condition,
                                          const std::string& participant) const
{
    return stats::meanOf(valuesOf(of(question, condition, participant)));
}

std::vector<double> AnswerCells::participantMeans(const std::string& question, const std::string& condition) const
{
    std::vector<double> means;
    for (const std::string& participant : m_participants)
        if (const stats::Value mean = participantMean(question, condition, participant); mean.exists()) means.push_back(*mean);
    return means;
}

AnswerCells::CompleteBlocks AnswerCells::completeBlocks(const std::string& question) const
{
    CompleteBlocks blocks;
    std::vector<std::vector<double>> rows;
    for (const std::string& participant : m_participants) {
        std::vector<double> row;
        for (const std::string& condition : m_data.conditions)
            if (const stats::Value mean = participantMean(question, condition, participant); mean.exists()) row.push_back(*mean);
        if (row.size() == m_data.conditions.size() && !row.empty()) {
            blocks.participants.push_back(participant);
            rows.push_back(std::move(row));
        }
    }
    blocks.table = stats::blockTableOf(rows).table;
    blocks.table.conditions = m_data.conditions.size();
    return blocks;
}

stats::BlockTable AnswerCells::completeSuccesses(const std::string& question) const
{
    std::map<std::pair<std::string, std::string>, std::vector<double>> rows;
    for (const std::string& condition : m_data.conditions)
        for (const StudyResponse* response : of(question, condition))
            if (const auto number = numberOf(response->content))
                rows[{response->participant, response->fabric}].push_back(*number);
    std::vector<std::vector<double>> complete;
    for (auto& [place, row] : rows)
        if (row.size() == m_data.conditions.size()) complete.push_back(std::move(row));
    stats::BlockTable table = stats::blockTableOf(complete).table;
    table.conditions = m_data.conditions.size();
    return table;
}

AnswerCells::PairedMeans AnswerCells::pairedMeans(const std::string& question, const std::string& a, const std::string& b) const
{
    PairedMeans means;
    for (const std::string& participant : m_participants) {
        const stats::Value first = participantMean(question, a, participant);
        const stats::Value second = participantMean(question, b, participant);
        if (first.exists() && second.exists()) {
            means.a.push_back(*first);
            means.b.push_back(*second);
        }
    }
    return means;
}

std::size_t AnswerCells::answered(const std::string& question) const
{
    std::size_t count = 0;
    for (const std::string& condition : m_data.conditions) count += of(question, condition).size();
    return count;
}

std::vector<double> valuesOf(const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> values;
    values.reserve(responses.size());
    for (const StudyResponse* response : responses)
        if (const auto number = numberOf(response->content)) values.push_back(*number);
    return values;
}

std::vector<double> secondsOf(const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> seconds;
    for (const StudyResponse* response : responses)
        if (response->seconds) seconds.push_back(*response->seconds);
    return seconds;
}

std::size_t correctAmong(const std::vector<double>& values)
{
    return static_cast<std::size_t>(std::count(values.begin(), values.end(), 1.0));
}

}  // namespace reports
