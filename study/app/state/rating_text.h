// Ratings as spoken and typed: a number with at most one decimal, with point or comma. Independent of the computer's locale.
#pragma once

#include <QString>
#include <variant>

#include "protocols/protocol.h"

namespace study::app {

/// Sentence for the operator: the reason why the typed text is not a rating.
struct NoRating {
    QString why;
};

/// Rating of a typed text such as "5", "5.4" or "5,4", in tenths; or the reason why it is none on this scale.
std::variant<protocols::Tenths, NoRating> ratingFromText(const QString& typed, const protocols::RatingScale& scale);

/// Text of a rating, such as "5.4" or "10": with the decimal mark of the window, whole numbers without a decimal.
QString textOf(protocols::Tenths rating);

/// Text of a rating with its word, such as "5, agree", if the scale has words for its steps; otherwise textOf(rating).
QString wordedText(protocols::Tenths rating, const protocols::RatingScale& scale);

/// Description of the allowed numbers, such as "from 0 to 10, one decimal".
QString rangeText(const protocols::RatingScale& scale);

/// The rating nearest to `fraction` (0..1) of the scale line.
protocols::Tenths ratingAt(double fraction, const protocols::RatingScale& scale);

}  // namespace study::app
