// Lines to fill in, each under its caption and each optional: facts about a participant, readings of instruments.
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
    /// `objectName`: of the lines, followed by their number from 1.
    LineForm(const char* objectName, QWidget* parent);

    /// Empty lines with these captions, in place of all there were.
    void setCaptions(const QStringList& captions);
    /// What was filled in, by caption.
    std::map<std::string, std::string> given() const;

    /// The first line that is empty, else the last; none where there are no lines.
    QWidget* firstOpen() const;
    /// From the line that has the focus to the next; false where there is none.
    bool goOn();

private:
    const char* m_objectName;
    QStringList m_captions;
    std::vector<QLineEdit*> m_lines;
    QGridLayout* m_grid;
};

}  // namespace study::app
