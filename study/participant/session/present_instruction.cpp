#include "study/participant/session/present_instruction.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/typed_number.h"
#include "protocols/scale_drawing.h"
#include "protocols/usual_texts.h"
#include "study/session/session_moves.h"

namespace study::participant {

namespace {

using namespace session;
using protocols::filledText;
using protocols::Protocol;
using protocols::Tenths;

std::string numberText(Tenths rating, const Protocol& protocol)
{
    const int absolute = std::abs(rating.value);
    const std::string sign = rating.value < 0 ? "-" : "";
    return sign + std::to_string(absolute / 10) +
           (absolute % 10 == 0 ? "" : participantText(protocol, "decimal_mark") + std::to_string(absolute % 10));
}

/// "5.4", or "4, agree" on a scale with words; with the decimal mark of the language.
std::string placeText(Tenths rating, const protocols::RatingScale& scale, const Protocol& protocol)
{
    const std::size_t step = static_cast<std::size_t>((rating.value - scale.min.value) / scale.step.value);
    return numberText(rating, protocol) + (step < scale.labels.size() ? ", " + scale.labels[step] : "");
}

struct InstructionOfStage {
    const View& view;
    const Protocol& protocol;

    Instruction operator()(const Enrolled&) const { return page("welcome_title", {text("welcome_text")}); }
    Instruction operator()(const Consenting&) const
    {
        Instruction consent = page("consent_title", {text("consent_text")});
        consent.task = Task::Consent;
        consent.statement = protocol.consent;
        return consent;
    }
    Instruction operator()(const AskingFacts&) const
    {
        Instruction facts = page("facts_title", {text("facts_text")});
        facts.task = Task::Facts;
        facts.questions = protocol.facts;
        return facts;
    }
    Instruction operator()(const Familiarising&) const
    {
        Instruction instruction = page("familiarise_title", {text("familiarise_text")});
        if (!protocol.strokeWords.empty()) instruction.lines.push_back(protocol.strokeWords);
        return instruction;
    }
    Instruction operator()(const ScaleTraining& training) const
    {
        Instruction instruction = page("scale_title", {});
        if (const auto* scale = memorisedScaleOf(protocol)) {
            instruction.task = Task::Scale;
            instruction.scale = scaleTask(training, *scale);
            if (!view.placeToName)
                instruction.lines = {text("scale_done")};
            else if (scale->labels.empty() && scale->sections > 1)
                instruction.lines = {text("scale_text")};
        }
        return instruction;
    }
    Instruction operator()(const CheckingList&) const { return page("mask_title", {text("mask_text")}); }
    Instruction operator()(const PlacingTray&) const
    {
        Instruction instruction = waiting(protocol);
        instruction.lines = instructionLines();
        return instruction;
    }
    Instruction operator()(const Presenting&) const { return page("feel_title", instructionLines()); }
    Instruction operator()(const OnBreak&) const
    {
        Instruction instruction = page("break_title", {text("break_text")});
        instruction.breakSeconds = static_cast<int>(std::clamp(view.breakSeconds, 0.0, 1e6));
        instruction.breakClock = text("break_clock");
        return instruction;
    }
    Instruction operator()(const Debriefing&) const { return page("last_title", {text("last_text")}); }
    Instruction operator()(const Finished&) const { return page("end_title", {text("end_text")}); }
    Instruction operator()(const Withdrawn&) const { return page("end_title", {text("end_text")}); }

    Instruction paused() const { return page("pause_title", {text("pause_text")}); }

private:
    std::string text(std::string_view key) const { return participantText(protocol, key); }

    /// The sentence of the block, where the protocol instructs speed or accuracy.
    std::vector<std::string> instructionLines() const
    {
        return view.instruction ? std::vector<std::string>{view.instruction->text} : std::vector<std::string>{};
    }

    Instruction page(std::string_view titleKey, std::vector<std::string> lines) const
    {
        Instruction instruction;
        instruction.title = text(titleKey);
        instruction.lines = std::move(lines);
        return instruction;
    }

    ScaleTask scaleTask(const ScaleTraining& training, const protocols::RatingScale& scale) const
    {
        ScaleTask task;
        task.scale = scale;
        task.scale.sections = drawnSections(scale);
        task.low = endText(scale.min, scale, "scale_low");
        task.high = endText(scale.max, scale, "scale_high");
        task.asked = view.placeToName;
        if (task.asked) task.tap = filledText(text("scale_tap"), {{"number", placeText(*task.asked, scale, protocol)}});
        if (task.asked) task.say = text("scale_say");
        task.count = filledText(text("scale_count"), {{"count", std::to_string(training.rightInARow)},
                                                      {"needed", std::to_string(placesInARow(training))}});
        if (training.last) task.last = feedback(*training.last, scale);
        return task;
    }

    /// A scale has words for its ends, or the ends of the paper's scale.
    std::string endText(Tenths end, const protocols::RatingScale& scale, std::string_view key) const
    {
        return scale.labels.empty() ? numberText(end, protocol) + " " + text(key) : placeText(end, scale, protocol);
    }

    ScaleFeedback feedback(const NamedPlace& last, const protocols::RatingScale& scale) const
    {
        return {
            last.shown, last.named, last.isRight,
            filledText(text(last.isRight ? "scale_right" : "scale_wrong"),
                       {{"named", placeText(last.named, scale, protocol)}, {"shown", placeText(last.shown, scale, protocol)}})};
    }
};

}  // namespace

Instruction instructionFor(const View& view, const Protocol& protocol)
{
    const InstructionOfStage instruction{view, protocol};
    const bool isOver = std::holds_alternative<Finished>(view.state.stage) || std::holds_alternative<Withdrawn>(view.state.stage);
    return view.state.paused && !isOver ? instruction.paused() : std::visit(instruction, view.state.stage);
}

Instruction waiting(const Protocol& protocol)
{
    Instruction instruction;
    instruction.title = participantText(protocol, "wait_title");
    return instruction;
}

std::optional<EventBody> eventOf(const ParticipantAct& act, const View& view, const Protocol& protocol)
{
    if (!isAskedFor(act, instructionFor(view, protocol))) return std::nullopt;
    return std::visit(
        protocols::Overloaded{[](const Agreement& agreement) -> std::optional<EventBody> {
                                  // It ends nothing: the operator speaks with the participant first.
                                  if (!agreement.agrees)
                                      return Noted{"The participant answered \"I do not agree\" on their own screen."};
                                  return Consented{EnteredBy::Participant};
                              },
                              [&](const FactsTold& told) -> std::optional<EventBody> {
                                  FactsGiven given{{}, EnteredBy::Participant};
                                  for (std::size_t i = 0; i < told.answers.size(); ++i)
                                      if (!told.answers[i].empty())
                                          given.facts[protocol.facts[i]] = protocols::typedNumber(told.answers[i]);
                                  return given;
                              },
                              [&](const PlaceTapped& tapped) -> std::optional<EventBody> {
                                  return ScalePlaced{*view.placeToName, tapped.place, EnteredBy::Participant};
                              }},
        act.what);
}

}  // namespace study::participant
