#include "study/app/pieces/step_list.h"

#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"

namespace study::app {

StepList::StepList(QWidget* parent, Type type) : QWidget(parent), m_type(type)
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
}

void StepList::setSteps(const QStringList& steps)
{
    while (static_cast<qsizetype>(m_steps.size()) < steps.size()) {
        m_steps.push_back(label(qPrintable(QStringLiteral("step%1").arg(m_steps.size() + 1)), m_type, this));
        layout()->addWidget(m_steps.back());
    }
    for (qsizetype i = 0; i < static_cast<qsizetype>(m_steps.size()); ++i) {
        const QString step = steps.value(i);
        const QString numbered = steps.size() == 1 ? step : QStringLiteral("%1.  %2").arg(i + 1).arg(step);
        showText(*m_steps[static_cast<std::size_t>(i)], step.isEmpty() ? QString() : numbered);
    }
    setVisible(!steps.isEmpty());
}

}  // namespace study::app
