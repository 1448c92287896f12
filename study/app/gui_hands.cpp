#include "study/app/gui_hands.h"

#include "protocols/errors.h"
#include "study/app/rating_text.h"
#include "study/app/stage_page.h"

#include <QApplication>
#include <QCheckBox>
#include <QKeyEvent>
#include <QMouseEvent>

#include <algorithm>

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

int keyOfSlot(std::size_t place)
{
    return Qt::Key_A + static_cast<int>(place);
}

std::size_t placeOf(const protocols::FabricId& fabric, const std::vector<protocols::FabricId>& tray)
{
    const auto found = std::find(tray.begin(), tray.end(), fabric);
    if (found == tray.end())
        throw noWay(fabric.value + " is not on the tray");
    return static_cast<std::size_t>(found - tray.begin());
}

QString textOfKey(int key)
{
    const bool isCharacter = key >= Qt::Key_Space && key <= Qt::Key_AsciiTilde;
    return isCharacter ? QString(QChar(key)).toLower() : QString();
}

void sendKey(QWidget& target, int key, const QString& text)
{
    QKeyEvent press(QEvent::KeyPress, key, Qt::NoModifier, text);
    QApplication::sendEvent(&target, &press);
}

/// The movements that lead to each kind of event.
struct Movement {
    GuiHands& hands;
    MainWindow& window;

    void operator()(const SittingStarted&) const { throw noWay("a sitting starts when its session is opened"); }
    void operator()(const Begun&) const { hands.pressKey(Qt::Key_Return); }
    void operator()(const FamiliarisationDone&) const { hands.pressKey(Qt::Key_Return); }
    void operator()(const ScaleTrainingDone&) const
    {
        tickAll();
        hands.pressKey(Qt::Key_Return);
    }
    void operator()(const TrayReady&) const { hands.pressKey(Qt::Key_Return); }
    void operator()(const Touched&) const { hands.pressKey(Qt::Key_T); }
    void operator()(const Answered& event) const
    {
        if (const auto* fabric = std::get_if<protocols::FabricId>(&event.response))
            hands.pressKey(keyOfSlot(placeOf(*fabric, hands.view().trayIds)));
        else
            hands.type(textOf(std::get<protocols::Tenths>(event.response)));
        hands.pressKey(Qt::Key_Return);
    }
    void operator()(const Corrected& event) const
    {
        hands.pressKey(Qt::Key_L);
        chooseQuestion(event.question);
        giveNewAnswer(event);
        typeInto("whyField", event.why);
    }
    void operator()(const Voided& event) const
    {
        hands.pressKey(Qt::Key_V);
        typeInto("reasonField", event.why);
    }
    void operator()(const BreakEnded&) const { hands.pressKey(Qt::Key_Return); }
    void operator()(const Paused&) const { hands.pressKey(Qt::Key_Escape); }
    void operator()(const Resumed&) const { hands.pressKey(Qt::Key_Return); }
    void operator()(const WithdrawnEvent& event) const
    {
        hands.pressKey(Qt::Key_W);
        typeInto("reasonField", event.why);
    }
    void operator()(const Noted& event) const
    {
        hands.pressKey(Qt::Key_N);
        typeInto("reasonField", event.text);
    }

private:
    void tickAll() const
    {
        const auto boxes = window.currentPage()->findChildren<QCheckBox*>();
        for (QCheckBox* box : boxes)
            if (box->isVisible() && !box->isChecked()) {
                hands.focusOn(box->objectName());
                hands.pressKey(Qt::Key_Space);
            }
    }
    void typeInto(const char* fieldName, const std::string& text) const
    {
        hands.focusOn(QString::fromLatin1(fieldName));
        hands.type(QString::fromStdString(text));
        hands.pressKey(Qt::Key_Return);
        if (text.empty())
            hands.pressKey(Qt::Key_Return);  // the page asks once whether it is to go without a reason
    }
    void chooseQuestion(const protocols::QuestionId& question) const
    {
        hands.click(QStringLiteral("answerTo") + QString::fromStdString(question.value));
    }
    void giveNewAnswer(const Corrected& event) const
    {
        if (const auto* rating = std::get_if<protocols::Tenths>(&event.response)) {
            hands.focusOn(QStringLiteral("newRatingField"));
            hands.type(textOf(*rating));
            return;
        }
        const auto correctables = window.session()->correctables();
        const auto answer = std::find_if(correctables.begin(), correctables.end(),
                                         [&](const Correctable& one) { return one.question == event.question; });
        std::vector<protocols::FabricId> tray;
        for (const auto& choice : answer->choices)
            tray.push_back(choice.fabric);
        const std::size_t place = placeOf(std::get<protocols::FabricId>(event.response), tray);
        hands.click(QStringLiteral("newAnswer%1").arg(slotLetter(place)));
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

QWidget& GuiHands::visible(const QString& objectName) const
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
    for (const char32_t character : text.toStdU32String())
        sendKey(focus(), static_cast<int>(QChar::toUpper(character)), QString::fromUcs4(&character, 1));
}

void GuiHands::focusOn(const QString& objectName)
{
    visible(objectName).setFocus(Qt::TabFocusReason);
}

void GuiHands::click(const QString& objectName)
{
    QWidget& target = visible(objectName);
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
