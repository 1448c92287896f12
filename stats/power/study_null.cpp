#include "stats/power/study_null.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

#include "stats/power/logistic_share.h"

namespace stats {
namespace {

std::vector<double> effectsOf(std::size_t count, double sd, Draws& draws)
{
    std::vector<double> effects(count);
    for (double& effect : effects) effect = draws.normal(sd);
    return effects;
}

/// Every answer of the study, by condition.
std::vector<AskedAnswer> allAnswers(const StudyNull& null)
{
    if (!null.answers.empty()) return null.answers;
    std::vector<AskedAnswer> answers;
    for (std::size_t c = 0; c < null.asked.conditions(); ++c)
        for (std::size_t p = 0; p < null.asked.participants(); ++p)
            for (std::size_t f = 0; f < null.asked.fabrics(); ++f)
                if (!std::isnan(null.asked.at(c, p, f))) answers.push_back({c, p, f});
    return answers;
}

/// What the answers of a cell have in common beside the effects, and what each has for itself.
class RatingResiduals {
public:
    RatingResiduals(const StudyNull& null, Draws& draws) : m_null(null), m_draws(draws) {}

    double of(std::span<const AskedAnswer> answers, std::size_t place)
    {
        if (place == 0 || answers[place] != answers[place - 1]) m_ofCell = m_draws.normal(m_null.residualSd);
        return m_null.answerSd > 0 ? m_ofCell + m_draws.normal(m_null.answerSd) : m_ofCell;
    }

private:
    const StudyNull& m_null;
    Draws& m_draws;
    double m_ofCell = 0;
};

double meanOver(std::span<const std::size_t> numbers, std::span<const double> values)
{
    double sum = 0;
    for (const std::size_t number : numbers) sum += values[number];
    return sum / static_cast<double>(numbers.size());
}

/// Means of the answers that a comparison takes; NaN: of none.
CrossedTable comparedMeans(const AnswerCube& cube, const std::vector<ComparedCell>& cells, std::span<const double> values)
{
    CrossedTable table{cube.participants(), cube.fabrics(), {}};
    table.values.assign(cube.participants() * cube.fabrics(), std::numeric_limits<double>::quiet_NaN());
    for (const ComparedCell& cell : cells) {
        double sum = 0;
        for (const auto& unit : cell.units) sum += meanOver(unit, values);
        table.values[cell.participant * cube.fabrics() + cell.fabric] = sum / static_cast<double>(cell.units.size());
    }
    return table;
}

/// The simulated study as the report analyses it.
AnswerCube cubeOfAnswers(const StudyNull& null, std::span<const AskedAnswer> answers, std::span<const double> values)
{
    AnswerCube cube = null.asked;
    const std::size_t participants = cube.participants(), fabrics = cube.fabrics();
    std::vector<std::size_t> counts(cube.conditions() * participants * fabrics);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        const auto& [c, p, f] = answers[i];
        double& cell = cube.at(c, p, f);
        cell = counts[(c * participants + p) * fabrics + f]++ == 0 ? values[i] : cell + values[i];
    }
    for (std::size_t place = 0; place < counts.size(); ++place)
        if (counts[place] > 1)
            cube.at(place / (participants * fabrics), place / fabrics % participants, place % fabrics) /=
                static_cast<double>(counts[place]);
    for (const ComparedConditions& one : null.compared)
        cube.setComparable(one.contrast.first, one.contrast.second, comparedMeans(cube, one.ofA, values),
                           comparedMeans(cube, one.ofB, values));
    return cube;
}

}  // namespace

FalseClaims simulateStudyNull(const StudyNull& null, const SimulationOptions& options)
{
    assert(!null.contrasts.empty() && "a family has a contrast");
    const AnswerCube& asked = null.asked;
    const bool isChoice = asked.kind() == AnswerValues::Choices;
    const double spread =
        std::sqrt(null.participantSd * null.participantSd + null.fabricSd * null.fabricSd +
                  null.participantConditionSd * null.participantConditionSd + null.fabricConditionSd * null.fabricConditionSd);
    // A share of 0 or 1 has no log odds; half an answer more or less has.
    const double least = 0.5 / static_cast<double>(asked.conditions() * asked.participants() * asked.fabrics() + 1);
    const double intercept = isChoice ? interceptFor(std::clamp(null.centre, least, 1 - least), spread) : 0;
    const std::vector<AskedAnswer> answers = allAnswers(null);
    assert(std::ranges::is_sorted(answers, {}, &AskedAnswer::condition) && "answers stand by condition");
    const auto analysis = [&](Draws& draws, std::span<Value> p) {
        std::vector<double> values;
        values.reserve(answers.size());
        RatingResiduals residuals(null, draws);
        const auto people = effectsOf(asked.participants(), null.participantSd, draws),
                   fabrics = effectsOf(asked.fabrics(), null.fabricSd, draws);
        for (std::size_t c = 0; c < asked.conditions(); ++c) {
            const auto ofPeople = effectsOf(asked.participants(), null.participantConditionSd, draws),
                       ofFabrics = effectsOf(asked.fabrics(), null.fabricConditionSd, draws);
            while (values.size() < answers.size() && answers[values.size()].condition == c) {
                const auto& [condition, i, f] = answers[values.size()];
                const double effects = people[i] + fabrics[f] + ofPeople[i] + ofFabrics[f];
                values.push_back(isChoice ? (draws.happens(shareOfLogOdds(intercept + effects)) ? 1.0 : 0.0)
                                          : std::clamp(null.centre + effects + residuals.of(answers, values.size()), null.lowest,
                                                       null.highest));
            }
        }
        const auto claims =
            contrastClaims(cubeOfAnswers(null, answers, values), null.contrasts, {}, Generalisation::FabricsLikeThese);
        p[0] = claims.front().difference.p;
        p[1] = Value::undefined("no contrast can be tested");
        for (const ContrastClaim& claim : claims)
            if (claim.pAdjusted.exists() && (!p[1].exists() || *claim.pAdjusted < *p[1])) p[1] = claim.pAdjusted;
    };
    const std::vector<Rejections> rejections = simulateTests(2, analysis, options);
    return {rejections[0], rejections[1]};
}

}  // namespace stats
