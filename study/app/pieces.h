// The few pieces that all pages are made of, so that they look and read alike. Text sizes are factors of the
// application's font and follow it when it changes. Styling goes by the property "role" (appearance.h);
// every piece has an object name, and every control a name for screen readers.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>

class QBoxLayout;

namespace study::app {

/// Text sizes as factors of the application's font.
namespace size {
inline constexpr double small = 0.9;
inline constexpr double body = 1.15;
inline constexpr double lead = 1.45;
inline constexpr double title = 2.0;
inline constexpr double huge = 3.6;
}  // namespace size

enum class Weight { Normal, Bold };

/// Gives the widget its factor of the application's font, now and whenever that changes.
void setTypeSize(QWidget& widget, double factor, Weight weight = Weight::Normal);
/// After the application's font changed: sizes of all pieces under `root`.
void refreshTypeSizes(QWidget& root);

/// Changes the role and lets the style sheet look again.
void setRole(QWidget& widget, const char* role);

/// A wrapped line of text.
QLabel* label(const char* objectName, double factor, QWidget* parent, Weight weight = Weight::Normal);
QLabel* quietLabel(const char* objectName, QWidget* parent, double factor = size::body);

/// `text` is also the accessible name. Ampersands are shown, not taken as mnemonics.
QPushButton* button(const char* objectName, const QString& text, QWidget* parent);
QPushButton* mainButton(const char* objectName, const QString& text, QWidget* parent);
QPushButton* plainButton(const char* objectName, const QString& text, QWidget* parent);
void setButtonText(QPushButton& button, const QString& text);

QLineEdit* field(const char* objectName, const QString& accessibleName, QWidget* parent);

/// The page inside an area that scrolls where the text is too large for the window, centred and no wider
/// than is pleasant to read.
QScrollArea* scrolling(const char* objectName, QWidget* page, QWidget* parent);

/// Object name and accessible name in one go.
void name(QWidget& widget, const char* objectName, const QString& accessibleName);

/// Shows text that may be empty: hides the label then.
void showText(QLabel& label, const QString& text);

/// A message for the operator: hint, refusal or fault.
class MessageBar : public QLabel {
    Q_OBJECT
public:
    explicit MessageBar(const char* objectName, QWidget* parent);
    void tellHint(const QString& text) { tell("hint", text); }
    void tellFault(const QString& text) { tell("fault", text); }
    void clearMessage();

private:
    void tell(const char* role, const QString& text);
};

}  // namespace study::app
