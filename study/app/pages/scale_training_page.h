// The participant's page of the scale, before the mask: the line to memorise with its two anchors, then marks without
// a number, one after another, to which the participant says the number. Shortened in later sittings.
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

private:
    QLayout* anchors();
    QLayout* placeRow();
    void showInstruction(bool isRefresher);
    void showAnchors();
    void confirm();
    /// How far the spoken number lay from the mark, kindly.
    QString deviation(const session::ScalePlaced& placed) const;

    protocols::Scale m_scale;
    std::optional<protocols::Tenths> m_place;     ///< to be named now
    std::optional<session::ScalePlaced> m_asked;  ///< not known to be stored yet
    std::optional<session::ScalePlaced> m_lastNamed;
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
