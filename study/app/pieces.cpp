#include "study/app/pieces.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QStyle>
#include <QVariant>

namespace study::app {

namespace {

constexpr auto sizeProperty = "typeSize";

void applyTypeSize(QWidget& widget)
{
    QFont font = widget.font();
    font.setPointSizeF(QApplication::font().pointSizeF() * widget.property(sizeProperty).toDouble());
    widget.setFont(font);
}

}  // namespace

void setTypeSize(QWidget& widget, double factor, Weight weight)
{
    widget.setProperty(sizeProperty, factor);
    QFont font = widget.font();
    font.setBold(weight == Weight::Bold);
    widget.setFont(font);
    applyTypeSize(widget);
}

void refreshTypeSizes(QWidget& root)
{
    const auto widgets = root.findChildren<QWidget*>();
    for (QWidget* widget : widgets)
        if (widget->property(sizeProperty).isValid())
            applyTypeSize(*widget);
}

void setRole(QWidget& widget, const char* role)
{
    if (widget.property("role").toString() == QLatin1String(role))
        return;
    widget.setProperty("role", QString::fromLatin1(role));
    widget.style()->unpolish(&widget);
    widget.style()->polish(&widget);
}

QLabel* label(const char* objectName, double factor, QWidget* parent, Weight weight)
{
    auto* made = new QLabel(parent);
    made->setObjectName(QString::fromLatin1(objectName));
    made->setTextFormat(Qt::PlainText);
    made->setWordWrap(true);
    setTypeSize(*made, factor, weight);
    return made;
}

QLabel* quietLabel(const char* objectName, QWidget* parent, double factor)
{
    QLabel* made = label(objectName, factor, parent);
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
    setTypeSize(*made, size::body);
    setButtonText(*made, text);
    return made;
}

QPushButton* mainButton(const char* objectName, const QString& text, QWidget* parent)
{
    QPushButton* made = button(objectName, text, parent);
    setRole(*made, "main");
    setTypeSize(*made, size::lead, Weight::Bold);
    return made;
}

QPushButton* plainButton(const char* objectName, const QString& text, QWidget* parent)
{
    QPushButton* made = button(objectName, text, parent);
    setRole(*made, "plain");
    setTypeSize(*made, 1.0);
    return made;
}

QLineEdit* field(const char* objectName, const QString& accessibleName, QWidget* parent)
{
    auto* made = new QLineEdit(parent);
    name(*made, objectName, accessibleName);
    setTypeSize(*made, size::body);
    return made;
}

QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent)
{
    constexpr int widestPx = 1000;
    auto* area = new QScrollArea(parent);
    area->setObjectName(QString::fromLatin1(objectName));
    area->setWidgetResizable(true);
    area->setFocusPolicy(Qt::NoFocus);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    auto* middle = new QWidget(area);
    auto* row = new QHBoxLayout(middle);
    row->setContentsMargins(24, 16, 24, 16);
    page->setMaximumWidth(widestPx);
    row->addWidget(page, 1);
    area->setWidget(middle);
    return area;
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

MessageBar::MessageBar(const char* objectName, QWidget* parent) : QLabel(parent)
{
    setObjectName(QString::fromLatin1(objectName));
    setTextFormat(Qt::PlainText);
    setWordWrap(true);
    setTypeSize(*this, size::body);
    hide();
}

void MessageBar::clearMessage()
{
    clear();
    hide();
}

void MessageBar::tell(const char* role, const QString& text)
{
    setRole(*this, role);
    setText(text);
    setAccessibleName(text);
    show();
}

}  // namespace study::app
