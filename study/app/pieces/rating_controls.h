// Controls for a rating: type the spoken number or click on the line. The words of a Likert scale are below the line.
#pragma once

#include <QBoxLayout>

#include "study/app/pieces/entry_controls.h"

class QLabel;

namespace study::app {

class RatingField;
class ScaleLine;

class RatingControls : public EntryControls {
    Q_OBJECT
public:
    explicit RatingControls(QWidget* parent);

    void ask(const AnswerForm& form) override;
    std::variant<session::GivenAnswer, NoAnswer> give() override;
    ReadBack readBack() const override;
    bool isEmpty() const override;
    bool pressKey(int) override { return false; }
    QWidget& firstFocus() override;

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void arrangeLabels();
    void setScale(const protocols::RatingScale& scale);
    void showLabels();
    void showTyped();

    std::optional<protocols::RatingScale> m_scale;
    RatingField* m_rating;
    QLabel* m_range;
    ScaleLine* m_line;
    QWidget* m_words;      ///< holds the layout of the labels, from left to right like the line
    QBoxLayout* m_labels;  ///< one word under each tick, or below one another where they are too wide
};

}  // namespace study::app
