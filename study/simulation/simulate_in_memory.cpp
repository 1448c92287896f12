#include "study/simulation/simulate_in_memory.h"

#include <algorithm>
#include <map>

#include "protocols/files/errors.h"
#include "protocols/records/anchor_trials.h"
#include "stats/kernels/threads.h"
#include "study/simulation/memory_session.h"

namespace study::simulation {

namespace {

using database::CurrentAnswer;
using players::Judge;
using players::Mishaps;
using players::SimulatedParticipant;

/// Where an answer stands among the numbers of a participant.
class AnswerPlaces {
public:
    explicit AnswerPlaces(const MemoryStudy& study)
    {
        for (const QuestionPlaces& places : placesOfQuestions(study)) {
            m_questions.emplace(places.question, places);
            m_count += places.count();
            m_hasPairs = m_hasPairs || asksForSameness(places);
        }
        std::map<protocols::FabricId, std::size_t> fabrics;
        for (std::size_t i = 0; i < study.fabrics.size(); ++i) fabrics[study.fabrics[i]] = i;
        std::map<protocols::ConditionId, std::size_t> conditions;
        for (std::size_t i = 0; i < study.protocol.conditions.size(); ++i) conditions[study.protocol.conditions[i]] = i;
        for (const auto& [code, entry] : study.images)
            if (const auto condition = conditions.find(entry.condition); condition != conditions.end())
                m_images[code.value] = {condition->second, fabrics.at(entry.fabric), &entry.fabric};
    }

    std::size_t count() const { return m_count; }
    /// Whether some question asks for same or different.
    bool hasPairs() const { return m_hasPairs; }

    struct Place {
        std::size_t at = 0;
        bool isPair = false;  ///< the question asks for same or different
        const protocols::AnswerKind* kind = nullptr;
        const protocols::FabricId* truth = nullptr;
    };
    /// None for an answer to blank glass.
    std::optional<Place> of(const CurrentAnswer& answer, const std::vector<protocols::BlindedTrial>& list) const
    {
        const auto& trial = list[static_cast<std::size_t>(answer.record.trial.value) - 1];
        const auto image = m_images.find(trial.sealedCode.value);
        if (image == m_images.end()) return std::nullopt;
        const QuestionPlaces& places = m_questions.at(answer.record.question);
        const Image& shown = image->second;
        return Place{places.at(shown.condition, shown.fabric, runOf(trial, *places.phase)), asksForSameness(places), places.kind,
                     shown.truth};
    }

private:
    struct Image {
        std::size_t condition = 0, fabric = 0;
        const protocols::FabricId* truth = nullptr;
    };
    /// The place of the trial's instruction in its phase; 0 where the phase gives none.
    static std::size_t runOf(const protocols::BlindedTrial& trial, const protocols::Phase& phase)
    {
        if (phase.instructions.empty()) return 0;
        const auto run = std::ranges::find(phase.instructions, trial.instruction, &protocols::BlockInstruction::id);
        if (run == phase.instructions.end())
            throw protocols::workFailed({"trial " + std::to_string(trial.number.value) + " has an instruction of no block",
                                         trial.instruction.value, "an instruction of its phase", "run vis2hap verify"});
        return static_cast<std::size_t>(run - phase.instructions.begin());
    }

    std::size_t m_count = 0;
    bool m_hasPairs = false;
    std::map<protocols::QuestionId, QuestionPlaces> m_questions;
    std::map<std::string, Image> m_images;  ///< by open file code
};

std::int16_t numberOf(const database::AnswerRecord& record, const AnswerPlaces::Place& place)
{
    if (record.rating) return static_cast<std::int16_t>(record.rating->value);
    const auto right = isRight(*place.kind, record.alternatives, *place.truth, record.answer.value_or(""));
    return right ? std::int16_t(*right) : SimulatedAnswers::none;
}

std::vector<protocols::AnchorKind> anchorsIn(const MemoryStudy& study, const std::vector<protocols::BlindedTrial>& list)
{
    protocols::AnchorFinder finder(study.protocol);
    std::vector<protocols::AnchorKind> anchors;
    for (const auto& trial : list)
        anchors.push_back(finder.next(trial, study.images.at(protocols::FileCode(trial.sealedCode.value))));
    return anchors;
}

SimulatedAnswers numbersOf(const MemoryStudy& study, const SimulatedSession& session, int number, const AnswerPlaces& places)
{
    const auto anchors = anchorsIn(study, session.list);
    SimulatedAnswers numbers;
    numbers.number = number;
    numbers.hasWithdrawn = session.hasWithdrawn;
    numbers.voided = session.voided;
    numbers.refusals = session.refusals;
    numbers.values.assign(places.count(), SimulatedAnswers::none);
    if (places.hasPairs()) numbers.wasSame.assign(places.count(), SimulatedAnswers::noPair);
    numbers.seconds.assign(places.count(), std::numeric_limits<double>::quiet_NaN());
    for (const CurrentAnswer& answer : session.answers) {
        if (answer.voided) continue;
        if (anchors[static_cast<std::size_t>(answer.record.trial.value) - 1] != protocols::AnchorKind::None) continue;
        const auto place = places.of(answer, session.list);
        if (!place) continue;
        numbers.values[place->at] = numberOf(answer.record, *place);
        if (place->isPair && numbers.values[place->at] != SimulatedAnswers::none)
            numbers.wasSame[place->at] = answer.record.alternatives.front() == *place->truth ? 1 : 0;
        if (answer.responseSeconds) numbers.seconds[place->at] = *answer.responseSeconds;
        numbers.corrections += answer.corrections;
    }
    return numbers;
}

/// Judge and mishaps of one session in `plan`, which brings the protocol and gets the participant's list.
SimulatedSession played(const MemoryStudy& study, const SimulationRequest& request, int number, std::size_t place,
                        session::Plan& plan)
{
    SimulatedSession session{.participant = simulatedId(number), .place = place};
    plan.trials = listOf(study, place, request.seed);
    plan.fabricNames = pieceNamesOf(study, place);
    session::VirtualClock clock;
    MemorySession memory(plan, session.participant, clock);
    SimulatedParticipant usual(study.percepts, request.seed, session.participant.value);
    const Judge judge = request.judge ? request.judge(session.participant) : judgeOf(usual);
    Mishaps mishaps(request.mishaps, request.seed, session.participant, plan.protocol.answersPerParticipant());
    playSession(judge, mishaps, plan, memory, clock);
    session.answers = memory.answers();
    session.hasWithdrawn = std::holds_alternative<session::Withdrawn>(memory.state().stage);
    session.voided = memory.voidedPresentations();
    session.refusals = memory.refusals();
    session.list = std::move(plan.trials);
    return session;
}

void requirePlaces(const MemoryStudy& study)
{
    if (study.places.empty() || study.places.front().empty())
        throw protocols::workFailed({"the study has no places", study.name, "at least one running order", "run vis2hap verify"});
}

}  // namespace

std::vector<QuestionPlaces> placesOfQuestions(const MemoryStudy& study)
{
    std::vector<QuestionPlaces> places;
    std::size_t first = 0;
    for (const auto& phase : study.protocol.phases)
        for (const auto& question : phase.questions) {
            places.push_back({question.id, &phase, &question.kind, first, study.protocol.conditions.size(), study.fabrics.size(),
                              static_cast<std::size_t>(phase.runs())});
            first += places.back().count();
        }
    return places;
}

bool asksForSameness(const QuestionPlaces& question) { return std::holds_alternative<protocols::SameDifferent>(*question.kind); }

protocols::ParticipantId simulatedId(int number)
{
    return protocols::ParticipantId((number < 10 ? "SIM0" : "SIM") + std::to_string(number));
}

std::vector<std::size_t> placesOf(const MemoryStudy& study, const SimulationRequest& request)
{
    const int answers = study.protocol.answersPerParticipant();
    std::vector<std::size_t> places;
    std::size_t place = 0;
    for (int number = 1; number < request.first + request.count; ++number) {
        if (number >= request.first) places.push_back(place);
        if (!withdrawalOf(request.mishaps, request.seed, simulatedId(number), answers)) ++place;
    }
    return places;
}

SimulatedSession simulateSession(const MemoryStudy& study, const SimulationRequest& request, int number, std::size_t place)
{
    requirePlaces(study);
    session::Plan plan = planWithoutList(study);
    return played(study, request, number, place, plan);
}

std::vector<SimulatedAnswers> simulateInMemory(const MemoryStudy& study, const SimulationRequest& request,
                                               const std::function<void(std::size_t done)>& progress)
{
    requirePlaces(study);
    constexpr std::size_t atOnce = 20;  // participants that share a copy of the protocol
    const auto places = placesOf(study, request);
    const AnswerPlaces answerPlaces(study);
    std::vector<SimulatedAnswers> all(places.size());
    const std::size_t parts = (places.size() + atOnce - 1) / atOnce;
    const auto playPart = [&](std::size_t part) {
        session::Plan plan = planWithoutList(study);
        for (std::size_t i = part * atOnce; i < std::min(places.size(), (part + 1) * atOnce); ++i) {
            const int number = request.first + static_cast<int>(i);
            all[i] = numbersOf(study, played(study, request, number, places[i], plan), number, answerPlaces);
        }
    };
    stats::onThreads(parts, stats::threadCount(request.threads), playPart, [&](std::size_t done) {
        if (progress) progress(std::min(places.size(), done * atOnce));
    });
    return all;
}

}  // namespace study::simulation
