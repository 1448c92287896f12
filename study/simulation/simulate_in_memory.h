// Simulated participants in memory, as many as wanted: their sessions follow the rules of every session, and what is kept of each
// is a few kilobytes of numbers. What participant k answers depends on the study, the seed and k alone: parts of a simulation
// that ran on several machines hold the same bits as one run.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "study/players/simulated_session.h"
#include "study/simulation/memory_study.h"

namespace study::simulation {

/// Where the numbers of one question stand among those of a participant. A phase with instructions repeats its list under each of
/// them, so a question has one number for each condition x fabric x run.
struct QuestionPlaces {
    protocols::QuestionId question;
    const protocols::Phase* phase = nullptr;  ///< whose question it is
    const protocols::AnswerKind* kind = nullptr;
    std::size_t first = 0;  ///< place of the first number
    std::size_t conditions = 0, fabrics = 0;
    std::size_t runs = 1;  ///< instructions of the phase, or one

    std::size_t count() const { return conditions * fabrics * runs; }
    std::size_t at(std::size_t condition, std::size_t fabric, std::size_t run) const
    {
        return first + (condition * fabrics + fabric) * runs + run;
    }
};

/// In the order of the questions; one behind the other. They point into the study's protocol.
std::vector<QuestionPlaces> placesOfQuestions(const MemoryStudy& study);

/// Whether the question asks for same or different.
bool asksForSameness(const QuestionPlaces& question);

/// The valid answers of one participant as numbers. Rows are questions, conditions, fabrics and runs in the order of the study.
struct SimulatedAnswers {
    static constexpr std::int16_t none = std::numeric_limits<std::int16_t>::min();
    static constexpr std::int8_t noPair = -1;

    int number = 0;  ///< of the participant, from 1
    bool hasWithdrawn = false;
    int voided = 0;       ///< presentations
    int corrections = 0;  ///< of valid answers
    int refusals = 0;     ///< steps that the session refused
    /// [question x condition x fabric x run]: a rating in tenths of a scale point, 1 for right, 0 for wrong; none where nothing
    /// valid was answered, and for words.
    std::vector<std::int16_t> values;
    /// Of answers to same or different: 1 where the pair was the same, 0 where it differed; noPair for all others. Empty where no
    /// question asks for it, and in shards of earlier versions.
    std::vector<std::int8_t> wasSame;
    /// The response times of the same answers, s; NaN where there is none.
    std::vector<double> seconds;
};

/// The participant's id in every result: "SIM01".
protocols::ParticipantId simulatedId(int number);

/// Makes the judge of one participant.
using MakeJudge = std::function<players::Judge(const protocols::ParticipantId& participant)>;

struct SimulationRequest {
    std::uint64_t seed = 1;
    int first = 1;  ///< number of the first participant, from 1
    int count = 0;
    players::MishapRates mishaps = {};
    unsigned threads = 0;  ///< 0: one a processor
    /// Empty: the participants of simulated_participant.h.
    MakeJudge judge = {};
};

/// The rows of one participant, as a store would return them.
struct SimulatedSession {
    protocols::ParticipantId participant;
    std::size_t place = 0;  ///< of the study, from 0
    std::vector<protocols::BlindedTrial> list = {};
    std::vector<database::CurrentAnswer> answers = {};
    bool hasWithdrawn = false;
    int voided = 0;
    int refusals = 0;
};

/// The places of participants first, first + 1, ...: a participant who withdraws frees the place for the next one, as in a study
/// folder whose sessions run one after another.
std::vector<std::size_t> placesOf(const MemoryStudy& study, const SimulationRequest& request);

/// One session, whole.
SimulatedSession simulateSession(const MemoryStudy& study, const SimulationRequest& request, int number, std::size_t place);

/// The participants in their order. `progress` gets the number of those that are done, on any thread.
std::vector<SimulatedAnswers> simulateInMemory(const MemoryStudy& study, const SimulationRequest& request,
                                               const std::function<void(std::size_t done)>& progress = {});

}  // namespace study::simulation
