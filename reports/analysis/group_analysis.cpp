#include "reports/analysis/group_analysis.h"

#include <algorithm>
#include <set>

#include "stats/kernels/decimal_grid.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

using Samples = std::vector<std::vector<double>>;  // values of the participants of each group

GroupTest refusedGroupTest(GroupTest test, const std::string& why)
{
    test.why = why;
    test.f = test.df1 = test.df2 = test.p = test.pHolm = stats::Value::undefined(why);
    return test;
}

GroupTest testOfGroups(const Samples& samples)
{
    GroupTest test;
    for (const std::vector<double>& sample : samples) {
        test.participants.push_back(sample.size());
        test.means.push_back(stats::meanOf(sample));
    }
    const stats::Value none = stats::Value::undefined(samples.size() == 2 ? "there is no test" : "there are not two groups");
    test.difference = none;
    test.ci95 = {none, none};
    if (samples.size() == 2) {
        const stats::TTest t = stats::welchTTest(samples[0], samples[1]);
        test.difference = t.estimate;
        test.ci95 = t.ci;
        if (!t.why.empty()) return refusedGroupTest(test, t.why);
        test.f = *t.t * *t.t;
        test.df1 = 1.0;
        test.df2 = t.df;
        test.p = t.p;
    } else {
        const stats::OneWayAnova anova = stats::oneWayAnova(samples);
        if (!anova.why.empty()) return refusedGroupTest(test, anova.why);
        test.f = anova.f;
        test.df1 = anova.df1;
        test.df2 = anova.df2;
        test.p = anova.p;
    }
    test.pHolm = test.p;
    return test;
}

class GroupReader {
public:
    GroupReader(const StudyData& data, const AnswerCells& cells, const std::vector<std::string>& groups)
        : m_data(data), m_cells(cells), m_groups(groups)
    {
        for (const std::string& participant : cells.participants()) {
            const auto found = data.groupOf.find(participant);
            const auto group = found == data.groupOf.end() ? groups.end() : std::ranges::find(groups, found->second);
            m_place.push_back(static_cast<std::size_t>(group - groups.begin()));
        }
    }

    /// Number of participants of each group.
    std::vector<std::size_t> sizes() const
    {
        std::vector<std::size_t> sizes(m_groups.size());
        for (const std::size_t place : m_place)
            if (place < sizes.size()) ++sizes[place];
        return sizes;
    }

    GroupedQuestion question(const std::string& id) const
    {
        GroupedQuestion grouped{id, std::vector<std::vector<stats::Value>>(m_groups.size()), overall(id), {}};
        for (const std::string& condition : m_data.conditions) {
            const Samples samples = sampled([&](const std::string& one) { return m_cells.participantMean(id, condition, one); });
            for (std::size_t g = 0; g < samples.size(); ++g) grouped.means[g].push_back(stats::meanOf(samples[g]));
        }
        std::vector<stats::Value> p;
        for (const auto& [a, b] : contrasts()) {
            grouped.contrasts.push_back({a, b, testOfGroups(sampled([&](const std::string& one) -> stats::Value {
                                             const std::vector<double> both = m_cells.commonMeans(id, {a, b}, one);
                                             return both.empty() ? stats::Value() : stats::Value(both[0] - both[1]);
                                         }))});
            p.push_back(grouped.contrasts.back().test.p);
        }
        const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
        for (std::size_t i = 0; i < holm.size(); ++i) grouped.contrasts[i].test.pHolm = holm[i];
        return grouped;
    }

private:
    template <class ValueOf>
    Samples sampled(const ValueOf& valueOf) const
    {
        Samples samples(m_groups.size());
        for (std::size_t i = 0; i < m_place.size(); ++i)
            if (m_place[i] < samples.size())
                if (const stats::Value value = valueOf(m_cells.participants()[i]); value.exists())
                    samples[m_place[i]].push_back(*value);
        return samples;
    }

    GroupTest overall(const std::string& id) const
    {
        return testOfGroups(sampled([&](const std::string& one) {
            // A participant without some condition would carry the difference of conditions into that of groups.
            const std::vector<double> means = m_cells.commonMeans(id, m_data.conditions, one);
            return means.empty() ? stats::Value() : stats::meanOf(means);
        }));
    }

    std::vector<std::pair<std::string, std::string>> contrasts() const
    {
        std::vector<std::pair<std::string, std::string>> pairs;
        const auto& conditions = m_data.conditions;
        const auto isThere = [&](const std::string& one) { return std::ranges::find(conditions, one) != conditions.end(); };
        for (const auto& [a, b] : m_data.planned)
            if (isThere(a) && isThere(b)) pairs.emplace_back(a, b);
        if (!pairs.empty() || conditions.size() * (conditions.size() - 1) / 2 > mostGroupPairs) return pairs;
        for (std::size_t a = 0; a < conditions.size(); ++a)
            for (std::size_t b = a + 1; b < conditions.size(); ++b) pairs.emplace_back(conditions[a], conditions[b]);
        return pairs;
    }

    const StudyData& m_data;
    const AnswerCells& m_cells;
    const std::vector<std::string>& m_groups;
    std::vector<std::size_t> m_place;  // group of each participant; the number of groups where there is none
};

}  // namespace

GroupAnalysis analyseGroups(const StudyData& data, const AnswerCells& cells)
{
    GroupAnalysis analysis;
    std::set<std::string> names;
    for (const auto& [participant, group] : data.groupOf) names.insert(group);
    if (names.size() < 2) return analysis;
    analysis.groups.assign(names.begin(), names.end());
    const GroupReader reader(data, cells, analysis.groups);
    analysis.participants = reader.sizes();
    for (const QuestionInfo& question : data.questions)
        if (hasNumbers(question)) analysis.questions.push_back(reader.question(question.id));
    return analysis;
}

}  // namespace reports
