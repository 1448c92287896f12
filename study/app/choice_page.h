// A choice among the fabrics on the tray: letters or buttons choose, the choice is read back, Enter stores.
#pragma once

#include "study/app/stage_page.h"

#include <optional>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class QuestionHead;
class TouchButton;

class ChoicePage : public StagePage {
    Q_OBJECT
public:
    explicit ChoicePage(QWidget* parent);

    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override { return *this; }

private:
    void showAnswers(const session::View& view);
    void choose(std::size_t place);
    void store();

    QuestionHead* m_head;
    QVBoxLayout* m_answersColumn;
    QLabel* m_readBack;
    TouchButton* m_touch;
    QPushButton* m_store;

    std::optional<session::Presenting> m_shown;
    protocols::PresentationCode m_shownCode;
    std::vector<protocols::FabricId> m_fabrics;
    std::vector<QString> m_fabricNames;
    std::vector<QPushButton*> m_answers;
    std::optional<std::size_t> m_chosen;
};

}  // namespace study::app
