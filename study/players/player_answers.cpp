#include "study/players/player_answers.h"

#include <algorithm>

#include "protocols/files/errors.h"

namespace study::players {

namespace {

using protocols::FabricId;
using protocols::Overloaded;
using session::GivenAnswer;

/// The fabric that a script names by its id, or by its part in the presentation.
FabricId scriptedChoice(const std::string& text, const ScriptedPresentation& presentation)
{
    // First, because exported scripts hold ids, and another lab may call a fabric "correct".
    if (std::ranges::find(presentation.tray, FabricId(text)) != presentation.tray.end()) return FabricId(text);
    if (text == "correct") return presentation.truth;
    std::vector<FabricId> foils = presentation.tray;
    std::erase(foils, presentation.truth);
    for (std::size_t k = 0; k < foils.size(); ++k)
        if (text == "foil:" + std::to_string(k + 1)) return foils[k];
    throw protocols::badInput({"answer \"" + text + "\" is not on the tray", presentation.name,
                               "correct, foil:1 .. foil:" + std::to_string(foils.size()) + " or a fabric of the tray",
                               "correct the script and run the same command again; earlier answers are stored"});
}

GivenAnswer scriptedSameness(const std::string& text, const ScriptedPresentation& presentation)
{
    const bool isSame = presentation.tray.front() == presentation.truth;
    if (text == "same" || text == "different") return session::Sameness{text == "same"};
    if (text == "correct" || text == "wrong") return session::Sameness{isSame == (text == "correct")};
    throw protocols::badInput({"answer \"" + text + "\" is neither same nor different", presentation.name,
                               "same, different, correct or wrong",
                               "correct the script and run the same command again; earlier answers are stored"});
}

}  // namespace

GivenAnswer scriptedAnswer(const ScriptedResponse& scripted, const protocols::AnswerKind& kind,
                           const ScriptedPresentation& presentation)
{
    if (const auto* rating = std::get_if<protocols::Tenths>(&scripted)) return *rating;
    const auto& text = std::get<std::string>(scripted);
    return std::visit(
        Overloaded{[&](const protocols::ForcedChoice&) -> GivenAnswer { return scriptedChoice(text, presentation); },
                   [&](const protocols::Rating&) -> GivenAnswer { return scriptedChoice(text, presentation); },
                   [&](const protocols::SameDifferent&) { return scriptedSameness(text, presentation); },
                   [&](const protocols::FreeText&) -> GivenAnswer { return session::Words{text}; }},
        kind);
}

ScriptedResponse scriptedFormOf(const GivenAnswer& answer)
{
    using Form = ScriptedResponse;
    return std::visit(Overloaded{[](const FabricId& fabric) -> Form { return fabric.value; },
                                 [](const protocols::Tenths& rating) -> Form { return rating; },
                                 [&](const session::Sameness&) -> Form { return textOf(answer); },
                                 [](const session::Words& words) -> Form { return words.text; }},
                      answer);
}

SimulatedParticipant::Judgement simulatedAnswer(SimulatedParticipant& participant, const protocols::BlindedTrial& trial,
                                                const protocols::Question& question)
{
    using Judgement = SimulatedParticipant::Judgement;
    constexpr double secondsOfSilence = 1.0;
    return std::visit(
        Overloaded{[&](const protocols::ForcedChoice&) {
                       return trial.instruction.empty() ? participant.match(trial) : participant.matchInstructed(trial);
                   },
                   [&](const protocols::Rating& rating) { return participant.rate(trial, question.id, rating.scale); },
                   [&](const protocols::SameDifferent&) {
                       return trial.instruction.empty() ? participant.compare(trial) : participant.compareInstructed(trial);
                   },
                   [](const protocols::FreeText&) {
                       return Judgement{session::Words{}, secondsOfSilence};
                   }},
        question.kind);
}

}  // namespace study::players
