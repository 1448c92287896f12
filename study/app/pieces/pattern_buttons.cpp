#include "study/app/pieces/pattern_buttons.h"

#include <QVBoxLayout>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

PatternButtons::PatternButtons(QWidget* parent) : QWidget(parent)
{
    auto* row = new FlowLayout(10, 8, this);
    row->setContentsMargins(0, 0, 0, 0);
    for (const TestPattern& pattern : rendering::testPatterns()) {
        QString text = patternName(pattern);
        text[0] = text[0].toUpper();
        auto* made = button(qPrintable(QStringLiteral("pattern%1Button").arg(m_buttons.size() + 1)), text, this);
        made->setCheckable(true);
        made->setFocusPolicy(Qt::TabFocus);  // a click must not move the focus away from the work of the page
        connect(made, &QPushButton::clicked, this,
                [this, pattern](bool isDown) { Q_EMIT patternRequested(isDown ? std::optional(pattern) : std::nullopt); });
        row->addWidget(made);
        m_buttons.push_back(made);
    }
}

void PatternButtons::setUsable(bool isConnected, std::optional<double> mmPerPixel)
{
    for (std::size_t k = 0; k < m_buttons.size(); ++k)
        m_buttons[k]->setEnabled(isConnected && (mmPerPixel || !rendering::needsScale(rendering::testPatterns()[k])));
}

void PatternButtons::setShown(const std::optional<TestPattern>& pattern)
{
    for (std::size_t k = 0; k < m_buttons.size(); ++k) m_buttons[k]->setChecked(pattern == rendering::testPatterns()[k]);
}

}  // namespace study::app
