// Scale training, shown to the participant before the mask is on. The page shows the line to memorise with its two anchors,
// then marks without numbers, one after another, until three numbers are right in a row. Later sittings use a shorter form.
#pragma once

#include <optional>

#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;

namespace study::app {

class PageHead;
class RatingField;
class ScaleLine;

class ScaleTrainingPage : public StagePage {
    Q_OBJECT
public:
    explicit ScaleTrainingPage(QWidget* parent);

    void begin(const SessionFacts& facts) override;
    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    int largestType() const override { return 170; }

private:
    QLayout* anchors();
    QLayout* placeRow();
    void showInstruction(bool isRefresher);
    void showAnchors();
    void confirm();
    /// Sentence on the distance between the spoken number and the mark, in friendly words.
    QString deviation(const session::NamedPlace& placed) const;

    SessionFacts m_facts;
    protocols::RatingScale m_scale;
    std::optional<protocols::Tenths> m_place;  ///< the mark shown now
    int m_placed = 0;                          ///< number of marks before it
    bool m_isRefresher = false;
    PageHead* m_head;
    ScaleLine* m_line;
    QWidget* m_anchors;
    QLabel* m_lowAnchor;
    QLabel* m_highAnchor;
    QWidget* m_placeRow;
    RatingField* m_spoken;
    QLabel* m_whichPlace;
    QLabel* m_deviation;
    QPushButton* m_action;
    QPushButton* m_done;
};

}  // namespace study::app
