// Widgets and helper functions shared by all pages, so that the pages look and read alike. Their style depends on the
// properties "role", "type" and "weight", which the style sheet reads (appearance.h). Every widget has an object name, and
// every control has a name for screen readers.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <initializer_list>
#include <utility>
#include <vector>

#include "study/app/state/appearance.h"

namespace study::app {

class FlowLayout;

enum class Weight { Normal, Bold };

/// Sets the text size of the widget; the style sheet scales it.
void setType(QWidget& widget, Type type, Weight weight = Weight::Normal);

/// Sets the role and applies the style sheet again.
void setRole(QWidget& widget, const char* role);

/// Label with word wrap.
QLabel* label(const char* objectName, Type type, QWidget* parent, Weight weight = Weight::Normal);
QLabel* quietLabel(const char* objectName, QWidget* parent, Type type = Type::Body);

/// `text` is also the accessible name. Ampersands are shown and mark no mnemonics.
QPushButton* button(const char* objectName, const QString& text, QWidget* parent);
QPushButton* mainButton(const char* objectName, const QString& text, QWidget* parent);
QPushButton* plainButton(const char* objectName, const QString& text, QWidget* parent);
void setButtonText(QPushButton& button, const QString& text);

/// Row of buttons that continues below if the window is too narrow.
FlowLayout* actionsRow(std::initializer_list<QWidget*> actions);

QLineEdit* field(const char* objectName, const QString& accessibleName, QWidget* parent);

/// Buttons for the text size and the theme, with their keys; for pages where the operator has time to read them.
QWidget* appearanceHint(QWidget* parent);

/// Puts the page into an area that scrolls if the text is too large for the window, and limits its width for easy reading.
QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent);

/// Scrolls the area around the widget to it, once the layout has its new sizes. Does nothing outside such an area.
void bringIntoView(QWidget& widget);

/// Whether the window has only few lines of this text size, so that bars must take no room from the answer.
bool isLowFor(const QWidget& bar);

/// Deletes all widgets in the layout.
void clearLayout(QLayout& layout);

/// Puts `following` after the last control inside `controls` in the tab order. Needed for controls that were made later
/// than the ones below them.
void setTabOrderAfter(const QWidget& controls, std::initializer_list<QWidget*> following);

/// One short line for a name from outside the program, such as that of a display with the command of its driver.
QString shortName(const QString& whole);
/// The same name in full, for the tooltip.
QString fullName(const QString& whole);

/// Sets the object name and the accessible name.
void name(QWidget& widget, const char* objectName, const QString& accessibleName);

/// Sets the text, and hides the label if the text is empty.
void showText(QLabel& label, const QString& text);

/// Title of a page with a sentence below it.
class PageHead : public QWidget {
    Q_OBJECT
public:
    explicit PageHead(QWidget* parent);
    void setTexts(const QString& title, const QString& lead);

private:
    QLabel* m_title;
    QLabel* m_lead;
};

/// Message for the operator: a confirmation, a hint or refusal, or a fault. Hidden while its text is empty.
class MessageBar : public QLabel {
    Q_OBJECT
public:
    explicit MessageBar(const char* objectName, QWidget* parent);
    void showDone(const QString& text) { showAs("done", text); }
    void showHint(const QString& text) { showAs("hint", text); }
    void showFault(const QString& text) { showAs("fault", text); }
    void clearMessage();
    void clearFault();  ///< leaves a hint, and what was done
    /// Moves the bar below this control, or below the row of the control.
    void standBelow(QWidget& control);

private:
    void showAs(const char* role, const QString& text);
};

}  // namespace study::app
