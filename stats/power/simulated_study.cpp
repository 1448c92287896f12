#include "stats/power/simulated_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/threads.h"
#include "stats/tests/binomial.h"

namespace stats {
namespace {

Factor numbered(const char* name, const char* letter, std::size_t levels)
{
    Factor factor{name, {}, {}};
    for (std::size_t level = 1; level <= levels; ++level) factor.levels.push_back(letter + std::to_string(level));
    return factor;
}

std::vector<double> normals(std::size_t n, double variance, Draws& draws)
{
    std::vector<double> result(n);
    for (double& x : result) x = draws.normal(std::sqrt(variance));
    return result;
}

/// The nearest rating on the scale.
double onScale(double rating, const RatingTruth& truth)
{
    const double steps = std::round((rating - truth.scaleMin) / truth.scaleStep);
    const double most = std::round((truth.scaleMax - truth.scaleMin) / truth.scaleStep);
    const double value = truth.scaleMin + std::clamp(steps, 0.0, most) * truth.scaleStep;
    return std::round(value * 1e9) / 1e9;  // 0.1 x 3 becomes the double of the decimal 0.3
}

void inParallel(const SimulationOptions& options, const std::function<void(std::size_t)>& work)
{
    const auto finishedOne = [&](std::size_t) { options.done(1); };
    onThreads(options.ownStudies(), options.threads, work, options.done ? finishedOne : std::function<void(std::size_t)>());
}

}  // namespace

double RatingTruth::sdOfDifference(const StudyDesign& design) const
{
    return std::sqrt(2 * (participantCondition + residual / static_cast<double>(design.fabrics)));
}

double RatingTruth::varianceOfMean(const StudyDesign& design) const
{
    const auto p = static_cast<double>(design.participants);
    const auto f = static_cast<double>(design.fabrics);
    return participantCondition / p + fabricCondition / f + residual / (p * f);
}

CrossedStudy emptyStudy(const StudyDesign& design)
{
    CrossedStudy study{numbered("participant", "P", design.participants), numbered("fabric", "F", design.fabrics),
                       numbered("condition", "C", design.conditions),
                       std::vector<double>(design.answers(), std::numeric_limits<double>::quiet_NaN())};
    for (std::size_t p = 0; p < design.participants; ++p)
        for (std::size_t f = 0; f < design.fabrics; ++f)
            for (std::size_t c = 0; c < design.conditions; ++c) {
                study.participant.of.push_back(p);
                study.fabric.of.push_back(f);
                study.condition.of.push_back(c);
            }
    return study;
}

void drawRatings(CrossedStudy& study, const RatingTruth& truth, std::span<const double> means, Draws& draws)
{
    const std::size_t conditions = study.condition.levels.size();
    const auto participant = normals(study.participant.levels.size(), truth.participant, draws);
    const auto fabric = normals(study.fabric.levels.size(), truth.fabric, draws);
    const auto participantCondition = normals(participant.size() * conditions, truth.participantCondition, draws);
    const auto fabricCondition = normals(fabric.size() * conditions, truth.fabricCondition, draws);
    const double noise = std::sqrt(truth.residual);
    for (std::size_t row = 0; row < study.values.size(); ++row) {
        const std::size_t p = study.participant.of[row];
        const std::size_t f = study.fabric.of[row];
        const std::size_t c = study.condition.of[row];
        const double rating = truth.centre + means[c] + participant[p] + fabric[f] + participantCondition[p * conditions + c] +
                              fabricCondition[f * conditions + c] + draws.normal(noise);
        study.values[row] = onScale(rating, truth);
    }
}

void drawChoices(CrossedStudy& study, const ChoiceTruth& truth, std::span<const double> logOdds, Draws& draws)
{
    const auto participant = normals(study.participant.levels.size(), truth.participantSd * truth.participantSd, draws);
    const auto fabric = normals(study.fabric.levels.size(), truth.fabricSd * truth.fabricSd, draws);
    for (std::size_t row = 0; row < study.values.size(); ++row) {
        const double eta =
            logOdds[study.condition.of[row]] + participant[study.participant.of[row]] + fabric[study.fabric.of[row]];
        study.values[row] = draws.happens(1 / (1 + std::exp(-eta))) ? 1 : 0;
    }
}

BlockTable participantMeans(const CrossedStudy& study)
{
    BlockTable table{study.participant.levels.size(), study.condition.levels.size(), {}};
    std::vector<std::vector<double>> cells(table.blocks * table.conditions);
    for (std::size_t row = 0; row < study.values.size(); ++row)
        cells[study.participant.of[row] * table.conditions + study.condition.of[row]].push_back(study.values[row]);
    for (const auto& cell : cells) table.values.push_back(*meanOf(cell));
    return table;
}

BlockTable answersByBlock(const CrossedStudy& study)
{
    const std::size_t fabrics = study.fabric.levels.size();
    BlockTable table{study.participant.levels.size() * fabrics, study.condition.levels.size(), {}};
    table.values.resize(table.blocks * table.conditions);
    for (std::size_t row = 0; row < study.values.size(); ++row)
        table.values[(study.participant.of[row] * fabrics + study.fabric.of[row]) * table.conditions + study.condition.of[row]] =
            study.values[row];
    return table;
}

double Rejections::rate() const { return studies == 0 ? 0 : static_cast<double>(rejected) / static_cast<double>(studies); }

Interval Rejections::interval() const
{
    return wilsonInterval(static_cast<long long>(rejected), static_cast<long long>(studies));
}

std::vector<Rejections> simulateTests(std::size_t tests, const SimulatedAnalysis& analysis, const SimulationOptions& options)
{
    enum TestOutcome : char { Kept, Rejected, Undefined };
    std::vector<char> outcomes(tests * options.ownStudies());
    inParallel(options, [&](std::size_t study) {
        Draws draws(options.seed, options.share.item(study));
        std::vector<Value> p(tests);
        analysis(draws, p);
        for (std::size_t t = 0; t < tests; ++t)
            outcomes[study * tests + t] = !p[t].exists() ? Undefined : *p[t] <= options.alpha ? Rejected : Kept;
    });
    std::vector<Rejections> result(tests);
    for (std::size_t t = 0; t < tests; ++t)
        for (std::size_t study = 0; study < options.ownStudies(); ++study) {
            ++result[t].studies;
            result[t].rejected += outcomes[study * tests + t] == Rejected ? 1 : 0;
            result[t].undefined += outcomes[study * tests + t] == Undefined ? 1 : 0;
        }
    return result;
}

}  // namespace stats
