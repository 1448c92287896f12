#include "study/players/simulated_participant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace study::players {

using namespace session;

namespace {

/// A distance at which nothing is felt to be the same, just-noticeable differences.
constexpr double farthest = 1e3;

/// Q2 asks for slipperiness, Q3 for texture, every other rating (Q4, realism) for both.
double slipperinessWeightOf(const protocols::QuestionId& question, const PerceptualModel& model)
{
    if (question.value == "Q2") return 1.0;
    if (question.value == "Q3") return 0.0;
    return model.slipperinessWeight;
}

}  // namespace

protocols::FileCode Percepts::codeOf(const protocols::BlindedTrial& trial) const
{
    return codesAreOpen ? protocols::FileCode(trial.sealedCode.value) : protocols::opened(trial.sealedCode, stationKey);
}

SimulatedParticipant::SimulatedParticipant(const Percepts& percepts, std::uint64_t seed, const std::string& participant,
                                           PerceptualModel model, SpeedAccuracySetting setting)
    : m_percepts(percepts),
      m_model(model),
      m_random(protocols::Random::stream(seed, "simulated participant " + participant)),
      m_shift(m_model.personShift * m_random.normal()),
      m_setting(setting),
      m_race(protocols::Random::stream(seed, "speed and accuracy of simulated participant " + participant))
{
    m_setting.bound *= std::exp(m_setting.personSpread * m_race.normal());
}

double SimulatedParticipant::distance(const protocols::BlindedTrial& trial, const protocols::FabricId& fabric,
                                      double weight) const
{
    const auto& felt = m_percepts.stimuli.at(m_percepts.codeOf(trial));
    const auto& expected = m_percepts.fabrics.at(fabric);
    const double slipperiness = slipperinessDistance(felt, expected);
    const double texture = textureDistance(felt, expected);
    return std::sqrt(weight * slipperiness * slipperiness + (1 - weight) * texture * texture);
}

SimulatedParticipant::Judgement SimulatedParticipant::match(const protocols::BlindedTrial& trial)
{
    std::vector<double> distances;
    for (const auto& fabric : trial.alternatives)
        distances.push_back(distance(trial, fabric, m_model.slipperinessWeight) + m_model.sensoryNoise * m_random.normal());
    auto nearest = std::min_element(distances.begin(), distances.end()) - distances.begin();
    auto sorted = distances;
    std::sort(sorted.begin(), sorted.end());
    const double margin = sorted.size() > 1 ? sorted[1] - sorted[0] : 0;
    if (m_random.uniform() < m_model.lapseRate) nearest = static_cast<std::ptrdiff_t>(m_random.below(distances.size()));
    const double seconds = (6.0 + 6.0 * std::exp(-margin)) * std::exp(0.25 * m_random.normal());
    return {trial.alternatives[nearest], seconds};
}

SimulatedParticipant::Judgement SimulatedParticipant::rate(const protocols::BlindedTrial& trial,
                                                           const protocols::QuestionId& question,
                                                           const protocols::RatingScale& scale)
{
    const double noisy = distance(trial, trial.alternatives.front(), slipperinessWeightOf(question, m_model)) +
                         m_model.sensoryNoise * m_random.normal();
    const double likeness = std::exp(-std::max(0.0, noisy) / m_model.ratingFall);
    const double span = scale.max.value - scale.min.value;
    const double tenths = scale.min.value + span * likeness + 10 * (m_shift + m_model.ratingNoise * m_random.normal());
    const int steps = static_cast<int>(std::lround((tenths - scale.min.value) / scale.step.value));
    const int most = (scale.max.value - scale.min.value) / scale.step.value;
    const double seconds = 4.0 * std::exp(0.3 * m_random.normal());
    return {protocols::Tenths{scale.min.value + scale.step.value * std::clamp(steps, 0, most)}, seconds};
}

SimulatedParticipant::Judgement SimulatedParticipant::compare(const protocols::BlindedTrial& trial)
{
    const double noisy =
        distance(trial, trial.alternatives.front(), m_model.slipperinessWeight) + m_model.sensoryNoise * m_random.normal();
    // "Same" if a rating of the similarity would lie in the upper half of the scale.
    const bool same = std::exp(-std::max(0.0, noisy) / m_model.ratingFall) >= 0.5;
    const bool lapses = m_random.uniform() < m_model.lapseRate;
    return {Sameness{lapses ? m_random.below(2) == 1 : same}, 4.0 * std::exp(0.3 * m_random.normal())};
}

Decision SimulatedParticipant::decide(const protocols::BlindedTrial& trial, std::span<const double> drifts)
{
    std::optional<double> deadlineSeconds;
    if (trial.deadlineMs) deadlineSeconds = *trial.deadlineMs / 1000.0;
    Decision decision = race(drifts, boundUnder(m_setting, trial.aim), m_setting.nonDecisionSeconds, deadlineSeconds, m_race);
    if (m_race.uniform() < m_model.lapseRate) decision.winner = static_cast<std::size_t>(m_race.below(drifts.size()));
    return decision;
}

SimulatedParticipant::Judgement SimulatedParticipant::matchInstructed(const protocols::BlindedTrial& trial)
{
    std::vector<double> drifts;
    for (const auto& fabric : trial.alternatives)
        drifts.push_back(driftAt(m_setting, distance(trial, fabric, m_model.slipperinessWeight)));
    const Decision decision = decide(trial, drifts);
    return {trial.alternatives[decision.winner], decision.seconds};
}

SimulatedParticipant::Judgement SimulatedParticipant::compareInstructed(const protocols::BlindedTrial& trial)
{
    const double same = driftAt(m_setting, distance(trial, trial.alternatives.front(), m_model.slipperinessWeight));
    const std::array drifts{same, std::max(driftAt(m_setting, farthest), m_setting.gain - same)};
    const Decision decision = decide(trial, drifts);
    return {Sameness{decision.winner == 0}, decision.seconds};
}

}  // namespace study::players
