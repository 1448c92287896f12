// Controls for a choice among a few options by letter, digit or click: the slots of the tray, or same and different.
#pragma once

#include "study/app/pieces/entry_controls.h"

class QPushButton;
class QVBoxLayout;

namespace study::app {

class ChoiceControls : public EntryControls {
    Q_OBJECT
public:
    explicit ChoiceControls(QWidget* parent);

    void ask(const AnswerForm& form) override;
    std::variant<session::GivenAnswer, NoAnswer> give() override;
    ReadBack readBack() const override;
    bool isEmpty() const override { return !m_chosen.has_value(); }
    bool pressKey(int key) override;
    QWidget& firstFocus() override { return *this; }

private:
    QPushButton* buttonAt(std::size_t place);
    void choose(std::size_t place);

    std::vector<AnswerOption> m_options;
    QVBoxLayout* m_column;
    std::vector<QPushButton*> m_buttons;  ///< at least one for each option; unused buttons are hidden
    std::optional<std::size_t> m_chosen;
};

}  // namespace study::app
