// The beginning of the editor: a new protocol from an example, or a protocol file to change.
#pragma once

#include <QWidget>
#include <filesystem>

class QLineEdit;
class QListWidget;
class QPushButton;

namespace study::app {

class MessageBar;

class EditorStart : public QWidget {
    Q_OBJECT
public:
    explicit EditorStart(QWidget* parent);

    void focusFirst();
    void focusFile();
    void showFault(const QString& text);
    /// Begins with the chosen example, or opens the named file, by where the focus is.
    void accept();

Q_SIGNALS:
    /// The text of a protocol to begin with; empty for an empty protocol.
    void exampleChosen(const QString& text);
    void fileChosen(const QString& file);
    void backRequested();

private:
    void addExamples();
    void begin();
    void browse();
    void open();

    QListWidget* m_examples;
    QPushButton* m_begin;
    QLineEdit* m_file;
    QPushButton* m_browse;
    QPushButton* m_open;
    QPushButton* m_back;
    MessageBar* m_message;
};

}  // namespace study::app
