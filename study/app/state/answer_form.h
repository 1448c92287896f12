// What an answer to a question may be, as a value, and how answers are called on the pages: for the question that
// is asked and for a stored answer that is to be corrected.
#pragma once

#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "study/session/driver.h"

namespace study::app {

/// "A", "B", ... for tray slots from 0.
inline QString slotLetter(std::size_t place) { return QString(QChar(static_cast<char16_t>(u'A' + place))); }

struct AnswerForm {
    /// One of several answers to choose from.
    struct Option {
        session::Response response;
        QString letter;  ///< the key that chooses it, "A"
        QString name;    ///< "Piece 427", "Same"
        QString spoken;  ///< what the participant says and hears again: "A", "same"
    };
    protocols::PhaseAnswer kind = protocols::PhaseAnswer::Choice;
    std::vector<Option> options;            ///< of choices and of same or different
    std::optional<protocols::Scale> scale;  ///< of ratings
};

/// Of the question that `view` asks.
AnswerForm formOf(const session::View& view);

/// `pieces`: the codes on the fabric pieces of `tray`, both in slot order.
AnswerForm formOf(protocols::PhaseAnswer kind, const std::vector<protocols::FabricId>& tray,
                  const std::vector<std::string>& pieces, const std::optional<protocols::Scale>& scale);

/// "B    Piece 427", "5.5", "Same", the words themselves.
QString textOf(const AnswerForm& form, const session::Response& response);

/// What a fabric piece is called: "Piece 427".
QString nameOfPiece(const std::string& code);

/// Why two entries of one answer do not agree, as a sentence for the operator; empty where they do. Words agree when
/// they differ in nothing but spaces.
QString disagreement(const AnswerForm& form, const session::Response& first, const session::Response& second);

}  // namespace study::app
