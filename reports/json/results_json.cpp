// The object of results.json; its parts are in the order of the documented schema.
#include <algorithm>
#include <functional>
#include <map>

#include "reports/analysis/answer_cells.h"
#include "reports/analysis/quality_flags.h"
#include "reports/text/number_text.h"
#include "reports/write_report.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/binomial.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

Json studyPart(const StudyData& data)
{
    Json study{{"name", data.name}};
    if (data.protocolSha256.empty())
        putNull(study, "protocol_sha256", "the answers came without a protocol");
    else
        study["protocol_sha256"] = data.protocolSha256;
    study["participants"] = data.participants.size();
    study["fabrics"] = data.fabrics.size();
    study["blinded"] = data.blinded;
    study["simulated"] = data.simulated;
    putReasonsLast(study);
    return study;
}

Json choicePart(const StudyData& data, const Cells& cells, const std::string& question, const std::string& condition)
{
    const std::vector<double> values = valuesOf(cells.of(question, condition));
    const auto trials = static_cast<long long>(values.size());
    const auto correct = static_cast<long long>(std::count(values.begin(), values.end(), 1.0));
    const double chance = 1.0 / data.alternativesOf(question);
    const stats::BinomialTest exact = stats::binomialTest(correct, trials, chance);
    const stats::TTest byParticipant = stats::oneSampleTTest(cells.participantMeans(question, condition), {.mu = chance});
    Json part{{"trials", trials}, {"correct", correct}};
    // Multiplied before the division: 10 x 27 / 70 is then the nearest double.
    const auto matches = static_cast<double>(static_cast<long long>(data.participants.size()) * correct);
    put(part, "matches_per_rendering",
        trials > 0 ? stats::Value(matches / static_cast<double>(trials)) : stats::Value::undefined("there are no trials"));
    put(part, "proportion", exact.estimate);
    put(part, "ci95", exact.wilson);
    putP(part, "p_chance", exact.pGreater, exact.logPGreater);
    putP(part, "p_chance_participants", byParticipant.p, byParticipant.logP);
    putReasonsLast(part);
    return part;
}

Json ratingPart(const Cells& cells, const std::string& question, const std::string& condition)
{
    const std::vector<double> ratings = valuesOf(cells.of(question, condition));
    const std::vector<double> means = cells.participantMeans(question, condition);
    Json part{{"n", ratings.size()}};
    put(part, "mean", stats::meanOf(ratings));
    put(part, "sd", stats::describe(ratings).sd);
    part["participants"] = means.size();
    stats::Interval ci = stats::describe(means).ci95;
    if (!ci.low.exists()) ci.low = ci.high = stats::Value::undefined("needs the means of at least 2 participants");
    put(part, "ci95", ci);
    putReasonsLast(part);
    return part;
}

bool isPlanned(const StudyData& data, const std::string& a, const std::string& b)
{
    return !data.blinded && std::any_of(data.planned.begin(), data.planned.end(), [&](const auto& contrast) {
        return (contrast.first == a && contrast.second == b) || (contrast.first == b && contrast.second == a);
    });
}

using PairVisitor = std::function<void(const std::string& a, const std::string& b)>;
void forEachPair(const std::vector<std::string>& conditions, const PairVisitor& visit)
{
    for (std::size_t a = 0; a < conditions.size(); ++a)
        for (std::size_t b = a + 1; b < conditions.size(); ++b) visit(conditions[a], conditions[b]);
}

Json comparisonRow(const std::string& question, const std::string& a, const std::string& b, const stats::TTest& test,
                   const stats::Value& pHolm)
{
    Json row{{"question", question}, {"a", a}, {"b", b}, {"test", "paired-t"}, {"n", test.n}};
    put(row, "statistic", test.t);
    putWhole(row, "df", test.df);
    putP(row, "p", test.p, test.logP);
    put(row, "p_holm", pHolm);
    put(row, "mean_difference", test.estimate);
    put(row, "ci95", test.ci);
    put(row, "d_z", test.dZ);
    return row;
}

/// The rows of a question; returns its corrected p values by pair.
std::vector<stats::Value> addComparisons(Json& rows, const StudyData& data, const Cells& cells, const std::string& question)
{
    std::vector<stats::TTest> tests;
    std::vector<stats::Value> p;
    forEachPair(data.conditions, [&](const std::string& a, const std::string& b) {
        const Cells::Pairs pairs = cells.pairs(question, a, b);
        tests.push_back(stats::pairedTTest(pairs.a, pairs.b));
        p.push_back(tests.back().p);
    });
    const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
    std::size_t i = 0;
    forEachPair(data.conditions, [&](const std::string& a, const std::string& b) {
        Json row = comparisonRow(question, a, b, tests[i], holm[i]);
        if (isPlanned(data, a, b)) row["planned"] = true;
        putReasonsLast(row);
        rows.push_back(std::move(row));
        ++i;
    });
    return holm;
}

/// Four cells; a difference counts as shown when the corrected t test rejects.
std::string verdictOf(const stats::EquivalenceTest& test, const stats::Value& pHolm)
{
    stats::EquivalenceTest corrected = test;
    corrected.different = pHolm.exists() && *pHolm < 0.05;
    return corrected.verdict();
}

void addEquivalence(Json& rows, const StudyData& data, const Cells& cells, const std::string& question,
                    const std::vector<stats::Value>& pHolm)
{
    std::size_t i = 0;
    forEachPair(data.conditions, [&](const std::string& a, const std::string& b) {
        const Cells::Pairs pairs = cells.pairs(question, a, b);
        const auto [low, high] = data.equivalenceBounds;
        const auto test = stats::equivalenceTest(stats::TKind::Paired, pairs.a, pairs.b, {.low = low, .high = high});
        Json row{{"question", question}, {"a", a}, {"b", b}, {"bounds", {low, high}}};
        put(row, "p_lower", test.pLower);
        put(row, "p_upper", test.pUpper);
        put(row, "p", test.p);
        if (test.why.empty())
            row["equivalent"] = test.equivalent;
        else
            putNull(row, "equivalent", test.why);
        row["n"] = test.n;
        put(row, "mean_difference", test.estimate);
        put(row, "ci90", test.ci);
        row["verdict"] = verdictOf(test, pHolm[i++]);
        if (isPlanned(data, a, b)) row["planned"] = true;
        putReasonsLast(row);
        rows.push_back(std::move(row));
    });
}

/// Balanced integration scores by condition: over participant x condition cells, then averaged.
std::map<std::string, stats::Value> bisByCondition(const StudyData& data, const Cells& cells, const std::string& question)
{
    std::vector<std::string> owners;
    std::vector<double> correct;
    std::vector<double> seconds;
    for (const std::string& condition : data.conditions)
        for (const std::string& participant : cells.participants()) {
            const auto responses = cells.of(question, condition, participant);
            const stats::Value time = stats::meanOf(secondsOf(responses));
            if (responses.empty() || !time.exists()) continue;
            owners.push_back(condition);
            correct.push_back(*stats::meanOf(valuesOf(responses)));
            seconds.push_back(*time);
        }
    const std::vector<stats::Value> scores = stats::balancedIntegrationScores(correct, seconds);
    std::map<std::string, std::vector<double>> byCondition;
    std::map<std::string, stats::Value> result;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (!scores[i].exists())
            result.emplace(owners[i], scores[i]);
        else
            byCondition[owners[i]].push_back(*scores[i]);
    }
    for (const auto& [condition, values] : byCondition) result.emplace(condition, stats::describe(values).mean);
    return result;
}

Json speedPart(const StudyData& data, const Cells& cells)
{
    const auto choice = std::find_if(data.questions.begin(), data.questions.end(), [](const auto& q) { return q.isChoice; });
    const bool hasChoice = choice != data.questions.end();
    const auto bis = hasChoice ? bisByCondition(data, cells, choice->id) : std::map<std::string, stats::Value>();
    Json part = Json::object();
    for (const std::string& condition : data.conditions) {
        const auto responses = hasChoice ? cells.of(choice->id, condition) : std::vector<const Response*>();
        const stats::ResponseTimes times = stats::responseTimes(secondsOf(responses));
        const stats::Value correct = stats::meanOf(valuesOf(responses));
        stats::Value bits = times.mean;
        if (correct.exists() && times.mean.exists())
            bits = stats::bitsPerSecond(*correct, data.alternativesOf(choice->id), *times.mean);
        Json row = Json::object();
        put(row, "median_seconds", times.median);
        put(row, "bits_per_second", bits);
        put(row, "bis",
            bis.count(condition)  ? bis.at(condition)
            : times.mean.exists() ? stats::Value::undefined("needs at least 2 cells")
                                  : times.mean);
        part[condition] = std::move(row);
    }
    return part;
}

void putSignals(Json& results, const StudyData& data)
{
    if (data.blinded)
        putNull(results, "signals", "left out while the study is blinded");
    else if (data.signalsJson.empty())
        putNull(results, "signals", "no generated and measured signals belong to these answers");
    else
        results["signals"] = Json::parse(data.signalsJson);
}

}  // namespace

nlohmann::ordered_json results(const StudyData& data)
{
    const Cells cells(data);
    Json results{{"schema", "vis2hap.results/1"}, {"study", studyPart(data)}, {"conditions", data.conditions}};
    Json comparisons = Json::array();
    Json equivalence = Json::array();
    for (const QuestionInfo& question : data.questions) {
        Json& part = results[question.id] = Json::object();
        for (const std::string& condition : data.conditions)
            part[condition] =
                question.isChoice ? choicePart(data, cells, question.id, condition) : ratingPart(cells, question.id, condition);
        const std::vector<stats::Value> pHolm = addComparisons(comparisons, data, cells, question.id);
        if (!question.isChoice) addEquivalence(equivalence, data, cells, question.id, pHolm);
    }
    results["comparisons"] = std::move(comparisons);
    results["equivalence"] = std::move(equivalence);
    results["speed_accuracy"] = speedPart(data, cells);
    putSignals(results, data);
    results["quality"] = qualityFlags(data, cells);
    putReasonsLast(results);
    return results;
}

}  // namespace reports
