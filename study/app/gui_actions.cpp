#include "study/app/gui_actions.h"

#include <QCheckBox>

#include "study/app/pages/stage_page.h"
#include "study/app/state/answer_form.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using namespace session;

namespace {

struct EventActions {
    GuiOperator& gui;
    MainWindow& window;

    void operator()(const SittingStarted&) const { throw cannotPerform("a sitting starts when its session is opened"); }
    void operator()(const Begun&) const { enter(); }
    void operator()(const Consented&) const { enter(); }
    void operator()(const FactsGiven& event) const
    {
        fill(event.facts, window.session()->facts().facts, QStringLiteral("fact"));
        press("confirmButton");
    }
    void operator()(const FamiliarisationShown& event) const { gui.pressKey(Qt::Key_1 + event.item); }
    void operator()(const FamiliarisationDone&) const { enter(); }
    void operator()(const ScalePlaced& event) const
    {
        gui.type(study::app::textOf(event.spoken));
        enter();
    }
    void operator()(const ScaleTrainingDone&) const { gui.pressKey(Qt::Key_G); }
    void operator()(const ChecklistDone& event) const
    {
        tick(event.ticked);
        fill(event.readings, window.session()->facts().readings, QStringLiteral("reading"));
        const int sentBefore = window.session()->eventsSent();
        press("confirmButton");
        if (window.session()->eventsSent() == sentBefore) press("confirmButton");  // the page asks about a doubtful reading
    }
    void operator()(const SittingPrepared&) const { enter(); }
    void operator()(const TrayReady& event) const
    {
        for (const std::string& piece : event.pieces) {
            gui.focusOn(QStringLiteral("pieceField"));
            gui.type(QString::fromStdString(piece));
            enter();
        }
        enter();
    }
    void operator()(const Touched& event) const
    {
        if (event.by == TouchSource::Display)
            window.session()->displayTouched();
        else
            gui.click(QStringLiteral("touchButton"));
    }
    void operator()(const Answered& event) const
    {
        window.session()->setStamps(event.stamps);
        const int entries = gui.plan().protocol.secondEntry ? 2 : 1;
        for (int entry = 0; entry < entries; ++entry) {
            give(event.response, formOf(gui.view()));
            enter();
            if (isWithoutWords(event.response)) enter();  // the page asks for a second Enter if nothing is written
        }
    }
    void operator()(const Corrected& event) const
    {
        // Logs of earlier versions and scripts may hold a correction to the same answer, which the page does not take.
        if (answerTo(event.question).response == event.response) return window.session()->send(event);
        click("correctButton");
        gui.click(QStringLiteral("answerTo") + QString::fromStdString(event.question.value));
        give(event.response, answerTo(event.question).form);
        if (isWithoutWords(event.response)) press("panelConfirmButton");
        giveReason(event.why, true);
    }
    void operator()(const Voided& event) const
    {
        // Logs of earlier versions and scripts may hold a void without a reason, which the page does not take.
        if (event.why.empty()) return window.session()->send(event);
        click("voidButton");
        giveReason(event.why, false);
    }
    void operator()(const BreakEnded&) const { enter(); }
    void operator()(const Paused&) const { click("pauseButton"); }
    void operator()(const Resumed&) const
    {
        if (gui.isOfferedPreparation())
            click("secondButton");
        else
            enter();
    }
    void operator()(const WithdrawnEvent& event) const
    {
        click("withdrawButton");
        gui.focusOn(QStringLiteral("confirmField"));
        gui.type(QString::fromStdString(gui.view().participant));
        giveReason(event.why, true);
    }
    void operator()(const Noted& event) const
    {
        click(event.isFlag ? "flagButton" : "noteButton");
        giveReason(event.text, !event.isFlag);
    }
    void operator()(const Debriefed& event) const
    {
        gui.type(QString::fromStdString(event.text));
        enter();
    }

private:
    /// A script's clock may stand still between an Enter and the second one that a page asks for.
    void enter() const
    {
        window.session()->waitOutDeadTime();
        gui.pressKey(Qt::Key_Return);
    }
    void click(const char* button) const { gui.click(QString::fromLatin1(button)); }
    void press(const char* button) const
    {
        gui.focusOn(QString::fromLatin1(button));
        enter();
    }

    void tick(const std::vector<std::string>& lines) const
    {
        const QStringList all = window.session()->facts().checklist;
        for (const std::string& line : lines) {
            const QString box = QStringLiteral("check%1").arg(all.indexOf(QString::fromStdString(line)) + 1);
            if (static_cast<QCheckBox&>(gui.widget(box)).isChecked()) continue;
            gui.focusOn(box);
            gui.pressKey(Qt::Key_Space);
        }
    }
    void fill(const std::map<std::string, std::string>& values, const QStringList& captions, const QString& line) const
    {
        for (const auto& [caption, value] : values) {
            gui.focusOn(line + QString::number(captions.indexOf(QString::fromStdString(caption)) + 1));
            gui.type(QString::fromStdString(value));
        }
    }
    void giveReason(const std::string& text, bool isAskedTwice) const
    {
        gui.focusOn(QStringLiteral("reasonField"));
        gui.type(QString::fromStdString(text));
        enter();
        if (text.empty() && isAskedTwice) enter();
    }

    static bool isWithoutWords(const GivenAnswer& response)
    {
        const auto* words = std::get_if<Words>(&response);
        return words && words->text.empty();
    }
    Correctable answerTo(const protocols::QuestionId& question) const
    {
        for (const Correctable& one : window.session()->correctables())
            if (one.question == question) return one;
        throw cannotPerform("there is no answer to " + question.value);
    }
    void give(const GivenAnswer& response, const AnswerForm& form) const
    {
        if (const auto* choice = std::get_if<OptionsForm>(&form)) {
            for (const AnswerOption& option : choice->options)
                if (option.response == response) return gui.pressKey(option.letter.front().unicode());
            throw cannotPerform(textOf(response) + " is not one of the answers on the page");
        }
        const auto* rating = std::get_if<protocols::Tenths>(&response);
        gui.clear();
        gui.type(rating ? study::app::textOf(*rating) : QString::fromStdString(textOf(response)));
    }
};

}  // namespace

protocols::Error cannotPerform(const std::string& what)
{
    return protocols::workFailed({.what = "the window cannot send the next event: " + what,
                                  .where = "replay --gui",
                                  .expected = "the page of the script's next event",
                                  .nextStep = "replay the script without --gui and report this fault"});
}

void performInWindow(GuiOperator& gui, MainWindow& window, const EventBody& event)
{
    std::visit(EventActions{gui, window}, event);
}

}  // namespace study::app
