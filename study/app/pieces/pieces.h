// The few pieces that all pages are made of, so that they look and read alike. Their looks go by the properties
// "role", "type" and "weight", which the style sheet reads (appearance.h); every piece has an object name, and every
// control a name for screen readers.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <initializer_list>

#include "study/app/state/appearance.h"

namespace study::app {

class FlowLayout;

enum class Weight { Normal, Bold };

/// Gives the widget its size of text; the style sheet follows it at every scale.
void setType(QWidget& widget, Type type, Weight weight = Weight::Normal);

/// Changes the role and lets the style sheet look again.
void setRole(QWidget& widget, const char* role);

/// A wrapped line of text.
QLabel* label(const char* objectName, Type type, QWidget* parent, Weight weight = Weight::Normal);
QLabel* quietLabel(const char* objectName, QWidget* parent, Type type = Type::Body);

/// `text` is also the accessible name. Ampersands are shown, not taken as mnemonics.
QPushButton* button(const char* objectName, const QString& text, QWidget* parent);
QPushButton* mainButton(const char* objectName, const QString& text, QWidget* parent);
QPushButton* plainButton(const char* objectName, const QString& text, QWidget* parent);
void setButtonText(QPushButton& button, const QString& text);

/// Beside each other, or below each other where they do not fit.
FlowLayout* actionsRow(std::initializer_list<QWidget*> actions);

QLineEdit* field(const char* objectName, const QString& accessibleName, QWidget* parent);

/// How text size and theme are changed, for the pages that are not in a hurry.
QLabel* appearanceHint(QWidget* parent);

/// The page inside an area that scrolls where the text is too large for the window; no wider than is
/// pleasant to read.
QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent);

/// Deletes what lies in the layout.
void clearLayout(QLayout& layout);

/// Tab leads from the last of the controls inside `controls` to these, one after another: for controls that were made
/// after what stands below them.
void setTabOrderAfter(const QWidget& controls, std::initializer_list<QWidget*> following);

/// Object name and accessible name in one go.
void name(QWidget& widget, const char* objectName, const QString& accessibleName);

/// Shows text that may be empty: hides the label then.
void showText(QLabel& label, const QString& text);

/// Title of a page and a sentence below it.
class PageHead : public QWidget {
    Q_OBJECT
public:
    explicit PageHead(QWidget* parent);
    void setTexts(const QString& title, const QString& lead);

private:
    QLabel* m_title;
    QLabel* m_lead;
};

/// A message for the operator: that something was done, a hint or refusal, a fault. Empty text is none.
class MessageBar : public QLabel {
    Q_OBJECT
public:
    explicit MessageBar(const char* objectName, QWidget* parent);
    void showDone(const QString& text) { showAs("done", text); }
    void showHint(const QString& text) { showAs("hint", text); }
    void showFault(const QString& text) { showAs("fault", text); }
    void clearMessage();

private:
    void showAs(const char* role, const QString& text);
};

}  // namespace study::app
