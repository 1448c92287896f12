// Form of an answer as a value: the input that the pages offer for one kind of question. Used for the current question and for
// the correction of a stored answer. Only this place of the app treats the kinds of questions differently.
#pragma once

#include <QString>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "study/session/driver.h"

namespace study::app {

/// Letter of a tray slot: "A" for slot 0, "B" for slot 1, …
inline QString slotLetter(std::size_t place) { return QString(QChar(static_cast<char16_t>(u'A' + place))); }

/// One of several answers to choose from.
struct AnswerOption {
    session::GivenAnswer response;
    QString letter;    ///< key that chooses it, such as "A"
    QString name;      ///< "Piece 427", "Same"
    QString shown;     ///< text of the stored answer: "A    Piece 427", "Same"
    QString readBack;  ///< words that the operator repeats: "“A.” (Piece 427)", "“same.”"
};

/// A choice: the slots of the tray, or same and different.
struct OptionsForm {
    std::vector<AnswerOption> options;
};
/// A rating on a scale.
struct ScaleForm {
    protocols::RatingScale scale;
};
/// An answer in words.
struct WordsForm {};
using AnswerForm = std::variant<OptionsForm, ScaleForm, WordsForm>;

/// The form for the question of `view`; a choice without options if there is no question.
AnswerForm formOf(const session::View& view);

/// The form for a kind of question. `pieces`: codes of the pieces of fabric on `tray`, both in slot order.
AnswerForm formOf(const protocols::AnswerKind& kind, const std::vector<protocols::FabricId>& tray,
                  const std::vector<std::string>& pieces);

/// Puts the participant's words for same and different into what the operator reads back.
void readBackInWords(AnswerForm& form, const QString& same, const QString& different);

/// Text of a stored answer: "B    Piece 427", "5.5", "Same", or the words.
QString textOf(const AnswerForm& form, const session::GivenAnswer& response);

/// Name of a piece of fabric, such as "Piece 427".
QString nameOfPiece(const std::string& code);

/// Sentence for the operator if two entries of one answer disagree; empty if they agree. Texts that differ only in spaces agree.
QString disagreement(const AnswerForm& form, const session::GivenAnswer& first, const session::GivenAnswer& second);

}  // namespace study::app
