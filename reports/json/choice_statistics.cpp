#include <algorithm>
#include <map>

#include "reports/analysis/study_analysis.h"
#include "reports/json/statistic_parts.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/binomial.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

/// "third" of 1/3, for names; "1_over_7" where English has no short word.
std::string fractionName(int alternatives)
{
    static const std::map<int, std::string> names{{2, "half"}, {3, "third"}, {4, "quarter"}, {5, "fifth"}};
    const auto found = names.find(alternatives);
    return found != names.end() ? found->second : "1_over_" + std::to_string(alternatives);
}

Json choiceRows(const StudyData& data, const Cells& cells, const std::string& question)
{
    std::vector<stats::BinomialTest> tests;
    std::vector<stats::Value> p;
    std::vector<std::pair<std::size_t, std::size_t>> counts;
    for (const std::string& condition : data.conditions) {
        const auto values = valuesOf(cells.of(question, condition));
        const auto correct = static_cast<std::size_t>(std::count(values.begin(), values.end(), 1.0));
        counts.emplace_back(correct, values.size());
        tests.push_back(stats::binomialTest(static_cast<long long>(correct), static_cast<long long>(values.size()),
                                            1.0 / data.alternativesOf(question)));
        p.push_back(tests.back().pGreater);
    }
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    const std::string people = std::to_string(data.participants.size());
    Json rows = Json::array();
    for (std::size_t i = 0; i < tests.size(); ++i) {
        Json row{{"condition", data.conditions[i]}, {"correct", counts[i].first}, {"trials", counts[i].second}};
        const auto matches = static_cast<double>(data.participants.size() * counts[i].first);
        put(row, "mean_matches_per_rendering_of_" + people,
            counts[i].second > 0 ? stats::Value(matches / static_cast<double>(counts[i].second)) : tests[i].estimate);
        putP(row, "p_exact_greater_one_" + fractionName(data.alternativesOf(question)), tests[i].pGreater, tests[i].logPGreater);
        put(row, "p_holm", holm[i]);
        put(row, "cp95", tests[i].clopperPearson);
        put(row, "wilson95", tests[i].wilson);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json cochranPart(const stats::CochranTest& test)
{
    Json part = Json::object();
    put(part, "Q", test.q);
    putWhole(part, "df", test.df);
    putP(part, "p", test.p, test.logP);
    part["blocks"] = test.blocks;
    part["note"] = "blocks = participant x fabric; ignores clustering, descriptive only";
    return part;
}

Json participantLevel(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json shares = Json::object();
    std::vector<double> values;
    for (const std::string& participant : cells.participants()) {
        std::vector<double> answers;
        for (const std::string& condition : data.conditions)
            for (const double value : valuesOf(cells.of(question, condition, participant))) answers.push_back(value);
        const stats::Value share = stats::meanOf(answers);
        put(shares, participant, share);
        if (share.exists()) values.push_back(*share);
    }
    const stats::TTest test = stats::oneSampleTTest(values, {.mu = 1.0 / data.alternativesOf(question)});
    Json part{{"prop", shares}};
    put(part, "t_vs_" + fractionName(data.alternativesOf(question)), test.t);
    putWhole(part, "df", test.df);
    putP(part, "p", test.p, test.logP);
    return part;
}

Json matchesByRendering(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json part = Json::object();
    for (const std::string& condition : data.conditions) {
        std::map<std::string, std::pair<std::size_t, std::size_t>> byFabric;
        for (const Response* response : cells.of(question, condition)) {
            byFabric[response->fabric].first += *response->correct ? 1 : 0;
            ++byFabric[response->fabric].second;
        }
        for (const std::string& fabric : data.fabrics)
            part[condition][fabric] = {{"correct", byFabric[fabric].first}, {"trials", byFabric[fabric].second}};
    }
    return part;
}

/// Sensitivity that does not hang on m: 3-alternative and 2-alternative studies can be compared.
Json sensitivityPart(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json part = Json::object();
    for (const std::string& condition : data.conditions) {
        const auto values = valuesOf(cells.of(question, condition));
        const auto correct = static_cast<long long>(std::count(values.begin(), values.end(), 1.0));
        const auto d = stats::forcedChoice(correct, static_cast<long long>(values.size()), data.alternativesOf(question));
        Json row = Json::object();
        put(row, "d_prime", d.dPrime);
        put(row, "se", d.seDPrime);
        part[condition] = std::move(row);
    }
    return part;
}

/// Which fabric was named for which, over all conditions; and how often each tray slot was chosen.
Json confusionPart(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json part{{"answered", Json::object()}, {"slots", Json::object()}};
    for (const std::string& truth : data.fabrics)
        for (const std::string& answer : data.fabrics) part["answered"][truth][answer] = 0;
    bool isKnown = false;
    for (const std::string& condition : data.conditions)
        for (const Response* response : cells.of(question, condition)) {
            if (response->answer && part["answered"].contains(*response->answer)) {
                Json& count = part["answered"][response->fabric][*response->answer];
                count = count.get<int>() + 1;
                isKnown = true;
            }
            if (!response->answerSlot) continue;
            Json& slot = part["slots"][std::string(1, static_cast<char>('A' + *response->answerSlot))];
            slot = slot.is_null() ? 1 : slot.get<int>() + 1;
        }
    if (!isKnown) putNull(part, "answered", "the answers tell right and wrong alone, not which fabric was named");
    return part;
}

}  // namespace

void putChoiceStatistics(Json& statistics, const StudyData& data, const Cells& cells, const std::string& question)
{
    const std::string name = lowerCase(question);
    statistics[name + "_per_condition"] = choiceRows(data, cells, question);
    statistics[name + "_cochran"] = cochranPart(stats::cochranTest(cells.completeSuccesses(question, data.conditions)));
    statistics[name + "_participant_level"] = participantLevel(data, cells, question);
    statistics[name + "_glmm"] = choiceModelPart(data, cells, question);
    statistics[name + "_sensitivity"] = sensitivityPart(data, cells, question);
    statistics[name + "_confusion"] = confusionPart(data, cells, question);
    statistics[name + "_matches_by_rendering"] = matchesByRendering(data, cells, question);
}

}  // namespace reports
