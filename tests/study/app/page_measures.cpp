#include "tests/study/app/page_measures.h"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QVariant>

#include "study/app/pieces/scale_line.h"

using study::app::ScaleLine;

namespace tests {

namespace {

/// Smallest rectangle around the visible texts, fields, buttons, lists and pictures in `root`, in coordinates of the window.
QRect contentOf(const QWidget& root)
{
    QRect content;
    for (const QWidget* widget : root.findChildren<QWidget*>()) {
        const auto* label = qobject_cast<const QLabel*>(widget);
        const bool isShown = isControl(*widget) || (label && !(label->text().isEmpty() && label->pixmap().isNull()));
        if (!widget->isVisible() || !isShown) continue;
        // A label may be wider than its text.
        const int textWidth = label ? label->fontMetrics().horizontalAdvance(label->text()) : widget->width();
        const bool isText = label && !label->text().isEmpty();
        const int width = isText ? std::min(label->width(), textWidth) : widget->width();
        content |= QRect(widget->mapTo(root.window(), QPoint()), QSize(width, widget->height()));
    }
    return content & root.window()->rect();
}

}  // namespace

bool isControl(const QWidget& widget)
{
    return qobject_cast<const QAbstractButton*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
           qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QPlainTextEdit*>(&widget) ||
           qobject_cast<const ScaleLine*>(&widget) ||
           (qobject_cast<const QAbstractItemView*>(&widget) && widget.focusPolicy() != Qt::NoFocus);
}

QStringList cutTextsIn(const QWidget& page)
{
    QStringList cut;
    for (const QWidget* widget : page.findChildren<QWidget*>()) {
        if (!widget->isVisible()) continue;
        const auto* label = qobject_cast<const QLabel*>(widget);
        const bool isBar = widget->property("role").toString() == QLatin1String("bar");
        if (isBar && widget->height() < widget->heightForWidth(widget->width())) cut << widget->objectName();
        const bool isButton = qobject_cast<const QAbstractButton*>(widget);
        const bool isTooLow = label && label->wordWrap() && label->height() < label->heightForWidth(label->width());
        const bool isOneLine = isButton || (label && !label->wordWrap());
        const bool isTooSmall = isOneLine && widget->width() < widget->minimumSizeHint().width();
        const bool isOutside = (isButton || label) && !widget->parentWidget()->rect().contains(widget->geometry());
        if (isTooLow || isTooSmall || isOutside)
            cut << QStringLiteral("%1 (%2x%3, wants %4x%5)")
                       .arg(widget->objectName())
                       .arg(widget->width())
                       .arg(widget->height())
                       .arg(widget->minimumSizeHint().width())
                       .arg(widget->heightForWidth(widget->width()));
    }
    return cut;
}

QStringList wideAreasIn(const QWidget& page)
{
    QStringList wide;
    for (const auto* area : page.findChildren<QAbstractScrollArea*>())
        if (area->isVisible() && area->horizontalScrollBar()->maximum() > 0)
            wide << QStringLiteral("%1 by %2 px").arg(area->objectName()).arg(area->horizontalScrollBar()->maximum());
    return wide;
}

QStringList hiddenActionsIn(const QWidget& page)
{
    QStringList hidden;
    for (const auto* button : page.findChildren<QAbstractButton*>())
        if (button->isVisible() && button->isEnabled() && button->property("role").toString() == QLatin1String("main") &&
            button->visibleRegion().boundingRect() != button->rect())
            hidden << button->objectName();
    return hidden;
}

void settle(QWidget& window)
{
    constexpr int longestMs = 5000, lookMs = 40, stillLooks = 5;
    const auto look = [&window] {
        QString places;
        for (const QWidget* widget : window.findChildren<QWidget*>())
            if (widget->isVisible())
                places += QStringLiteral("%1,%2,%3,%4,%5 ")
                              .arg(widget->x())
                              .arg(widget->y())
                              .arg(widget->width())
                              .arg(widget->height())
                              .arg(widget->font().pointSizeF());
        return places;
    };
    QString before;
    for (int still = 0, waitedMs = 0; still < stillLooks && waitedMs < longestMs; waitedMs += lookMs) {
        QTest::qWait(lookMs);
        const QString now = look();
        still = now == before ? still + 1 : 0;
        before = now;
    }
}

double shareOfContent(const QWidget& window)
{
    double covered = 0;
    const auto add = [&](const QWidget& part) {
        const QRect content = contentOf(part);
        covered += 1.0 * content.width() * content.height();
    };
    for (const auto* area : window.findChildren<QScrollArea*>())
        if (area->isVisible()) add(*area);
    for (const char* bar : {"sessionHeader", "sessionFooter"})
        if (const auto* found = window.findChild<QWidget*>(QLatin1String(bar)); found && found->isVisible()) add(*found);
    return covered / (1.0 * window.width() * window.height());
}

}  // namespace tests
