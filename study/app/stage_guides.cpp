#include "study/app/stage_guides.h"

#include <QCoreApplication>

namespace study::app {

using namespace session;

namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("study::app::Guide", text);
}

Guide introduction()
{
    return {.title = tr("Welcome the participant"),
            .lead = tr("The participant does not wear the mask yet. Tick each point as it is done; what is still open comes "
                       "again before the first presentation."),
            .steps = {},
            .action = tr("Begin (Enter)"),
            .event = Begun{},
            .checklist = Checklist::Offered};
}

Guide familiarisation()
{
    return {.title = tr("Getting to know the display"),
            .lead = tr("Nothing is scored here. Take the time that the participant needs."),
            .steps = {tr("Seat the participant so that the display and the tray are within reach of one hand."),
                      tr("Let them stroke some fabrics on the table, and then the glass of the display, with the same "
                         "finger, from left to right, calmly and evenly."),
                      tr("Say: “Soon you will compare what you feel on the glass with the fabric on the tray. "
                         "There is no right speed; take the time you need.”"),
                      tr("Answer questions, then go on.")},
            .action = tr("The participant is ready (Enter)"),
            .event = FamiliarisationDone{}};
}

Guide scaleTraining()
{
    return {.title = tr("The scale, to be memorised"),
            .lead = tr("Show this line to the participant. It has equal sections; only its two ends carry a number."),
            .steps = {tr("Let them touch sandpaper, then silk. Say: “These two are unrelated. That is 0.”"),
                      tr("Let them touch two pieces of the same fabric. Say: “These two are totally the same. That is 10.”"),
                      tr("Let them point at a few places of the line and say the number, such as 2.5, 5 and 8.1."),
                      tr("When they know the line by heart, they put on the mask.")},
            .action = tr("The mask is on (Enter)"),
            .event = ScaleTrainingDone{},
            .showsScale = true,
            .checklist = Checklist::Required};
}

Guide onBreak(const View& view)
{
    return {.title = tr("Break"),
            .lead = tr("Done so far: %1 of %2 answers. The display is off.").arg(view.answersStored).arg(view.answersInAll),
            .steps = {tr("The participant may lift the mask, drink and move the hand."),
                      tr("Clean the glass and the finger, and let both dry."),
                      tr("Before you go on, the mask is on again.")},
            .action = tr("Go on (Enter)"),
            .event = BreakEnded{}};
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

Guide finished(const View& view)
{
    return {.title = tr("The session is complete"),
            .lead = tr("All %1 answers are stored. Thank you, and thank the participant.").arg(view.answersStored),
            .steps = {tr("The participant may take off the mask."), tr("Clean the glass and put the fabrics back in order.")},
            .action = tr("Back to the study (Enter)"),
            .event = std::nullopt};
}

Guide withdrawn(const View& view)
{
    return {.title = tr("The participant has withdrawn"),
            .lead = tr("The session has ended. Answers stored until then: %1.").arg(view.answersStored),
            .steps = {tr("Thank the participant for coming.")},
            .action = tr("Back to the study (Enter)"),
            .event = std::nullopt};
}

struct GuideOfStage {
    const View& view;
    std::optional<Guide> operator()(const Enrolled&) const { return introduction(); }
    std::optional<Guide> operator()(const Familiarising&) const { return familiarisation(); }
    std::optional<Guide> operator()(const ScaleTraining&) const { return scaleTraining(); }
    std::optional<Guide> operator()(const PlacingTray&) const { return std::nullopt; }
    std::optional<Guide> operator()(const Presenting&) const { return std::nullopt; }
    std::optional<Guide> operator()(const OnBreak&) const { return onBreak(view); }
    std::optional<Guide> operator()(const Finished&) const { return finished(view); }
    std::optional<Guide> operator()(const Withdrawn&) const { return withdrawn(view); }
};

}  // namespace

std::optional<Guide> guideFor(const View& view)
{
    return view.state.paused ? std::optional(paused()) : std::visit(GuideOfStage{view}, view.state.stage);
}

}  // namespace study::app
