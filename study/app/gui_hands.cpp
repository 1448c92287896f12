#include "study/app/gui_hands.h"

#include "protocols/errors.h"
#include "study/app/rating_text.h"
#include "study/app/session_page.h"
#include "study/app/stage_page.h"

#include <QApplication>
#include <QCheckBox>
#include <QKeyEvent>
#include <QMouseEvent>


namespace study::app {

using namespace session;

namespace {

protocols::Error noWay(const std::string& what)
{
    return protocols::workFailed({.what = "the window cannot be driven on: " + what,
                                  .where = "replay --gui",
                                  .expected = "the page of the script's next event",
                                  .nextStep = "replay the script without --gui, and report this"});
}

QString textOfKey(int key)
{
    const bool isCharacter = key >= Qt::Key_Space && key <= Qt::Key_AsciiTilde;
    return isCharacter ? QString(QChar(key)).toLower() : QString();
}

void sendKey(QWidget& target, int key, const QString& text, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    QKeyEvent press(QEvent::KeyPress, key, modifiers, text);
    QApplication::sendEvent(&target, &press);
}

/// The movements that lead to each kind of event.
struct Movement {
    GuiHands& hands;
    MainWindow& window;

    void operator()(const SittingStarted&) const { throw noWay("a sitting starts when its session is opened"); }
    void operator()(const Begun&) const { enter(); }
    void operator()(const Consented&) const { enter(); }
    void operator()(const FactsGiven& event) const
    {
        fill(event.facts, window.session()->facts().facts, QStringLiteral("fact"));
        press("confirmButton");
    }
    void operator()(const FamiliarisationShown& event) const { hands.pressKey(Qt::Key_1 + event.item); }
    void operator()(const FamiliarisationDone&) const { enter(); }
    void operator()(const ScalePlaced& event) const
    {
        hands.type(study::app::textOf(event.spoken));
        enter();
    }
    void operator()(const ScaleTrainingDone&) const { hands.pressKey(Qt::Key_G); }
    void operator()(const ChecklistDone& event) const
    {
        tick(event.ticked);
        fill(event.readings, window.session()->facts().readings, QStringLiteral("reading"));
        press("confirmButton");
    }
    void operator()(const SittingPrepared&) const { enter(); }
    void operator()(const TrayReady&) const { enter(); }
    void operator()(const Touched& event) const
    {
        if (event.by == TouchSource::Display)
            window.session()->displayTouched();
        else
            hands.click(QStringLiteral("touchButton"));
    }
    void operator()(const Answered& event) const
    {
        const int entries = hands.plan().protocol.secondEntry ? 2 : 1;
        for (int entry = 0; entry < entries; ++entry) {
            give(event.response, formOf(hands.view()));
            enter();
            if (isWithoutWords(event.response))
                enter();  // the page asks once whether there are none
        }
    }
    void operator()(const Corrected& event) const
    {
        click("correctButton");
        hands.click(QStringLiteral("answerTo") + QString::fromStdString(event.question.value));
        give(event.response, formOfAnswerTo(event.question));
        if (isWithoutWords(event.response))
            press("panelConfirmButton");
        giveReason(event.why, true);
    }
    void operator()(const Voided& event) const
    {
        click("voidButton");
        giveReason(event.why, true);
    }
    void operator()(const BreakEnded&) const { enter(); }
    void operator()(const Paused&) const { click("pauseButton"); }
    void operator()(const Resumed&) const
    {
        if (hands.isOfferedPreparation())
            click("secondButton");
        else
            enter();
    }
    void operator()(const WithdrawnEvent& event) const
    {
        click("withdrawButton");
        giveReason(event.why, true);
    }
    void operator()(const Noted& event) const
    {
        click(event.isFlag ? "flagButton" : "noteButton");
        giveReason(event.text, !event.isFlag);
    }
    void operator()(const Debriefed& event) const
    {
        hands.type(QString::fromStdString(event.text));
        enter();
    }

private:
    void enter() const { hands.pressKey(Qt::Key_Return); }
    void click(const char* button) const { hands.click(QString::fromLatin1(button)); }
    void press(const char* button) const
    {
        hands.focusOn(QString::fromLatin1(button));
        enter();
    }

    void tick(const std::vector<std::string>& lines) const
    {
        const QStringList all = window.session()->facts().checklist;
        for (const std::string& line : lines) {
            const QString box = QStringLiteral("check%1").arg(all.indexOf(QString::fromStdString(line)) + 1);
            if (static_cast<QCheckBox&>(hands.widget(box)).isChecked())
                continue;
            hands.focusOn(box);
            hands.pressKey(Qt::Key_Space);
        }
    }
    void fill(const std::map<std::string, std::string>& values, const QStringList& captions, const QString& line) const
    {
        for (const auto& [caption, value] : values) {
            hands.focusOn(line + QString::number(captions.indexOf(QString::fromStdString(caption)) + 1));
            hands.type(QString::fromStdString(value));
        }
    }
    void giveReason(const std::string& text, bool isAskedTwice) const
    {
        hands.focusOn(QStringLiteral("reasonField"));
        hands.type(QString::fromStdString(text));
        enter();
        if (text.empty() && isAskedTwice)
            enter();
    }

    static bool isWithoutWords(const Response& response)
    {
        const auto* words = std::get_if<Words>(&response);
        return words && words->text.empty();
    }
    AnswerForm formOfAnswerTo(const protocols::QuestionId& question) const
    {
        for (const Correctable& one : window.session()->correctables())
            if (one.question == question)
                return one.form;
        throw noWay("there is no answer to " + question.value);
    }
    void give(const Response& response, const AnswerForm& form) const
    {
        for (const AnswerForm::Option& option : form.options)
            if (option.response == response)
                return hands.pressKey(option.letter.front().unicode());
        if (!form.options.empty())
            throw noWay(textOf(response) + " is not among the answers to choose from");
        const auto* rating = std::get_if<protocols::Tenths>(&response);
        hands.clear();
        hands.type(rating ? study::app::textOf(*rating) : QString::fromStdString(textOf(response)));
    }
};

}  // namespace

SessionController& GuiHands::controller() const
{
    if (!m_window.session())
        throw noWay("no session is open");
    return *m_window.session();
}

const View& GuiHands::view() const
{
    return controller().view();
}

const Plan& GuiHands::plan() const
{
    return controller().plan();
}

std::optional<Refusal> GuiHands::perform(const EventBody& event)
{
    if (isOfferedPreparation() && !controller().view().state.paused && !std::holds_alternative<SittingPrepared>(event))
        click(QStringLiteral("secondButton"));
    const int sentBefore = controller().eventsSent();
    std::visit(Movement{*this, m_window}, event);
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    const auto& outcome = controller().lastOutcome();
    const bool isSent = controller().eventsSent() == sentBefore + 1 && kindOf(outcome->event) == kindOf(event) &&
                        payloadJson(outcome->event) == payloadJson(event);
    if (!isSent)
        throw noWay("\"" + kindOf(event) + "\" did not come out of the page for " + nameOf(view().state));
    if (outcome->fault)
        std::rethrow_exception(outcome->fault);
    return outcome->refusal;
}

QWidget& GuiHands::focus() const
{
    QWidget* focused = m_window.focusWidget();
    return focused && focused->isVisible() ? *focused : m_window;
}

bool GuiHands::isOfferedPreparation() const
{
    const auto* page = qobject_cast<SessionPage*>(m_window.currentPage());
    return page && page->offersPreparation();
}

QWidget& GuiHands::widget(const QString& objectName) const
{
    const auto found = m_window.currentPage()->findChildren<QWidget*>(objectName);
    for (QWidget* widget : found)
        if (widget->isVisible() && widget->isEnabled())
            return *widget;
    throw noWay("\"" + objectName.toStdString() + "\" is not on the page, or is off");
}

void GuiHands::pressKey(int key)
{
    QWidget& target = focus();
    sendKey(target, key, textOfKey(key));
    QKeyEvent release(QEvent::KeyRelease, key, Qt::NoModifier, textOfKey(key));
    QApplication::sendEvent(&focus(), &release);
}

void GuiHands::type(const QString& text)
{
    for (const char32_t character : text.toStdU32String()) {
        const bool isNewLine = character == U'\n';
        const int key = isNewLine ? static_cast<int>(Qt::Key_Return) : static_cast<int>(QChar::toUpper(character));
        sendKey(focus(), key, QString::fromUcs4(&character, 1), isNewLine ? Qt::ShiftModifier : Qt::NoModifier);
    }
}

void GuiHands::clear()
{
    sendKey(focus(), Qt::Key_A, {}, Qt::ControlModifier);
    sendKey(focus(), Qt::Key_Delete, {});
}

void GuiHands::focusOn(const QString& objectName)
{
    widget(objectName).setFocus(Qt::TabFocusReason);
}

void GuiHands::click(const QString& objectName)
{
    QWidget& target = widget(objectName);
    clickAt(target, target.rect().center());
}

void GuiHands::clickAt(QWidget& target, const QPoint& point)
{
    const QPointF at(point);
    const QPointF global = target.mapToGlobal(at);
    QMouseEvent press(QEvent::MouseButtonPress, at, global, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&target, &press);
    QMouseEvent release(QEvent::MouseButtonRelease, at, global, Qt::LeftButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&target, &release);
}

}  // namespace study::app
