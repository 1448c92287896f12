// List of numbered steps for the operator. A single step has no number.
#pragma once

#include <QStringList>
#include <QWidget>
#include <vector>

class QLabel;

namespace study::app {

class StepList : public QWidget {
    Q_OBJECT
public:
    explicit StepList(QWidget* parent);

    void setSteps(const QStringList& steps);

private:
    std::vector<QLabel*> m_steps;  ///< unused labels are hidden
};

}  // namespace study::app
