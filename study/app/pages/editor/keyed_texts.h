// A list of texts by key, such as the sentences on the participant's screen, and a field for the one that is chosen. The field
// shows what stands there without an own text.
#pragma once

#include <QWidget>
#include <functional>
#include <string>
#include <vector>

#include "study/app/drafts/draft_texts.h"

class QListWidget;
class QPlainTextEdit;

namespace study::app {

class DraftFields;

class KeyedTexts : public QWidget {
    Q_OBJECT
public:
    struct Kind {
        std::string object;  ///< of the draft, and object name of the field
        QString listCaption, fieldCaption;
        std::function<std::vector<KeyedText>(const ProtocolDraft&)> offered;
        QString hint;  ///< shown in the field of a text that has no usual one
    };
    KeyedTexts(DraftFields& fields, Kind kind, QWidget* parent);

    const std::string& object() const { return m_kind.object; }
    /// Chooses the text with this key, if it is offered.
    void choose(const std::string& key);

Q_SIGNALS:
    /// The operator works at the text with this key.
    void chosen(const QString& key);

private:
    void list();
    void showChosen();
    void showUsual();
    void take();
    QString rowOf(const KeyedText& text) const;

    DraftFields& m_fields;
    Kind m_kind;
    std::vector<KeyedText> m_texts;
    QListWidget* m_list;
    QPlainTextEdit* m_field;
    bool m_isShowing = false;
};

}  // namespace study::app
