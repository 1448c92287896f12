// One phase of a protocol draft in detail: kind, questions, blank presentations, instructions.
#pragma once

#include <QWidget>

class QVBoxLayout;

namespace study::app {

class DraftFields;

class PhaseDetail : public QWidget {
    Q_OBJECT
public:
    /// `phase`: from 0.
    PhaseDetail(DraftFields& fields, std::size_t phase, QWidget* parent);

private:
    void addKind(QVBoxLayout& column);
    void addScale(QVBoxLayout& column);
    void addWords(QVBoxLayout& column);
    void addQuestions(QVBoxLayout& column);
    void addQuestion(QVBoxLayout& column, std::size_t question);
    void addInstructions(QVBoxLayout& column);
    void addInstruction(QVBoxLayout& column, std::size_t instruction);
    /// "phases[0].key"
    std::string place(const std::string& key) const;

    DraftFields& m_fields;
    std::size_t m_phase;
};

}  // namespace study::app
