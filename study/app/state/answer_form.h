// What the pages offer to enter an answer of one kind, as a value: for the question that is asked and for a stored answer that
// is to be corrected. The one place of the app that treats the kinds of questions differently.
#pragma once

#include <QString>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "study/session/driver.h"

namespace study::app {

/// "A", "B", ... for tray slots from 0.
inline QString slotLetter(std::size_t place) { return QString(QChar(static_cast<char16_t>(u'A' + place))); }

/// One of several answers to choose from.
struct AnswerOption {
    session::GivenAnswer response;
    QString letter;    ///< the key that chooses it, "A"
    QString name;      ///< "Piece 427", "Same"
    QString shown;     ///< the answer once it is stored: "A    Piece 427", "Same"
    QString readBack;  ///< what the operator says again: "“A.” (Piece 427)", "“same.”"
};

struct OptionsForm {
    std::vector<AnswerOption> options;
};
struct ScaleForm {
    protocols::RatingScale scale;
};
struct WordsForm {};
using AnswerForm = std::variant<OptionsForm, ScaleForm, WordsForm>;

/// The form for the question that `view` asks; options without any where it asks none.
AnswerForm formOf(const session::View& view);

/// `pieces`: the codes on the fabric pieces of `tray`, both in slot order.
AnswerForm formOf(const protocols::AnswerKind& kind, const std::vector<protocols::FabricId>& tray,
                  const std::vector<std::string>& pieces);

/// The stored answer: "B    Piece 427", "5.5", "Same", the words themselves.
QString textOf(const AnswerForm& form, const session::GivenAnswer& response);

/// The name of a fabric piece: "Piece 427".
QString nameOfPiece(const std::string& code);

/// Why two entries of one answer disagree, as a sentence for the operator; empty where they agree. Words that differ in
/// spaces only agree.
QString disagreement(const AnswerForm& form, const session::GivenAnswer& first, const session::GivenAnswer& second);

}  // namespace study::app
