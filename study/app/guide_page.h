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

/// Whether the protocol's checklist stands on a page, and whether it must be complete to go on. The first page
/// offers it; what is still open (the mask, say) comes again, required, before the first presentation.
enum class Checklist { None, Offered, Required };

/// The words of one guide page.
struct Guide {
    QString title;
    QString lead;                               ///< one sentence under the title
    QStringList steps;
    QString action;                             ///< on the button
    std::optional<session::EventBody> event;    ///< none: the session is over, the button leaves it
    bool showsScale = false;
    Checklist checklist = Checklist::None;
};

class GuidePage : public StagePage {
    Q_OBJECT
public:
    explicit GuidePage(QWidget* parent);

    /// The protocol's points, all open.
    void setChecklist(const QStringList& items);
    void setScale(const protocols::Scale& scale);

    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

    /// Enter goes on with the page, also from a box (some desktops would let it tick the box); a click on the
    /// text beside a box ticks it.
    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    void leaveAsked();

private:
    void tell(const Guide& guide);
    void showSteps(const QStringList& steps);
    QWidget* checkRow(const QString& item);
    void showChecklist();
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
    std::vector<QCheckBox*> m_boxes;  ///< each in a row with its text

    QPushButton* m_action;
};

}  // namespace study::app
