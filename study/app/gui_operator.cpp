#include "study/app/gui_operator.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>

#include "study/app/gui_actions.h"
#include "study/app/pages/session_page.h"
#include "study/session/session_record.h"

namespace study::app {

using namespace session;

namespace {

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

}  // namespace

SessionController& GuiOperator::controller() const
{
    if (!m_window.session()) throw cannotPerform("no session is open");
    return *m_window.session();
}

const View& GuiOperator::view() const { return controller().view(); }

const Plan& GuiOperator::plan() const { return controller().plan(); }

std::optional<Refusal> GuiOperator::perform(const EventBody& event)
{
    controller().waitOutDeadTime();
    if (isOfferedPreparation() && !controller().view().state.paused && !std::holds_alternative<SittingPrepared>(event))
        click(QStringLiteral("secondButton"));
    const int sentBefore = controller().eventsSent();
    performInWindow(*this, m_window, event);
    QApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
    const auto& outcome = controller().lastOutcome();
    const bool isSent = controller().eventsSent() == sentBefore + 1 && kindOf(outcome->event) == kindOf(event) &&
                        payloadJson(outcome->event) == payloadJson(event);
    if (!isSent) throw cannotPerform("the page for " + nameOf(view().state) + " did not send \"" + kindOf(event) + "\"");
    if (outcome->fault) std::rethrow_exception(outcome->fault);
    return outcome->refusal;
}

QWidget& GuiOperator::focus() const
{
    QWidget* focused = m_window.focusWidget();
    return focused && focused->isVisible() ? *focused : m_window;
}

bool GuiOperator::isOfferedPreparation() const
{
    const auto* page = qobject_cast<SessionPage*>(m_window.currentPage());
    return page && page->offersPreparation();
}

QWidget& GuiOperator::widget(const QString& objectName) const
{
    const auto found = m_window.currentPage()->findChildren<QWidget*>(objectName);
    for (QWidget* widget : found)
        if (widget->isVisible() && widget->isEnabled()) return *widget;
    throw cannotPerform("the page has no visible and enabled control \"" + objectName.toStdString() + "\"");
}

void GuiOperator::pressKey(int key)
{
    QWidget& target = focus();
    sendKey(target, key, textOfKey(key));
    QKeyEvent release(QEvent::KeyRelease, key, Qt::NoModifier, textOfKey(key));
    QApplication::sendEvent(&focus(), &release);
}

void GuiOperator::type(const QString& text)
{
    for (const char32_t character : text.toStdU32String()) {
        const bool isNewLine = character == U'\n';
        const int key = isNewLine ? static_cast<int>(Qt::Key_Return) : static_cast<int>(QChar::toUpper(character));
        sendKey(focus(), key, QString::fromUcs4(&character, 1), isNewLine ? Qt::ShiftModifier : Qt::NoModifier);
    }
}

void GuiOperator::clear()
{
    sendKey(focus(), Qt::Key_A, {}, Qt::ControlModifier);
    sendKey(focus(), Qt::Key_Delete, {});
}

void GuiOperator::focusOn(const QString& objectName) { widget(objectName).setFocus(Qt::TabFocusReason); }

void GuiOperator::click(const QString& objectName)
{
    QWidget& target = widget(objectName);
    clickAt(target, target.rect().center());
}

void GuiOperator::clickAt(QWidget& target, const QPoint& point)
{
    const QPointF at(point);
    const QPointF global = target.mapToGlobal(at);
    QMouseEvent press(QEvent::MouseButtonPress, at, global, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&target, &press);
    QMouseEvent release(QEvent::MouseButtonRelease, at, global, Qt::LeftButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&target, &release);
}

}  // namespace study::app
