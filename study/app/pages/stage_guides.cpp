#include "study/app/pages/stage_guides.h"

#include <cmath>

#include "study/app/language/app_text.h"
#include "study/app/pieces/question_head.h"
#include "study/app/state/session_controller.h"

namespace study::app {

using namespace session;

namespace {

Guide introduction(const SessionFacts& facts)
{
    return {.title = AppText::tr("Welcome the participant"),
            .lead = AppText::tr("The participant does not wear the mask yet."),
            .steps = {AppText::tr("Give the participant the information sheet and time to read it."),
                      AppText::tr(
                          "Explain the session: the participant strokes the glass and pieces of fabric and says how they feel. "
                          "There are breaks."),
                      AppText::tr("Say: “%1”").arg(facts.sentence("say_stop"))},
            .action = AppText::tr("Begin (Enter)"),
            .event = Begun{}};
}

Guide consent(const SessionFacts& facts)
{
    const bool hasFullStop =
        facts.consent.endsWith(QLatin1Char('.')) || facts.consent.endsWith(QChar(0x3002));  // or that of Chinese
    return {.title = AppText::tr("Consent"),
            .lead = AppText::tr("You confirm: %1.").arg(hasFullStop ? facts.consent.chopped(1) : facts.consent),
            .steps = {AppText::tr("If the participant does not agree, do not begin. Press W instead.")},
            .action = AppText::tr("The participant has agreed (Enter)"),
            .event = Consented{}};
}

/// Steps of every break, whatever its reason.
QStringList breakSteps()
{
    return {AppText::tr("The participant may lift the mask, drink and move the hand."),
            AppText::tr("Clean the glass and the participant's finger. Let both dry."),
            AppText::tr("Make sure that the participant wears the mask again before you continue.")};
}

QString breakTitle(const OnBreak& onBreak, const View& view)
{
    switch (onBreak.reason) {
        case BreakReason::Block:
            return AppText::tr("Break");
        case BreakReason::Phase:
            // A void at the end of a phase brings one of its presentations back.
            return view.phaseBegins ? AppText::tr("Break: new questions follow") : AppText::tr("Break");
        case BreakReason::Time:
            return AppText::tr("Break: time for a rest");
        case BreakReason::SittingOver:
            return AppText::tr("This sitting has lasted %1 minutes").arg(std::lround(view.sittingMinutes));
    }
    return {};
}

/// An operator writes it down, so that nobody can later change the log unseen.
QString headToNote(const View& view)
{
    if (view.logHead.empty()) return AppText::tr("The head of the log cannot be read now.");
    return AppText::tr("Write down the head of the log: %1").arg(QString::fromStdString(view.logHead));
}

QString newQuestions(const View& view)
{
    return AppText::tr("Questions that follow: %1. Explain them before the participant puts the mask on.").arg(phaseText(view));
}

QString breakLead(const OnBreak& onBreak, const View& view)
{
    const AnswerCount answers = countedAnswers(view);
    const QString done = AppText::tr("%1 of %2 answers are stored. The display is off.").arg(answers.given).arg(answers.inAll);
    QStringList sentences;
    if (onBreak.reason == BreakReason::SittingOver)
        sentences << AppText::tr(
            "A tired hand feels less. Press Q to stop here and continue on another day. Everything is stored.");
    if (view.phaseBegins) sentences << newQuestions(view);
    return sentencesTogether(sentences << done);
}

Guide breakGuide(const OnBreak& onBreak, const View& view)
{
    Guide guide{.title = breakTitle(onBreak, view),
                .lead = breakLead(onBreak, view),
                .steps = breakSteps(),
                .action = AppText::tr("Continue (Enter)"),
                .event = BreakEnded{}};
    if (view.instruction) guide.steps << instructionAfterBreak(view);
    if (onBreak.reason == BreakReason::SittingOver) {
        guide.steps << headToNote(view);
        guide.action = AppText::tr("Continue anyway (Enter)");
        guide.second = Guide::Second{AppText::tr("Stop here for today (Q)"), Qt::Key_Q, GuideAct::Leave};
    }
    return guide;
}

Guide paused(const View& view)
{
    return {.title = AppText::tr("Paused"),
            .lead = AppText::tr("All answers so far are stored. The display is off."),
            .steps = {AppText::tr("An interrupted presentation starts again with the tray."),
                      AppText::tr("You may close the window now. The session continues here later."), headToNote(view)},
            .action = AppText::tr("Continue the session (Enter)"),
            .event = Resumed{}};
}

/// What the preparation of a later sitting repeats, as far as the protocol has it.
QString partsToRepeat(const SessionFacts& facts)
{
    const bool hasChecklist = !facts.checklist.isEmpty() || !facts.readings.isEmpty();
    if (facts.scale && hasChecklist) return AppText::tr("First repeat the scale and the checklist.");
    return facts.scale ? AppText::tr("First repeat the scale.") : AppText::tr("First repeat the checklist.");
}

Guide laterSitting(const View& view, const SessionFacts& facts)
{
    const AnswerCount answers = countedAnswers(view);
    QStringList steps{AppText::tr("The participant does not wear the mask yet.")};
    if (view.phaseBegins) steps << newQuestions(view);
    steps << AppText::tr("After a short interruption you may skip this if everything is still in place.");
    return {.title = AppText::tr("Welcome back"),
            .lead = AppText::tr("A new sitting begins. %1 of %2 answers are stored. %3")
                        .arg(answers.given)
                        .arg(answers.inAll)
                        .arg(partsToRepeat(facts)),
            .steps = steps,
            .action = AppText::tr("Prepare this sitting (Enter)"),
            .event = SittingPrepared{},
            .second = Guide::Second{AppText::tr("Skip the preparation (G)"), Qt::Key_G, GuideAct::DeclinePreparation}};
}

Guide finished(const View& view)
{
    return {.title = AppText::tr("The session is complete"),
            .lead = AppText::tr("All %1 answers are stored. Thank the participant for the time and care.")
                        .arg(countedAnswers(view).given),
            .steps = {AppText::tr("Clean the glass and put the fabrics back in order."), headToNote(view)},
            .action = AppText::tr("Back to the study (Enter)"),
            .event = {},
            .act = GuideAct::Leave};
}

Guide withdrawn(const View& view, const SessionFacts& facts)
{
    const QString ended =
        facts.isAtStation
            ? AppText::tr("The session has ended. Stored answers: %1. The study's owner gives this place out again.")
            : AppText::tr("The session has ended. Stored answers: %1. Another participant can take this place.");
    return {.title = AppText::tr("The participant has withdrawn"),
            .lead = ended.arg(countedAnswers(view).given),
            .steps = {AppText::tr("Thank the participant for coming."), headToNote(view)},
            .action = AppText::tr("Back to the study (Enter)"),
            .event = {},
            .act = GuideAct::Leave};
}

struct GuideOfStage {
    const View& view;
    const SessionFacts& facts;

    template <class StageWithItsOwnPage>
    std::optional<Guide> operator()(const StageWithItsOwnPage&) const
    {
        return std::nullopt;
    }
    std::optional<Guide> operator()(const Enrolled&) const { return introduction(facts); }
    std::optional<Guide> operator()(const Consenting&) const { return consent(facts); }
    std::optional<Guide> operator()(const OnBreak& onBreak) const { return breakGuide(onBreak, view); }
    std::optional<Guide> operator()(const Finished&) const { return finished(view); }
    std::optional<Guide> operator()(const Withdrawn&) const { return withdrawn(view, facts); }
};

}  // namespace

std::optional<Guide> guideFor(const View& view, const SessionFacts& facts, bool isPreparationDue)
{
    if (isPreparationDue) return laterSitting(view, facts);
    return view.state.paused ? std::optional(paused(view)) : std::visit(GuideOfStage{view, facts}, view.state.stage);
}

}  // namespace study::app
