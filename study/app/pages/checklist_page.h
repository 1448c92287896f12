// The protocol's checklist before the first presentation of a sitting. Every line must be ticked. The page also takes the
// readings of instruments that the protocol asks for. Its event carries the time.
#pragma once

#include <QCheckBox>

#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class LineForm;
class PatternButtons;

class ChecklistPage : public StagePage {
    Q_OBJECT
public:
    explicit ChecklistPage(QWidget* parent);

    /// Clears all ticks and readings.
    void begin(const SessionFacts& facts) override;
    void present(const session::View&) override {}
    /// Shows which test pattern can be felt; none if it is off.
    void setPattern(const std::optional<TestPattern>& pattern);
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    QWidget* pinned() override;

    /// Enter always confirms the page, because some desktops would let it tick the focused box. A click on the text beside
    /// a box ticks the box.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QWidget* rowFor(const QString& line);
    void confirm();
    /// A question about the first reading that may be a slip; empty if there is none.
    QString doubtAboutReadings() const;
    QCheckBox* firstUnticked() const;

    QVBoxLayout* m_rows;
    std::vector<QCheckBox*> m_boxes;  ///< one for each line of the checklist
    LineForm* m_readings;
    bool m_isAskedAgain = false;  ///< whether the readings are meant as they are
    QLabel* m_patternsCaption;
    PatternButtons* m_patterns;
    QPushButton* m_action;
};

}  // namespace study::app
