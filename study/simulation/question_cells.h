// The numbers of one question of a simulation in memory, sorted for its tests as a report sorts its answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "stats/claims/match_sensitivity.h"
#include "stats/kernels/block_table.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/value.h"
#include "study/simulation/simulate_in_memory.h"

namespace study::simulation {

/// Numbers of one cell (condition x fabric) are averaged as in the report. Keeps a reference to the participants.
class QuestionCells {
public:
    QuestionCells(const QuestionPlaces& places, const std::vector<const SimulatedAnswers*>& participants, double perUnit)
        : m_participants(participants),
          m_places(places),
          m_perUnit(perUnit),
          m_isComplete(participants.size(), true),
          m_hasRepetitions(mostAnswers() > 1)
    {
        for (std::size_t c = 0; c < conditions(); ++c) {
            auto& means = m_means.emplace_back();
            for (std::size_t p = 0; p < participants.size(); ++p) {
                const auto values = valuesOf(c, p);
                means.push_back(stats::meanOf(m_places.runs == 1 ? values : cellMeans(c, p)));
                if (values.size() != answersUnder()) m_isComplete[p] = false;
            }
        }
    }

    std::size_t conditions() const { return m_places.conditions; }
    std::size_t fabrics() const { return m_places.fabrics; }
    std::size_t participants() const { return m_participants.size(); }
    /// Answers of a complete participant under a condition.
    std::size_t answersUnder() const { return m_places.fabrics * m_places.runs; }

    std::vector<double> valuesOf(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> values;
        for (std::size_t f = 0; f < fabrics(); ++f) addCell(values, condition, participant, f);
        return values;
    }
    /// Of one cell.
    std::vector<double> valuesOf(std::size_t condition, std::size_t participant, std::size_t fabric) const
    {
        std::vector<double> values;
        addCell(values, condition, participant, fabric);
        return values;
    }
    std::vector<double> secondsOf(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> seconds;
        for (std::size_t f = 0; f < fabrics(); ++f)
            for (std::size_t r = 0; r < m_places.runs; ++r)
                if (const double time = m_participants[participant]->seconds[m_places.at(condition, f, r)]; !std::isnan(time))
                    seconds.push_back(time);
        return seconds;
    }
    std::vector<double> allValues(std::size_t condition) const
    {
        return gathered([&](std::size_t p) { return valuesOf(condition, p); });
    }
    std::vector<double> allSeconds(std::size_t condition) const
    {
        return gathered([&](std::size_t p) { return secondsOf(condition, p); });
    }

    /// [run x participant]: the answers under a condition of which it is known whether the pair was the same.
    std::vector<std::vector<stats::MatchAnswer>> pairLists(std::size_t condition) const
    {
        std::vector<std::vector<stats::MatchAnswer>> lists;
        for (std::size_t r = 0; r < m_places.runs; ++r)
            for (std::size_t p = 0; p < participants(); ++p) lists.push_back(pairsOf(condition, p, r));
        return lists;
    }

    std::vector<double> means(std::size_t condition) const
    {
        std::vector<double> existing;
        for (const stats::Value& mean : m_means[condition])
            if (mean.exists()) existing.push_back(*mean);
        return existing;
    }
    reports::AnswerCells::PairedMeans pairedMeans(std::size_t a, std::size_t b) const
    {
        reports::AnswerCells::PairedMeans paired;
        for (std::size_t p = 0; p < participants(); ++p) {
            if (m_isComplete[p] && fabrics() > 0) {
                paired.a.push_back(*m_means[a][p]);
                paired.b.push_back(*m_means[b][p]);
            } else if (const auto both = commonMeans({a, b}, p); !both.empty()) {
                paired.a.push_back(both[0]);
                paired.b.push_back(both[1]);
            }
        }
        return paired;
    }
    stats::BlockTable completeBlocks() const
    {
        stats::BlockTable table;
        table.conditions = conditions();
        std::vector<std::size_t> all(conditions());
        std::iota(all.begin(), all.end(), std::size_t{0});
        for (std::size_t p = 0; p < participants(); ++p) {
            const auto row = commonMeans(all, p);
            table.values.insert(table.values.end(), row.begin(), row.end());
            table.blocks += row.empty() ? 0 : 1;
        }
        return table;
    }
    /// Blocks of participant, fabric and run that are answered in every condition.
    stats::BlockTable completeSuccesses() const
    {
        stats::BlockTable table;
        table.conditions = conditions();
        for (std::size_t p = 0; p < participants(); ++p)
            for (std::size_t f = 0; f < fabrics(); ++f)
                for (std::size_t r = 0; r < m_places.runs; ++r) addRow(table, [&](std::size_t c) { return valueAt(c, p, f, r); });
        return table;
    }
    std::size_t answered() const
    {
        std::size_t count = 0;
        for (std::size_t c = 0; c < conditions(); ++c) count += allValues(c).size();
        return count;
    }

private:
    std::optional<double> valueAt(std::size_t condition, std::size_t participant, std::size_t fabric, std::size_t run) const
    {
        const auto value = m_participants[participant]->values[m_places.at(condition, fabric, run)];
        if (value == SimulatedAnswers::none) return std::nullopt;
        return value / m_perUnit;
    }
    std::vector<stats::MatchAnswer> pairsOf(std::size_t condition, std::size_t participant, std::size_t run) const
    {
        const SimulatedAnswers& own = *m_participants[participant];
        std::vector<stats::MatchAnswer> pairs;
        for (std::size_t f = 0; f < fabrics() && !own.wasSame.empty(); ++f) {
            const std::size_t place = m_places.at(condition, f, run);
            if (own.wasSame[place] == SimulatedAnswers::noPair) continue;
            const bool wasSame = own.wasSame[place] == 1;
            pairs.push_back({participant, f, wasSame, wasSame == (own.values[place] == 1)});
        }
        return pairs;
    }
    void addCell(std::vector<double>& values, std::size_t condition, std::size_t participant, std::size_t fabric) const
    {
        for (std::size_t r = 0; r < m_places.runs; ++r)
            if (const auto value = valueAt(condition, participant, fabric, r)) values.push_back(*value);
    }
    /// Means of the fabrics that the participant answered.
    std::vector<double> cellMeans(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> means;
        for (std::size_t f = 0; f < fabrics(); ++f)
            if (const stats::Value mean = stats::meanOf(valuesOf(condition, participant, f)); mean.exists())
                means.push_back(*mean);
        return means;
    }
    /// Most answers of one participant in one cell.
    std::size_t mostAnswers() const
    {
        std::size_t most = 0;
        for (std::size_t p = 0; p < participants() && most < m_places.runs; ++p)
            for (std::size_t c = 0; c < conditions(); ++c)
                for (std::size_t f = 0; f < fabrics(); ++f) most = std::max(most, valuesOf(c, p, f).size());
        return most;
    }
    /// The numbers of a fabric under each of these conditions, where all have one: in runs that are answered under all of them.
    /// Where no cell holds several answers, runs need not match.
    std::vector<std::vector<double>> commonValues(const std::vector<std::size_t>& conditions, std::size_t participant,
                                                  std::size_t fabric) const
    {
        std::vector<std::vector<double>> values(conditions.size());
        for (std::size_t r = 0; r < m_places.runs; ++r) {
            const auto isThere = [&](std::size_t c) { return valueAt(c, participant, fabric, r).has_value(); };
            if (m_hasRepetitions && !std::ranges::all_of(conditions, isThere)) continue;
            for (std::size_t i = 0; i < values.size(); ++i)
                if (const auto value = valueAt(conditions[i], participant, fabric, r)) values[i].push_back(*value);
        }
        if (std::ranges::any_of(values, [](const auto& own) { return own.empty(); })) return {};
        return values;
    }
    /// Means over the fabrics that the participant answered under each of these conditions; empty without such a fabric.
    std::vector<double> commonMeans(const std::vector<std::size_t>& conditions, std::size_t participant) const
    {
        std::vector<std::vector<double>> cells(conditions.size());
        for (std::size_t f = 0; f < fabrics(); ++f) {
            const auto values = commonValues(conditions, participant, f);
            for (std::size_t i = 0; i < values.size(); ++i) cells[i].push_back(*stats::meanOf(values[i]));
        }
        std::vector<double> means;
        for (const auto& own : cells)
            if (!own.empty()) means.push_back(*stats::meanOf(own));
        return means;
    }

    template <class Part>
    std::vector<double> gathered(const Part& part) const
    {
        std::vector<double> all;
        for (std::size_t p = 0; p < participants(); ++p) {
            const auto some = part(p);
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    }

    template <class NumberUnder>
    void addRow(stats::BlockTable& table, const NumberUnder& numberUnder) const
    {
        const std::size_t before = table.values.size();
        for (std::size_t c = 0; c < conditions(); ++c)
            if (const auto number = numberUnder(c)) table.values.push_back(*number);
        if (table.values.size() == before + conditions() && conditions() > 0)
            ++table.blocks;
        else
            table.values.resize(before);
    }

    const std::vector<const SimulatedAnswers*>& m_participants;
    QuestionPlaces m_places;
    double m_perUnit;
    std::vector<bool> m_isComplete;                  ///< whether the participant answered everything
    bool m_hasRepetitions;                           ///< whether some cell holds several answers
    std::vector<std::vector<stats::Value>> m_means;  ///< [condition][participant]
};

}  // namespace study::simulation
