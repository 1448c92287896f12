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

std::string placeOf(const Response& response)
{
    return response.participant + ", " + response.fabric + ", " + response.condition + ", " + response.question;
}

void requireListed(const StudyData& data, const Response& response)
{
    const bool hasQuestion = std::any_of(data.questions.begin(), data.questions.end(),
                                         [&](const QuestionInfo& question) { return question.id == response.question; });
    if (hasQuestion && holds(data.participants, response.participant) && holds(data.fabrics, response.fabric) &&
        holds(data.conditions, response.condition))
        return;
    throw protocols::workFailed({"an answer belongs to nothing that the study lists", placeOf(response),
                                 "a listed participant, fabric, condition and question", ""});
}

double valueOf(const Response& response)
{
    if (response.rating) return *response.rating;
    return *response.correct ? 1 : 0;
}

}  // namespace

Cells::Cells(const StudyData& data) : m_data(data), m_participants(data.participants)
{
    std::sort(m_participants.begin(), m_participants.end());
    for (const Response& response : data.responses) {
        requireListed(data, response);
        if (!response.rating && !response.correct) continue;
        auto& slot = m_cells[{response.question, response.condition}][response.participant][response.fabric];
        if (slot != nullptr) throw protocols::workFailed({"a question has two current answers", placeOf(response), "one", ""});
        slot = &response;
    }
}

const Cells::ByParticipant* Cells::find(const std::string& question, const std::string& condition) const
{
    const auto found = m_cells.find({question, condition});
    return found == m_cells.end() ? nullptr : &found->second;
}

std::vector<const Response*> Cells::of(const std::string& question, const std::string& condition) const
{
    std::vector<const Response*> result;
    if (const ByParticipant* cells = find(question, condition))
        for (const auto& [participant, fabrics] : *cells)
            for (const auto& [fabric, response] : fabrics) result.push_back(response);
    return result;
}

std::vector<const Response*> Cells::of(const std::string& question, const std::string& condition,
                                       const std::string& participant) const
{
    std::vector<const Response*> result;
    if (const ByParticipant* cells = find(question, condition))
        if (const auto found = cells->find(participant); found != cells->end())
            for (const auto& [fabric, response] : found->second) result.push_back(response);
    return result;
}

stats::Value Cells::participantMean(const std::string& question, const std::string& condition,
                                    const std::string& participant) const
{
    return stats::meanOf(valuesOf(of(question, condition, participant)));
}

std::vector<double> Cells::participantMeans(const std::string& question, const std::string& condition) const
{
    std::vector<double> means;
    for (const std::string& participant : m_participants)
        if (const stats::Value mean = participantMean(question, condition, participant); mean.exists()) means.push_back(*mean);
    return means;
}

Cells::CompleteBlocks Cells::completeBlocks(const std::string& question, const std::vector<std::string>& conditions) const
{
    CompleteBlocks blocks;
    std::vector<std::vector<double>> rows;
    for (const std::string& participant : m_participants) {
        std::vector<double> row;
        for (const std::string& condition : conditions)
            if (const stats::Value mean = participantMean(question, condition, participant); mean.exists()) row.push_back(*mean);
        if (row.size() == conditions.size() && !row.empty()) {
            blocks.participants.push_back(participant);
            rows.push_back(std::move(row));
        }
    }
    blocks.table = stats::blockTableOf(rows).table;
    blocks.table.conditions = conditions.size();
    return blocks;
}

stats::BlockTable Cells::completeSuccesses(const std::string& question, const std::vector<std::string>& conditions) const
{
    std::map<std::pair<std::string, std::string>, std::vector<double>> rows;
    for (const std::string& condition : conditions)
        for (const Response* response : of(question, condition))
            rows[{response->participant, response->fabric}].push_back(valueOf(*response));
    std::vector<std::vector<double>> complete;
    for (auto& [place, row] : rows)
        if (row.size() == conditions.size()) complete.push_back(std::move(row));
    stats::BlockTable table = stats::blockTableOf(complete).table;
    table.conditions = conditions.size();
    return table;
}

Cells::Pairs Cells::pairs(const std::string& question, const std::string& a, const std::string& b) const
{
    Pairs pairs;
    for (const std::string& participant : m_participants) {
        const stats::Value first = participantMean(question, a, participant);
        const stats::Value second = participantMean(question, b, participant);
        if (first.exists() && second.exists()) {
            pairs.a.push_back(*first);
            pairs.b.push_back(*second);
        }
    }
    return pairs;
}

std::size_t Cells::answered(const std::string& question) const
{
    std::size_t count = 0;
    for (const std::string& condition : m_data.conditions) count += of(question, condition).size();
    return count;
}

std::vector<double> valuesOf(const std::vector<const Response*>& responses)
{
    std::vector<double> values;
    values.reserve(responses.size());
    for (const Response* response : responses) values.push_back(valueOf(*response));
    return values;
}

std::vector<double> secondsOf(const std::vector<const Response*>& responses)
{
    std::vector<double> seconds;
    for (const Response* response : responses)
        if (response->seconds) seconds.push_back(*response->seconds);
    return seconds;
}

}  // namespace reports
