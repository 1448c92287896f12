#include "reports/cells/answer_cells.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "protocols/files/errors.h"
#include "reports/cells/common_units.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

/// Place of each name in a list.
std::unordered_map<std::string, std::size_t> placesIn(const std::vector<std::string>& names)
{
    std::unordered_map<std::string, std::size_t> places;
    for (const std::string& name : names) places.emplace(name, places.size());
    return places;
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

[[noreturn]] void refuseUnlisted(const StudyResponse& response)
{
    throw protocols::workFailed({"an answer belongs to nothing that the study lists", placeOf(response),
                                 "a listed participant, fabric, condition and question", ""});
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

/// None where whole cells are compared.
std::optional<CommonUnits> unitsOfMeans(const AnswerCells& cells, const std::string& question,
                                        const std::vector<std::string>& conditions, AnswersOfMeans over)
{
    if (over == AnswersOfMeans::All || cells.mostAnswers(question) < 2) return std::nullopt;
    return CommonUnits(cells, question, conditions);
}

bool haveUnequalRepetitions(const AnswerCells& cells, const std::string& question, const std::vector<std::string>& conditions)
{
    for (std::size_t a = 0; a < conditions.size(); ++a)
        for (std::size_t b = a + 1; b < conditions.size(); ++b) {
            const CommonUnits units(cells, question, {conditions[a], conditions[b]});
            for (const std::string& participant : cells.participants())
                if (cells.participantMean(question, conditions[a], participant).exists() &&
                    cells.participantMean(question, conditions[b], participant).exists() && units.leavesOutAnswers(participant))
                    return true;
        }
    return false;
}

}  // namespace

AnswerCells::AnswerCells(const StudyData& data)
    : m_data(data), m_participants(data.participants), m_conditionPlaces(placesIn(data.conditions))
{
    std::sort(m_participants.begin(), m_participants.end());
    m_participantPlaces = placesIn(m_participants);
    std::vector<Scoring> scorings;
    for (const QuestionInfo& question : data.questions) {
        m_questionPlaces.emplace(question.id, scorings.size());
        scorings.push_back(scoringOf(question.kind));
    }
    std::vector<std::string> fabrics = data.fabrics;
    std::sort(fabrics.begin(), fabrics.end());
    const Places fabricPlaces = placesIn(fabrics);
    const auto placeIn = [](const Places& places, const std::string& name, const StudyResponse& response) {
        const auto found = places.find(name);
        if (found == places.end()) refuseUnlisted(response);
        return found->second;
    };

    struct Sorted {
        std::size_t run;
        std::size_t fabric;
        const StudyResponse* response;
    };
    std::vector<Sorted> sorted;
    sorted.reserve(data.responses.size());
    for (const StudyResponse& response : data.responses) {
        const std::size_t question = placeIn(m_questionPlaces, response.question, response);
        sorted.push_back({runOf(question, placeIn(m_conditionPlaces, response.condition, response),
                                placeIn(m_participantPlaces, response.participant, response)),
                          placeIn(fabricPlaces, response.fabric, response), &response});
        if (!fits(response.content, scorings[question]))
            throw protocols::workFailed({"an answer is of another kind than its question", placeOf(response),
                                         "a choice, a rating or words, as the question asks", ""});
    }
    const auto isSameCell = [](const Sorted& a, const Sorted& b) { return a.run == b.run && a.fabric == b.fabric; };
    std::sort(sorted.begin(), sorted.end(), [&](const Sorted& a, const Sorted& b) {
        if (!isSameCell(a, b)) return std::pair(a.run, a.fabric) < std::pair(b.run, b.fabric);
        return a.response->repetition < b.response->repetition;
    });
    m_mostAnswers.assign(data.questions.size(), 0);
    std::size_t inCell = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        inCell = i > 0 && isSameCell(sorted[i - 1], sorted[i]) ? inCell + 1 : 1;
        std::size_t& most = m_mostAnswers[sorted[i].run / (data.conditions.size() * m_participants.size())];
        most = std::max(most, inCell);
    }
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (isSameCell(sorted[i - 1], sorted[i]) && sorted[i - 1].response->repetition == sorted[i].response->repetition)
            throw protocols::workFailed(
                {"a question has two current answers", placeOf(*sorted[i].response), "one answer, or names of repetitions", ""});

    const std::size_t runs = data.questions.size() * data.conditions.size() * m_participants.size();
    m_starts.reserve(runs + 1);
    m_answers.reserve(sorted.size());
    for (const Sorted& one : sorted) {
        while (m_starts.size() <= one.run) m_starts.push_back(m_answers.size());
        m_answers.push_back(one.response);
    }
    while (m_starts.size() <= runs) m_starts.push_back(m_answers.size());
    for (std::size_t run = 0; run < runs; ++run) {
        std::vector<double> means;
        m_cellStarts.push_back(m_cells.size());
        for (const CellMean& cell : cellsOfRun(run, 0)) {
            means.push_back(cell.mean);
            m_cells.push_back({fabricPlaces.at(cell.first->fabric), cell.mean});
        }
        m_means.push_back(stats::meanOf(means));
    }
    m_cellStarts.push_back(m_cells.size());
}

std::size_t AnswerCells::firstRun(const std::string& question, const std::string& condition) const
{
    return runOf(m_questionPlaces.at(question), m_conditionPlaces.at(condition), 0);
}

std::vector<const StudyResponse*> AnswerCells::of(const std::string& question, const std::string& condition) const
{
    const std::size_t run = firstRun(question, condition);
    const auto at = [&](std::size_t one) { return m_answers.begin() + static_cast<std::ptrdiff_t>(m_starts[one]); };
    return {at(run), at(run + m_participants.size())};
}

std::vector<const StudyResponse*> AnswerCells::of(const std::string& question, const std::string& condition,
                                                  const std::string& participant) const
{
    const std::size_t run = firstRun(question, condition) + m_participantPlaces.at(participant);
    const auto at = [&](std::size_t one) { return m_answers.begin() + static_cast<std::ptrdiff_t>(m_starts[one]); };
    return {at(run), at(run + 1)};
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

std::vector<AnswerCells::CellMean> AnswerCells::cellsOfRun(std::size_t run, std::size_t participant) const
{
    std::vector<CellMean> cells;
    std::vector<double> values;
    for (std::size_t i = m_starts[run]; i < m_starts[run + 1]; ++i) {
        if (const auto number = numberOf(m_answers[i]->content)) values.push_back(*number);
        const bool isLast = i + 1 == m_starts[run + 1] || m_answers[i + 1]->fabric != m_answers[i]->fabric;
        if (!isLast) continue;
        if (!values.empty()) cells.push_back({participant, m_answers[i], *stats::meanOf(values), values.size()});
        values.clear();
    }
    return cells;
}

std::vector<AnswerCells::CellMean> AnswerCells::cellMeans(const std::string& question, const std::string& condition) const
{
    std::vector<CellMean> cells;
    const std::size_t first = firstRun(question, condition);
    for (std::size_t participant = 0; participant < m_participants.size(); ++participant) {
        const std::vector<CellMean> some = cellsOfRun(first + participant, participant);
        cells.insert(cells.end(), some.begin(), some.end());
    }
    return cells;
}

const stats::Value& AnswerCells::participantMean(const std::string& question, const std::string& condition,
                                                 const std::string& participant) const
{
    return m_means[firstRun(question, condition) + m_participantPlaces.at(participant)];
}

std::vector<double> AnswerCells::participantMeans(const std::string& question, const std::string& condition) const
{
    std::vector<double> means;
    const std::size_t first = firstRun(question, condition);
    for (std::size_t i = 0; i < m_participants.size(); ++i)
        if (m_means[first + i].exists()) means.push_back(*m_means[first + i]);
    return means;
}

std::span<const AnswerCells::FabricMean> AnswerCells::fabricsIn(std::size_t run) const
{
    return std::span(m_cells).subspan(m_cellStarts[run], m_cellStarts[run + 1] - m_cellStarts[run]);
}

bool AnswerCells::haveSameFabrics(std::size_t run, std::size_t other) const
{
    return std::ranges::equal(fabricsIn(run), fabricsIn(other), {}, &FabricMean::fabric, &FabricMean::fabric);
}

std::vector<double> AnswerCells::meansOfRuns(std::span<const std::size_t> runs, AnswersOfMeans over) const
{
    std::vector<double> means;
    for (const std::size_t run : runs) {
        if (!m_means[run].exists()) return {};
        means.push_back(*m_means[run]);
    }
    const auto isLikeFirst = [&](std::size_t run) { return haveSameFabrics(run, runs.front()); };
    if (over == AnswersOfMeans::All || std::ranges::all_of(runs, isLikeFirst)) return means;
    std::map<std::size_t, std::size_t> answered;
    for (const std::size_t run : runs)
        for (const FabricMean& cell : fabricsIn(run)) ++answered[cell.fabric];
    for (std::size_t i = 0; i < runs.size(); ++i) {
        std::vector<double> common;
        for (const FabricMean& cell : fabricsIn(runs[i]))
            if (answered[cell.fabric] == runs.size()) common.push_back(cell.mean);
        if (common.empty()) return {};
        means[i] = *stats::meanOf(common);
    }
    return means;
}

bool AnswerCells::haveUnequalAnswers(const std::string& question) const
{
    if (mostAnswers(question) > 1) return haveUnequalRepetitions(*this, question, m_data.conditions);
    for (std::size_t i = 0; i < m_participants.size(); ++i) {
        std::optional<std::size_t> first;
        for (const std::string& condition : m_data.conditions) {
            const std::size_t run = firstRun(question, condition) + i;
            if (!m_means[run].exists()) continue;
            if (first && !haveSameFabrics(*first, run)) return true;
            first = run;
        }
    }
    return false;
}

AnswerCells::CompleteBlocks AnswerCells::completeBlocks(const std::string& question, AnswersOfMeans over) const
{
    const std::optional<CommonUnits> units = unitsOfMeans(*this, question, m_data.conditions, over);
    CompleteBlocks blocks;
    std::vector<std::vector<double>> rows;
    std::vector<std::size_t> runs(m_data.conditions.size());
    for (std::size_t i = 0; i < m_participants.size(); ++i) {
        for (std::size_t c = 0; c < runs.size(); ++c) runs[c] = firstRun(question, m_data.conditions[c]) + i;
        std::vector<double> row = units ? units->means(m_participants[i]) : meansOfRuns(runs, over);
        if (!row.empty()) {
            blocks.participants.push_back(m_participants[i]);
            rows.push_back(std::move(row));
        }
    }
    blocks.table = stats::blockTableOf(rows).table;
    blocks.table.conditions = m_data.conditions.size();
    return blocks;
}

stats::BlockTable AnswerCells::completeSuccesses(const std::string& question) const
{
    const CommonUnits units(*this, question, m_data.conditions);
    std::vector<std::vector<double>> complete;
    for (const std::string& participant : m_participants) {
        const AnswersByCondition answers = units.pairedAnswers(participant);
        for (std::size_t i = 0; !answers.empty() && i < answers.front().size(); ++i) {
            std::vector<double>& row = complete.emplace_back();
            for (const auto& ofCondition : answers)
                if (const auto number = numberOf(ofCondition[i]->content)) row.push_back(*number);
        }
    }
    stats::BlockTable table = stats::blockTableOf(complete).table;
    table.conditions = m_data.conditions.size();
    return table;
}

AnswerCells::PairedMeans AnswerCells::pairedMeans(const std::string& question, const std::string& a, const std::string& b,
                                                  AnswersOfMeans over) const
{
    const std::optional<CommonUnits> units = unitsOfMeans(*this, question, {a, b}, over);
    PairedMeans means;
    const std::size_t firstOfA = firstRun(question, a), firstOfB = firstRun(question, b);
    for (std::size_t i = 0; i < m_participants.size(); ++i) {
        const std::vector<double> both =
            units ? units->means(m_participants[i]) : meansOfRuns(std::array{firstOfA + i, firstOfB + i}, over);
        if (both.empty()) continue;
        means.a.push_back(both[0]);
        means.b.push_back(both[1]);
    }
    return means;
}

std::size_t AnswerCells::answered(const std::string& question) const
{
    const std::size_t first = runOf(m_questionPlaces.at(question), 0, 0);
    return m_starts[first + m_data.conditions.size() * m_participants.size()] - m_starts[first];
}

std::vector<double> valuesOf(const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> values;
    values.reserve(responses.size());
    for (const StudyResponse* response : responses)
        if (const auto number = numberOf(response->content)) values.push_back(*number);
    return values;
}

std::size_t correctAmong(const std::vector<double>& values)
{
    return static_cast<std::size_t>(std::count(values.begin(), values.end(), 1.0));
}

}  // namespace reports
