#include "reports/analysis/group_analysis.h"

#include <algorithm>
#include <map>
#include <set>

#include "reports/cells/common_units.h"
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

/// What a test of groups takes: of each participant in a group, the means over the fabrics that were answered in every group.
struct SharedFabrics {
    std::vector<std::vector<double>> means;  // [participant x condition]; empty without such a fabric
    std::vector<std::string> leftOut;        // answered, but not in every group
    bool areNone = false;                    // every fabric is left out

    std::string why() const { return areNone ? "no fabric was answered in every group" : ""; }
};

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
        // A participant without some condition would carry the difference of conditions into that of groups.
        GroupedQuestion grouped{
            id,
            std::vector<std::vector<stats::Value>>(m_groups.size()),
            {},
            testOn(sharedFabrics(id, m_data.conditions), [](const auto& means) { return stats::meanOf(means); }),
            {}};
        for (const std::string& condition : m_data.conditions) {
            const SharedFabrics shared = sharedFabrics(id, {condition});
            const Samples samples = sampled(shared, [](const auto& means) { return stats::Value(means[0]); });
            for (std::size_t g = 0; g < samples.size(); ++g)
                grouped.means[g].push_back(shared.areNone ? stats::Value::undefined(shared.why()) : stats::meanOf(samples[g]));
            grouped.fabricsLeftOut.push_back(shared.leftOut);
        }
        std::vector<stats::Value> p;
        for (const auto& [a, b] : contrasts()) {
            grouped.contrasts.push_back(
                {a, b, testOn(sharedFabrics(id, {a, b}), [](const auto& means) { return stats::Value(means[0] - means[1]); })});
            p.push_back(grouped.contrasts.back().test.p);
        }
        const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
        for (std::size_t i = 0; i < holm.size(); ++i) grouped.contrasts[i].test.pHolm = holm[i];
        return grouped;
    }

private:
    /// A group without any answer to the question is in no test, and takes no fabric from the others.
    SharedFabrics sharedFabrics(const std::string& id, const std::vector<std::string>& conditions) const
    {
        const CommonUnits units(m_cells, id, conditions);
        std::vector<std::vector<CommonUnits::FabricMeans>> own(m_place.size());
        std::map<std::string, std::set<std::size_t>> groupsOf;  // by fabric
        std::set<std::size_t> answering;
        for (std::size_t i = 0; i < m_place.size(); ++i) {
            if (m_place[i] >= m_groups.size()) continue;
            own[i] = units.fabrics(m_cells.participants()[i]);
            for (const CommonUnits::FabricMeans& one : own[i]) {
                groupsOf[one.fabric].insert(m_place[i]);
                answering.insert(m_place[i]);
            }
        }
        SharedFabrics shared;
        for (const std::string& fabric : m_data.fabrics)
            if (const auto found = groupsOf.find(fabric); found != groupsOf.end() && found->second.size() < answering.size())
                shared.leftOut.push_back(fabric);
        shared.areNone = !groupsOf.empty() && shared.leftOut.size() == groupsOf.size();
        for (std::vector<CommonUnits::FabricMeans>& ofParticipant : own) {
            std::erase_if(ofParticipant,
                          [&](const CommonUnits::FabricMeans& one) { return groupsOf.at(one.fabric).size() < answering.size(); });
            shared.means.push_back(meansOverFabrics(ofParticipant));
        }
        return shared;
    }

    /// The values of the participants with means, by group.
    template <class ValueOf>
    Samples sampled(const SharedFabrics& shared, const ValueOf& valueOf) const
    {
        Samples samples(m_groups.size());
        for (std::size_t i = 0; i < m_place.size(); ++i)
            if (!shared.means[i].empty())
                if (const stats::Value value = valueOf(shared.means[i]); value.exists()) samples[m_place[i]].push_back(*value);
        return samples;
    }

    template <class ValueOf>
    GroupTest testOn(const SharedFabrics& shared, const ValueOf& valueOf) const
    {
        GroupTest test = testOfGroups(sampled(shared, valueOf));
        test.fabricsLeftOut = shared.leftOut;
        if (!shared.areNone) return test;
        const stats::Value none = stats::Value::undefined(shared.why());
        for (stats::Value& mean : test.means) mean = none;
        test.difference = none;
        test.ci95 = {none, none};
        return refusedGroupTest(std::move(test), shared.why());
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

std::vector<std::string> fabricsNotInEveryGroup(const StudyData& data, const GroupAnalysis& groups)
{
    std::set<std::string> names;
    const auto add = [&](const std::vector<std::string>& fabrics) { names.insert(fabrics.begin(), fabrics.end()); };
    for (const GroupedQuestion& question : groups.questions) {
        add(question.overall.fabricsLeftOut);
        for (const auto& ofCondition : question.fabricsLeftOut) add(ofCondition);
        for (const GroupContrast& contrast : question.contrasts) add(contrast.test.fabricsLeftOut);
    }
    std::vector<std::string> fabrics;
    for (const std::string& fabric : data.fabrics)
        if (names.contains(fabric)) fabrics.push_back(fabric);
    return fabrics;
}

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
