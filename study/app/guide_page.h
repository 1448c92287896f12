// A page that tells the operator what to do now and waits for one confirmation: introduction,
// familiarisation, scale training, break, pause, end. What it says is a value (stage_guides.h).
#pragma once

#include "study/app/stage_page.h"

#include <QCheckBox>

#include <optional>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class ScaleLine;

/// The words of one guide page.
struct Guide {
    QString title;
    QString lead;                               ///< one sentence under the title
    QStringList steps;
    QString action;                             ///< on the button
    std::optional<session::EventBody> event;    ///< none: the session is over, the button leaves it
    bool showsScale = false;
    bool showsChecklist = false;
};

class GuidePage : public StagePage {
    Q_OBJECT
public:
    explicit GuidePage(QWidget* parent);

    /// Boxes to be ticked before the guide that shows a checklist goes on.
    void setChecklist(const QStringList& items);
    void setScale(const protocols::Scale& scale);

    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

Q_SIGNALS:
    void leaveAsked();

private:
    void show(const Guide& guide);
    void showSteps(const QStringList& steps);
    void confirm();
    QCheckBox* firstUnticked() const;

    Guide m_guide;
    QLabel* m_title;
    QLabel* m_lead;
    QWidget* m_scalePart;
    ScaleLine* m_line;
    QLabel* m_lowAnchor;
    QLabel* m_highAnchor;
    QVBoxLayout* m_steps;
    QVBoxLayout* m_checks;
    std::vector<QCheckBox*> m_boxes;
    QPushButton* m_action;
};

}  // namespace study::app
