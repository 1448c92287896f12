// Form of optional lines with captions: facts about a participant, readings of instruments.
#pragma once

#include <QStringList>
#include <QWidget>
#include <map>
#include <string>
#include <vector>

class QGridLayout;
class QLineEdit;

namespace study::app {

class LineForm : public QWidget {
    Q_OBJECT
public:
    /// `objectName`: prefix of the object names of the lines; the number of the line, from 1, follows.
    LineForm(const char* objectName, QWidget* parent);

    /// Replaces all lines by empty lines with these captions.
    void setCaptions(const QStringList& captions);
    /// Text of every filled line, by caption.
    std::map<std::string, std::string> given() const;

    /// A line and its caption.
    struct Line {
        QString caption, text;
    };
    std::vector<Line> lines() const;

    /// The first empty line, otherwise the last one; null if there are no lines.
    QWidget* firstOpen() const;
    /// Moves the focus from the current line to the next; false if there is no next line.
    bool focusNext();

Q_SIGNALS:
    void changed();

private:
    const char* m_objectName;
    QStringList m_captions;
    std::vector<QLineEdit*> m_lines;
    QGridLayout* m_grid;
};

}  // namespace study::app
