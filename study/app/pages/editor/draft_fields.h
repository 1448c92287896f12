// The controls of a protocol draft: each is bound to a place of the draft and has the place as its object name. Holds the draft
// with its history, and knows which control a fault belongs to.
#pragma once

#include <QObject>
#include <functional>
#include <string>
#include <vector>

#include "study/app/drafts/draft_history.h"

class QBoxLayout;
class QComboBox;
class QLineEdit;
class QListWidget;
class QPlainTextEdit;
class QVBoxLayout;
class QWidget;

namespace study::app {

class FlowLayout;
class TickBox;

class DraftFields : public QObject {
    Q_OBJECT
public:
    explicit DraftFields(QObject* parent) : QObject(parent) {}

    const ProtocolDraft& draft() const { return m_history.now(); }
    const DraftHistory& history() const { return m_history; }
    /// Begins with another draft; nothing can be undone then.
    void begin(const ProtocolDraft& draft);
    /// One step: changes the draft by `work` and shows it in all controls.
    void change(const std::function<void(ProtocolDraft&)>& work);
    void undo();
    void redo();

    // ---- controls. `caption` is shown above the control and names it in faults and for screen readers.
    QLineEdit* addLine(QBoxLayout& column, const std::string& place, const QString& caption, FieldKind kind,
                       const QString& hint = {});
    /// A short field beside others.
    QLineEdit* addShortLine(FlowLayout& row, const std::string& place, const QString& caption, FieldKind kind,
                            const QString& hint = {});
    /// Several lines. With Lines, each line is an element of a list; with Text they are one text.
    QPlainTextEdit* addLines(QBoxLayout& column, const std::string& place, const QString& caption, FieldKind kind,
                             const QString& hint = {});
    TickBox* addTick(QBoxLayout& column, const std::string& place, const QString& caption);
    /// Binds a control that is filled elsewhere, so that faults of the place lead to it.
    void bind(const std::string& place, const QString& caption, QWidget& control);
    /// Edits the draft from a control that is filled elsewhere, without showing it in the controls again. `field`: see
    /// DraftHistory.
    void edit(const std::string& field, const std::function<void(ProtocolDraft&)>& work);
    /// Forgets the controls inside this widget, which are about to be destroyed.
    void forget(const QWidget& widget);

    struct Bound {
        std::string place;
        QString caption;
        QWidget* control;
        std::function<void()> show;  ///< fills the control from the draft; empty if that is done elsewhere
    };
    /// The control of `place`, else one inside it, else that of the smallest part around it; null if there is none.
    const Bound* boundAt(const std::string& place) const;

Q_SIGNALS:
    /// The draft was replaced or has other parts; sections show it again.
    void replaced();
    /// The draft differs from before, by whatever change.
    void edited();
    /// The operator works at this place.
    void visited(const QString& place);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void take(const std::string& place, FieldKind kind, const QString& typed);
    void showAll();
    QLineEdit* boundLine(const std::string& place, const QString& caption, FieldKind kind, const QString& hint, QWidget* parent);

    DraftHistory m_history;
    std::vector<Bound> m_bound;
    bool m_isShowing = false;
};

/// A number with the decimal mark of the window's language; any other text as it is.
QString withDecimalMark(QString text);

/// A caption above its control.
void addCaptioned(QBoxLayout& column, const QString& caption, QWidget& control);

/// Caption and control side by side in one widget, for flowing rows.
QWidget* captioned(const QString& caption, QWidget& control, QWidget* parent);

/// A combo box that a wheel over the page does not change.
QComboBox* choiceBox(const char* objectName, const QString& accessibleName, QWidget* parent);

/// Gives the field the height of its lines, at least 3 and at most 8.
void fitLines(QPlainTextEdit& words);

/// Gives the list the height of its rows, at most `mostRows`, at every size of the text.
void fitRows(QListWidget& list, int mostRows);

/// Orders the controls in the widget for the Tab key as its layout shows them.
void orderTabs(QWidget& widget);

/// A title with a sentence below it.
void addHead(QBoxLayout& column, const char* objectName, const QString& title, const QString& sentence);

/// A small title inside a section.
void addSmallHead(QBoxLayout& column, const char* objectName, const QString& title, const QString& sentence = {});

}  // namespace study::app
