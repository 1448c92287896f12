#include "study/app/pieces/pieces.h"

#include <QAbstractItemView>
#include <QAccessible>
#include <QApplication>
#include <QComboBox>
#include <QHBoxLayout>
#include <QStyle>
#include <QTimer>
#include <QVBoxLayout>
#include <QVariant>

#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"
#include "study/app/pieces/appearance_keys.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/page_fit.h"

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
    // A frame computes its padding on this event only.
    QEvent change(QEvent::StyleChange);
    QApplication::sendEvent(&widget, &change);
    widget.updateGeometry();
}

enum class Search { Missing, Found, Done };

/// Inserts `added` into the innermost column of the layout that holds the control, below it.
Search insertBelow(QLayout& layout, const QWidget& control, QWidget& added)
{
    for (int place = 0; place < layout.count(); ++place) {
        QLayoutItem& item = *layout.itemAt(place);
        Search search = item.widget() == &control ? Search::Found : Search::Missing;
        if (item.layout()) search = insertBelow(*item.layout(), control, added);
        if (search == Search::Missing) continue;
        auto* column = qobject_cast<QVBoxLayout*>(&layout);
        if (search == Search::Done || !column) return search;
        // It leaves its old place first, so what stands below that place moves up by one.
        const int own = column->indexOf(&added);
        column->insertWidget(own >= 0 && own <= place ? place : place + 1, &added);
        return Search::Done;
    }
    return Search::Missing;
}

constexpr int pageMarginPx = 28;

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

QWidget* appearanceHint(QWidget* parent)
{
    auto* made = new QWidget(parent);
    made->setObjectName("appearanceHint");
    auto* row = new FlowLayout(10, 4, made);
    const auto add = [&](const char* objectName, const char* text, void (AppearanceKeys::*work)()) {
        auto* key = plainButton(objectName, QCoreApplication::translate("study::app::appearanceHint", text), made);
        setType(*key, Type::Small);
        key->setFocusPolicy(Qt::NoFocus);  // the keys work everywhere, so Tab need not come here
        QObject::connect(key, &QPushButton::clicked, made, [made, work] {
            if (auto* keys = made->window()->findChild<AppearanceKeys*>()) (keys->*work)();
        });
        row->addWidget(key);
    };
    add("smallerTextButton", QT_TRANSLATE_NOOP("study::app::appearanceHint", "Smaller text (Ctrl −)"), &AppearanceKeys::reduce);
    add("largerTextButton", QT_TRANSLATE_NOOP("study::app::appearanceHint", "Larger text (Ctrl +)"), &AppearanceKeys::enlarge);
    add("themeButton", QT_TRANSLATE_NOOP("study::app::appearanceHint", "Light, dark or high contrast (Ctrl D)"),
        &AppearanceKeys::changeTheme);
    return made;
}

QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent)
{
    auto* area = new QScrollArea(parent);
    area->setObjectName(QString::fromLatin1(objectName));
    area->setWidgetResizable(true);
    area->setFocusPolicy(Qt::NoFocus);
    area->setFrameShape(QFrame::NoFrame);
    auto* whole = new QWidget(area);
    auto* row = new QHBoxLayout(whole);
    row->setContentsMargins(pageMarginPx, 22, pageMarginPx, 18);
    row->setSpacing(0);
    if (page->layout()) page->layout()->setContentsMargins(0, 0, 0, 0);
    row->addWidget(page, 1);
    row->addStretch(0);
    area->setWidget(whole);
    area->viewport()->setAutoFillBackground(false);
    whole->setAutoFillBackground(false);
    new PageFit(*area, *page);
    // Scroll to a control that gets the focus outside the visible part.
    QObject::connect(qApp, &QApplication::focusChanged, area, [area](QWidget*, QWidget* now) {
        if (now && area->isVisible() && area->isAncestorOf(now)) area->ensureWidgetVisible(now, 0, pageMarginPx);
    });
    return area;
}

void bringIntoView(QWidget& widget)
{
    QTimer::singleShot(0, &widget, [target = &widget] {
        QWidget* around = target->parentWidget();
        while (around && !qobject_cast<QScrollArea*>(around)) around = around->parentWidget();
        if (auto* area = qobject_cast<QScrollArea*>(around); area && target->isVisible())
            area->ensureWidgetVisible(target, 0, pageMarginPx);
    });
}

bool isLowFor(const QWidget& bar)
{
    constexpr int fewestLines = 36;
    return bar.window()->height() < fewestLines * QFontMetrics(QApplication::font()).height();
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
    if (auto* box = qobject_cast<QComboBox*>(&widget)) {
        box->view()->setObjectName(widget.objectName() + QStringLiteral("Rows"));
        box->view()->setAccessibleName(accessibleName);
    }
}

QString shortName(const QString& whole)
{
    constexpr std::size_t mostBytes = 60;
    return QString::fromStdString(protocols::inShort(protocols::printable(whole.toStdString()), mostBytes));
}

QString fullName(const QString& whole)
{
    // Only a tooltip in HTML breaks a long line.
    return whole.isEmpty() ? QString() : QStringLiteral("<span>%1</span>").arg(whole.toHtmlEscaped());
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

void MessageBar::standBelow(QWidget& control)
{
    if (QWidget* home = control.parentWidget(); home && home->layout()) insertBelow(*home->layout(), control, *this);
}

void MessageBar::clearMessage()
{
    clear();
    setAccessibleName({});
    hide();
}

void MessageBar::clearFault()
{
    if (property("role").toString() == QLatin1String("fault")) clearMessage();
}

void MessageBar::showAs(const char* role, const QString& text)
{
    ensurePolished();
    const bool isNew = !text.isEmpty() && (isHidden() || text != this->text());
    setRole(*this, role);
    setText(text);
    setAccessibleName(text);
    setVisible(!text.isEmpty());
    if (isNew) bringIntoView(*this);
    QAccessibleEvent alert(this, QAccessible::Alert);  // a screen reader reads the message at once
    QAccessible::updateAccessibility(&alert);
}

}  // namespace study::app
