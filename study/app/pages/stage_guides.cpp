#include "study/app/pages/stage_guides.h"

#include <QCoreApplication>
#include <cmath>

namespace study::app {

using namespace session;

namespace {

QString tr(const char* text) { return QCoreApplication::translate("study::app::Guide", text); }

Guide introduction()
{
    return {.title = tr("Welcome the participant"),
            .lead = tr("The participant does not wear the mask yet."),
            .steps = {tr("Give them the information sheet, and time to read it."),
                      tr("Tell them what will happen: stroking the glass and fabrics, and saying what is felt, with breaks."),
                      tr("Say: “You may stop at any time, without giving a reason.”")},
            .action = tr("Begin (Enter)"),
            .event = Begun{}};
}

Guide consent(const SessionFacts& facts)
{
    const bool hasFullStop = facts.consent.endsWith(QLatin1Char('.'));
    return {.title = tr("Consent"),
            .lead = tr("You confirm: %1.").arg(hasFullStop ? facts.consent.chopped(1) : facts.consent),
            .steps = {tr("If they do not agree, nothing is begun: press W.")},
            .action = tr("The participant has agreed (Enter)"),
            .event = Consented{}};
}

/// What every break is for, whatever brought it about.
QStringList breakSteps()
{
    return {tr("The participant may lift the mask, drink and move the hand."),
            tr("Clean the glass and the finger, and let both dry."), tr("Before you go on, the mask is on again.")};
}

QString breakTitle(const OnBreak& onBreak, const View& view)
{
    switch (onBreak.reason) {
        case BreakReason::Block:
            return tr("Break");
        case BreakReason::Phase:
            return tr("Break: now other questions");
        case BreakReason::Time:
            return tr("Break: it has been a while");
        case BreakReason::SittingOver:
            return tr("This sitting has lasted %1 minutes").arg(std::lround(view.sittingMinutes));
    }
    return {};
}

QString breakLead(const OnBreak& onBreak, const View& view)
{
    const QString done = tr("Done so far: %1 of %2 answers. The display is off.").arg(view.answersStored).arg(view.answersInAll);
    switch (onBreak.reason) {
        case BreakReason::Block:
        case BreakReason::Time:
            return done;
        case BreakReason::Phase:
            return tr("Next come the questions %1. Explain them before the mask is on. %2")
                .arg(QString::fromStdString(view.phaseName), done);
        case BreakReason::SittingOver:
            return tr("A tired hand feels less. Stop here with Q and go on another day; everything is kept. %1").arg(done);
    }
    return done;
}

Guide breakGuide(const OnBreak& onBreak, const View& view)
{
    Guide guide{.title = breakTitle(onBreak, view),
                .lead = breakLead(onBreak, view),
                .steps = breakSteps(),
                .action = tr("Go on (Enter)"),
                .event = BreakEnded{}};
    if (onBreak.reason == BreakReason::SittingOver) {
        guide.action = tr("Go on all the same (Enter)");
        guide.second = Guide::Second{tr("Stop here for today (Q)"), Qt::Key_Q, GuideAct::Leave};
    }
    return guide;
}

Guide paused()
{
    return {.title = tr("Paused"),
            .lead = tr("Every answer so far is stored. The display is off."),
            .steps = {tr("An interrupted presentation starts again from the tray."),
                      tr("You may also close the window now; the session goes on from here later.")},
            .action = tr("Go on with the session (Enter)"),
            .event = Resumed{}};
}

Guide laterSitting(const View& view)
{
    return {.title = tr("Welcome back"),
            .lead = tr("A new sitting begins; %1 of %2 answers are stored. First the scale is shown once more and the "
                       "checklist is gone through.")
                        .arg(view.answersStored)
                        .arg(view.answersInAll),
            .steps = {tr("The participant does not wear the mask yet."),
                      tr("After a short interruption, with everything still in place, you may go on without.")},
            .action = tr("Prepare this sitting (Enter)"),
            .event = SittingPrepared{},
            .second = Guide::Second{tr("Go on without (G)"), Qt::Key_G, GuideAct::DeclinePreparation}};
}

Guide finished(const View& view)
{
    return {.title = tr("The session is complete"),
            .lead = tr("All %1 answers are stored. Thank you, and thank the participant.").arg(view.answersStored),
            .steps = {tr("Clean the glass and put the fabrics back in order.")},
            .action = tr("Back to the study (Enter)"),
            .event = {},
            .act = GuideAct::Leave};
}

Guide withdrawn(const View& view)
{
    return {.title = tr("The participant has withdrawn"),
            .lead = tr("The session has ended. Answers stored until then: %1. The place is free for somebody else.")
                        .arg(view.answersStored),
            .steps = {tr("Thank the participant for coming.")},
            .action = tr("Back to the study (Enter)"),
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
    std::optional<Guide> operator()(const Enrolled&) const { return introduction(); }
    std::optional<Guide> operator()(const Consenting&) const { return consent(facts); }
    std::optional<Guide> operator()(const OnBreak& onBreak) const { return breakGuide(onBreak, view); }
    std::optional<Guide> operator()(const Finished&) const { return finished(view); }
    std::optional<Guide> operator()(const Withdrawn&) const { return withdrawn(view); }
};

}  // namespace

std::optional<Guide> guideFor(const View& view, const SessionFacts& facts, bool isPreparationDue)
{
    if (isPreparationDue) return laterSitting(view);
    return view.state.paused ? std::optional(paused()) : std::visit(GuideOfStage{view, facts}, view.state.stage);
}

}  // namespace study::app
