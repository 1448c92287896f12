// List of numbered steps for the operator. A single step has no number.
#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

#include "study/app/state/appearance.h"

class QLabel;

namespace study::app {

class StepList : public QWidget {
    Q_OBJECT
public:
    explicit StepList(QWidget* parent, Type type = Type::Body);

    void setSteps(const QStringList& steps);

private:
    Type m_type;
    std::vector<QLabel*> m_steps;  ///< unused labels are hidden
};

}  // namespace study::app
