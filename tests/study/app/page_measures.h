// What can be measured on a page: its controls, texts that are cut, and the share of the window that content covers.
#pragma once

#include <QRect>
#include <QStringList>
#include <QWidget>

namespace tests {

/// Whether the operator can use the widget.
bool isControl(const QWidget& widget);

/// Buttons and labels that are too small for their text.
QStringList cutTextsIn(const QWidget& page);

/// Areas with content that is wider than themselves and would need sideways scrolling.
QStringList wideAreasIn(const QWidget& page);

/// Main buttons that can be pressed and of which a part is hidden. Without scrolling, pages show them in full.
QStringList hiddenActionsIn(const QWidget& page);

/// Waits until texts and gaps have followed the size of the window and of the text: nothing moves for a while any more.
void settle(QWidget& window);

/// Share of the window that content covers. Header, page and footer count one by one, so that the gaps between them do not.
double shareOfContent(const QWidget& window);

}  // namespace tests
