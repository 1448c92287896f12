#include "study/bench/bench_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "stats/metrics/image_metrics.h"
#include "stats/tests/bootstrap.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "study/bench/bench_models.h"
#include "study/bench/bench_turns.h"
#include "study/bench/peer_programs.h"

namespace study::bench {

namespace {

/// ((i * multiplier + increment) mod 2^32) / 2^32.
std::vector<double> sequence(std::size_t n, std::uint64_t multiplier, std::uint64_t increment)
{
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<double>((i * multiplier + increment) & 0xFFFFFFFFU) / 4294967296.0;
    return x;
}

/// t of the paired test in 80-bit arithmetic.
long double pairedT(const std::vector<double>& x, const std::vector<double>& y)
{
    const auto n = static_cast<long double>(x.size());
    long double sum = 0, squares = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += static_cast<long double>(x[i]) - y[i];
    for (std::size_t i = 0; i < x.size(); ++i) {
        const long double deviation = static_cast<long double>(x[i]) - y[i] - sum / n;
        squares += deviation * deviation;
    }
    return sum / n / std::sqrt(squares / (n - 1) / n);
}

using Rows = std::vector<BenchRow>;

/// Adds the times of the peers to a row, and the relative difference of their answers from ours.
void addPeers(BenchRow& row, const PeerResults& results, const std::string& stage, double answer)
{
    const auto found = results.find(stage);
    if (found == results.end()) return;
    for (const auto& [peer, result] : found->second) {
        row.peers[peer] = result.milliseconds;
        if (result.answer) row.peersDiffer[peer] = std::fabs(*result.answer / answer - 1);
    }
}

void promise(BenchRow& row, const std::string& peer, double most)
{
    if (!row.peers.contains(peer)) return;  // no peers were asked for
    row.promise = RatioPromise{peer, most, {}};
    if (row.peers.at(peer)) row.promise->ratio = *row.milliseconds / *row.peers.at(peer);
}

Rows pairedTStage(const PeerResults& peers)
{
    const auto x = sequence(1000000, 2654435761U, 12345);
    const auto y = sequence(1000000, 3266489917U, 99);
    const auto exact = pairedT(x, y);
    double t = 0;
    auto rows = benchInTurns({{{"paired t, 1000000 pairs", "double", {}, {}, "relative, from t in 80 bits", "goal 3 ms"},
                               [&] { t = *stats::pairedTTest(x, y).t; },
                               [&] { return static_cast<double>(std::fabs((t - exact) / exact)); }}});
    addPeers(rows.front(), peers, "paired t", t);
    promise(rows.front(), "scipy", 0.4);
    return rows;
}

/// Differences of ratings: whole tenths about 0.3.
std::vector<double> ratingDifferences(std::size_t n)
{
    std::vector<double> differences;
    for (const double u : sequence(n, 2654435761U, 777)) differences.push_back(std::round((u - 0.45) * 60) / 10);
    return differences;
}

Rows bootstrapStage(const PeerResults& peers)
{
    const auto x = ratingDifferences(70);
    const auto many = stats::bcaBootstrapOfMean(x, {.resamples = 3000000, .seed = 2});
    double low = 0, shippedLow = 0;
    std::vector<TimedSetting> settings;
    for (const std::size_t resamples : {std::size_t{1000}, std::size_t{10000}, std::size_t{100000}})
        settings.push_back({{"BCa bootstrap of 70",
                             std::to_string(resamples),
                             {},
                             {},
                             "SE of the lower end, 20 seeds",
                             "resamples; truth from 3000000"},
                            [&low, &x, resamples] { low = *stats::bcaBootstrapOfMean(x, {.resamples = resamples}).ci.low; },
                            [&x, &many, resamples] {
                                double squares = 0;
                                for (std::uint64_t seed = 11; seed <= 30; ++seed) {
                                    const auto one = stats::bcaBootstrapOfMean(x, {.resamples = resamples, .seed = seed});
                                    squares += std::pow((*one.ci.low - *many.ci.low) / *many.standardError, 2) / 20;
                                }
                                return std::sqrt(squares);
                            }});
    auto rows = benchInTurns(settings);
    shippedLow = *stats::bcaBootstrapOfMean(x).ci.low;
    rows[1].note = "10000 x 70, 1 thread; goal 3 ms";
    addPeers(rows[1], peers, "bca", shippedLow);
    promise(rows[1], "scipy", 0.1);
    return rows;
}

Rows signFlipStage()
{
    const auto x = ratingDifferences(70);
    // Thirds do not lie on a decimal grid, so the test enumerates all signs.
    auto few = ratingDifferences(16);
    const double exact = *stats::signFlipTest(few, {}).p;
    for (double& difference : few) difference /= 3;
    return benchInTurns({{{"sign flips, exact, 70 on tenths",
                           "double",
                           {},
                           std::fabs(exact - *stats::signFlipTest(few, {}).p),
                           "p, from all 65536 signs of 16 differences",
                           "goal 1 ms"},
                          [&] { stats::signFlipTest(x, {}); },
                          {}}});
}

constexpr std::size_t ssimWidth = 1280;
constexpr std::size_t ssimHeight = 800;
// SSIM of these two images in 80-bit arithmetic, window by window.
constexpr double trueSsim = 0.9528596586430464;

Rows ssimStage(const PeerResults& peers)
{
    const auto a = sequence(ssimWidth * ssimHeight, 2654435761U, 12345);
    auto b = sequence(ssimWidth * ssimHeight, 3266489917U, 99);
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = 0.8 * a[i] + 0.2 * b[i];
    const std::vector<float> floatA(a.begin(), a.end());
    const std::vector<float> floatB(b.begin(), b.end());
    double found = 0, floatFound = 0;
    auto rows = benchInTurns(
        {{{"SSIM 1280x800", "double", {}, {}, "SSIM, from 80-bit arithmetic", "goal 30 ms"},
          [&] {
              found = *stats::ssim(stats::ImageView{a, ssimWidth, ssimHeight}, {b, ssimWidth, ssimHeight}, 1).mean;
          },
          [&] { return std::fabs(found - trueSsim); }},
         {{"SSIM 1280x800", "float", {}, {}, "SSIM, from 80-bit arithmetic", "goal 12 ms"},
          [&] {
              floatFound =
                  *stats::ssim(stats::FloatImageView{floatA, ssimWidth, ssimHeight}, {floatB, ssimWidth, ssimHeight}, 1).mean;
          },
          [&] { return std::fabs(floatFound - trueSsim); }}});
    addPeers(rows[0], peers, "ssim", found);
    addPeers(rows[1], peers, "ssim float", floatFound);
    for (BenchRow& row : rows) promise(row, "scikit-image", 0.25);
    return rows;
}

/// The paper's study, answered by a formula: 10 x 7 x 9, one choice and three ratings each.
reports::StudyData wholeStudy()
{
    reports::StudyData data;
    data.blinded = false;
    data.questions = {{"Q1", "", protocols::ForcedChoice{}},
                      {"Q2", "", protocols::Rating{}},
                      {"Q3", "", protocols::Rating{}},
                      {"Q4", "", protocols::Rating{}}};
    for (int c = 1; c <= 9; ++c) data.conditions.push_back("c" + std::to_string(c));
    for (int f = 1; f <= 7; ++f) data.fabrics.push_back("F" + std::to_string(f));
    for (int p = 1; p <= 10; ++p) data.participants.push_back("P" + std::to_string(10 + p));
    const auto noise = sequence(10 * 7 * 9 * 4, 2654435761U, 7);
    std::size_t next = 0;
    for (const auto& participant : data.participants)
        for (const auto& fabric : data.fabrics)
            for (const auto& condition : data.conditions)
                for (const auto& question : data.questions) {
                    const double level = 0.05 * (condition.back() - '0') + 0.5 * noise[next++];
                    const bool isChoice = question.id == "Q1";
                    const auto content = isChoice ? reports::AnswerContent(reports::ChosenAnswer{level > 0.4, {}, {}})
                                                  : reports::AnswerContent(reports::RatedAnswer{std::round(100 * level) / 10});
                    data.responses.push_back({participant, fabric, condition, question.id, content, 3 + 5 * level});
                }
    return data;
}

Rows reportStage()
{
    const auto data = wholeStudy();
    std::size_t size = 0;
    auto rows = benchInTurns({{{"the whole default report", "", {}, 0, "-", ""},
                               [&] {
                                   const reports::StudyAnalysis analysis = reports::analyse(data);
                                   size = reports::resultsJson(analysis).size() + reports::statisticsJson(analysis).size();
                               },
                               {}}});
    rows.front().note = "all tests and models of " + std::to_string(data.responses.size()) + " answers in " +
                        std::to_string(size) + " parts; goal 100 ms";
    return rows;
}

}  // namespace

std::vector<BenchRow> benchStatistics(bool peers)
{
    const PeerResults results = peers ? statisticsPeers() : PeerResults();
    std::vector<BenchRow> rows;
    for (const Rows& stage :
         {pairedTStage(results), bootstrapStage(results), signFlipStage(), ssimStage(results), benchModels(), reportStage()})
        rows.insert(rows.end(), stage.begin(), stage.end());
    return rows;
}

}  // namespace study::bench
