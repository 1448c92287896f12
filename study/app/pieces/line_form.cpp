#include "study/app/pieces/line_form.h"

#include <QGridLayout>

#include "protocols/files/typed_number.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

LineForm::LineForm(const char* objectName, QWidget* parent)
    : QWidget(parent), m_objectName(objectName), m_grid(new QGridLayout(this))
{
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setHorizontalSpacing(18);
    m_grid->setVerticalSpacing(10);
}

void LineForm::setCaptions(const QStringList& captions)
{
    clearLayout(*m_grid);
    m_lines.clear();
    m_captions = captions;
    for (const QString& caption : captions) {
        const int row = static_cast<int>(m_lines.size());
        auto* text = quietLabel("lineCaption", this);
        text->setText(caption);
        auto* line = field(qPrintable(QLatin1String(m_objectName) + QString::number(row + 1)), caption, this);
        m_grid->addWidget(text, row, 0);
        m_grid->addWidget(line, row, 1);
        connect(line, &QLineEdit::textChanged, this, &LineForm::changed);
        m_lines.push_back(line);
    }
    m_grid->setColumnStretch(0, 1);
    m_grid->setColumnStretch(1, 2);
}

std::map<std::string, std::string> LineForm::given() const
{
    std::map<std::string, std::string> filled;
    for (std::size_t i = 0; i < m_lines.size(); ++i)
        if (const QString text = m_lines[i]->text().trimmed(); !text.isEmpty())
            filled[m_captions[static_cast<qsizetype>(i)].toStdString()] = protocols::typedNumber(text.toStdString());
    return filled;
}

std::vector<LineForm::Line> LineForm::lines() const
{
    std::vector<Line> lines;
    for (std::size_t i = 0; i < m_lines.size(); ++i)
        lines.push_back({m_captions[static_cast<qsizetype>(i)], m_lines[i]->text().trimmed()});
    return lines;
}

QWidget* LineForm::firstOpen() const
{
    for (QLineEdit* line : m_lines)
        if (line->text().isEmpty()) return line;
    return m_lines.empty() ? nullptr : m_lines.back();
}

bool LineForm::focusNext()
{
    for (std::size_t i = 0; i + 1 < m_lines.size(); ++i)
        if (m_lines[i]->hasFocus()) {
            m_lines[i + 1]->setFocus(Qt::TabFocusReason);
            return true;
        }
    return false;
}

}  // namespace study::app
