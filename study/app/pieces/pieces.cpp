#include "study/app/pieces/pieces.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QStyle>
#include <QVBoxLayout>
#include <QVariant>

#include "study/app/pieces/flow_layout.h"

namespace study::app {

namespace {

/// Sets the property and repeats the styling of a widget that is already styled.
void setStyledProperty(QWidget& widget, const char* property, const char* value)
{
    if (widget.property(property).toString() == QLatin1String(value)) return;
    widget.setProperty(property, QString::fromLatin1(value));
    if (!widget.testAttribute(Qt::WA_WState_Polished)) return;
    widget.style()->unpolish(&widget);
    widget.style()->polish(&widget);
}

}  // namespace

void setType(QWidget& widget, Type type, Weight weight)
{
    setStyledProperty(widget, "type", nameOf(type));
    setStyledProperty(widget, "weight", weight == Weight::Bold ? "bold" : "normal");
}

void setRole(QWidget& widget, const char* role) { setStyledProperty(widget, "role", role); }

QLabel* label(const char* objectName, Type type, QWidget* parent, Weight weight)
{
    auto* made = new QLabel(parent);
    made->setObjectName(QString::fromLatin1(objectName));
    made->setTextFormat(Qt::PlainText);
    made->setWordWrap(true);
    setType(*made, type, weight);
    return made;
}

QLabel* quietLabel(const char* objectName, QWidget* parent, Type type)
{
    QLabel* made = label(objectName, type, parent);
    setRole(*made, "quiet");
    return made;
}

void setButtonText(QPushButton& target, const QString& text)
{
    target.setText(QString(text).replace(QLatin1Char('&'), QLatin1String("&&")));
    target.setAccessibleName(text);
}

QPushButton* button(const char* objectName, const QString& text, QWidget* parent)
{
    auto* made = new QPushButton(parent);
    made->setObjectName(QString::fromLatin1(objectName));
    made->setAutoDefault(false);
    setType(*made, Type::Body);
    setButtonText(*made, text);
    return made;
}

QPushButton* mainButton(const char* objectName, const QString& text, QWidget* parent)
{
    QPushButton* made = button(objectName, text, parent);
    setRole(*made, "main");
    setType(*made, Type::Lead, Weight::Bold);
    return made;
}

QPushButton* plainButton(const char* objectName, const QString& text, QWidget* parent)
{
    QPushButton* made = button(objectName, text, parent);
    setRole(*made, "plain");
    setType(*made, Type::Plain);
    return made;
}

FlowLayout* actionsRow(std::initializer_list<QWidget*> actions)
{
    auto* row = new FlowLayout(14, 8);
    for (QWidget* action : actions) row->addWidget(action);
    return row;
}

QLineEdit* field(const char* objectName, const QString& accessibleName, QWidget* parent)
{
    auto* made = new QLineEdit(parent);
    name(*made, objectName, accessibleName);
    setType(*made, Type::Body);
    return made;
}

QLabel* appearanceHint(QWidget* parent)
{
    QLabel* made = quietLabel("appearanceHint", parent, Type::Small);
    made->setText(
        QCoreApplication::translate("study::app::appearanceHint", "Text size: Ctrl + and Ctrl −   ·   dark room: Ctrl D"));
    return made;
}

QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent)
{
    constexpr int widestPx = 1250;
    constexpr int marginPx = 28;
    auto* area = new QScrollArea(parent);
    area->setObjectName(QString::fromLatin1(objectName));
    area->setWidgetResizable(true);
    area->setFocusPolicy(Qt::NoFocus);
    area->setFrameShape(QFrame::NoFrame);
    auto* whole = new QWidget(area);
    auto* row = new QHBoxLayout(whole);
    row->setContentsMargins(marginPx, 22, marginPx, 18);
    row->setSpacing(0);
    page->setMaximumWidth(widestPx);
    if (page->layout()) page->layout()->setContentsMargins(0, 0, 0, 0);
    row->addWidget(page, 1);
    row->addStretch(0);
    area->setWidget(whole);
    area->viewport()->setAutoFillBackground(false);
    whole->setAutoFillBackground(false);
    // Scroll to a control that gets the focus outside the visible part.
    QObject::connect(qApp, &QApplication::focusChanged, area, [area](QWidget*, QWidget* now) {
        if (now && area->isVisible() && area->isAncestorOf(now)) area->ensureWidgetVisible(now, 0, marginPx);
    });
    return area;
}

void clearLayout(QLayout& layout)
{
    while (QLayoutItem* item = layout.takeAt(0)) {
        delete item->widget();
        delete item;
    }
}

void setTabOrderAfter(const QWidget& controls, std::initializer_list<QWidget*> following)
{
    QWidget* before = nullptr;
    for (QWidget* control : controls.findChildren<QWidget*>())
        if (control->focusPolicy() & Qt::TabFocus) before = control;
    for (QWidget* next : following) {
        if (before) QWidget::setTabOrder(before, next);
        before = next;
    }
}

void name(QWidget& widget, const char* objectName, const QString& accessibleName)
{
    widget.setObjectName(QString::fromLatin1(objectName));
    widget.setAccessibleName(accessibleName);
}

void showText(QLabel& target, const QString& text)
{
    target.setText(text);
    target.setVisible(!text.isEmpty());
}

PageHead::PageHead(QWidget* parent)
    : QWidget(parent), m_title(label("pageTitle", Type::Title, this, Weight::Bold)), m_lead(label("pageLead", Type::Lead, this))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(12);
    column->addWidget(m_title);
    column->addWidget(m_lead);
}

void PageHead::setTexts(const QString& title, const QString& lead)
{
    m_title->setText(title);
    showText(*m_lead, lead);
}

MessageBar::MessageBar(const char* objectName, QWidget* parent) : QLabel(parent)
{
    setObjectName(QString::fromLatin1(objectName));
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setType(*this, Type::Body);
    hide();
}

void MessageBar::clearMessage()
{
    clear();
    hide();
}

void MessageBar::showAs(const char* role, const QString& text)
{
    setRole(*this, role);
    setText(text);
    setAccessibleName(text);
    setVisible(!text.isEmpty());
}

}  // namespace study::app
