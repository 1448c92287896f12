// A rating on the scale: the spoken number is typed, or the line is clicked; it is read back, Enter stores.
#pragma once

#include "study/app/stage_page.h"

#include <optional>

class QLabel;
class QPushButton;

namespace study::app {

class QuestionHead;
class RatingField;
class ScaleLine;
class TouchButton;

class RatingPage : public StagePage {
    Q_OBJECT
public:
    explicit RatingPage(QWidget* parent);

    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

private:
    void showTyped();
    void store();

    QuestionHead* m_head;
    RatingField* m_rating;
    QLabel* m_range;
    ScaleLine* m_line;
    QLabel* m_readBack;
    TouchButton* m_touch;
    QPushButton* m_store;

    std::optional<session::Presenting> m_shown;
    protocols::PresentationCode m_shownCode;
    protocols::Scale m_scale;
};

}  // namespace study::app
