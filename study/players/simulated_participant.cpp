#include "study/players/simulated_participant.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "protocols/files/errors.h"
#include "study/players/player_answers.h"
#include "study/session/preparation.h"
#include "study/session/session_record.h"

namespace study::players {

using namespace session;

namespace {

/// Q2 asks for slipperiness, Q3 for texture, every other rating (Q4, realism) for both.
double slipperinessWeightOf(const protocols::QuestionId& question, const PerceptualModel& model)
{
    if (question.value == "Q2") return 1.0;
    if (question.value == "Q3") return 0.0;
    return model.slipperinessWeight;
}

}  // namespace

SimulatedParticipant::SimulatedParticipant(const Percepts& percepts, std::uint64_t seed, const std::string& participant,
                                           PerceptualModel model)
    : m_percepts(percepts),
      m_model(model),
      m_random(protocols::Random::stream(seed, "simulated participant " + participant)),
      m_shift(m_model.personShift * m_random.normal())
{
}

double SimulatedParticipant::distance(const protocols::BlindedTrial& trial, const protocols::FabricId& fabric,
                                      double weight) const
{
    const auto& felt = m_percepts.stimuli.at(protocols::opened(trial.sealedCode, m_percepts.stationKey));
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

void playSimulated(SimulatedParticipant& participant, const Plan& plan, Hands& hands, VirtualClock& clock,
                   const std::function<void(int)>& progress)
{
    const auto act = [&](const EventBody& event) {
        if (const auto refusal = hands.perform(event))
            throw protocols::workFailed({"the session refuses \"" + kindOf(event) + "\": " + refusal->reason,
                                         "simulated participant", "", "report this fault with the study folder"});
    };
    const auto answer = [&](const Presenting& presenting) {
        const auto& trial = plan.trials[presenting.index];
        const auto& question = plan.protocol.phases[trial.phase].questions[presenting.question];
        if (presenting.question == 0 && !presenting.touchedAtNs) {
            clock.advanceSeconds(0.8);
            act(Touched{});
        }
        const auto judgement = simulatedAnswer(participant, trial, question);
        clock.advanceSeconds(judgement.seconds);
        act(Answered{judgement.response, {.begunAgoNs = 0, .begunBy = BegunBy::Script}});
    };
    while (true) {
        const Stage stage = hands.state().stage;
        if (std::holds_alternative<Finished>(stage) || std::holds_alternative<Withdrawn>(stage)) return;
        clock.advanceSeconds(std::max(1.0, plan.protocol.deadTimeSeconds));
        if (hands.state().paused)
            act(Resumed{});
        else if (const auto preparation = nextOfPreparation(plan.protocol, stage))
            act(*preparation);
        else if (std::holds_alternative<PlacingTray>(stage))
            act(trayReadyOf(plan.protocol, plan.trials[std::get<PlacingTray>(stage).index].alternatives, plan.fabricNames));
        else
            answer(std::get<Presenting>(stage));
        if (progress) progress(hands.state().answersStored);
    }
}

}  // namespace study::players
