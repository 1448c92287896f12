// A rating as it is spoken and typed: a number with at most one decimal, with point or comma, whatever the
// computer's locale is.
#pragma once

#include <QString>
#include <variant>

#include "protocols/protocol.h"

namespace study::app {

/// Why typed text is no rating, as a sentence for the operator.
struct NoRating {
    QString why;
};

/// "5", "5.4", "5,4" -> tenths on the scale; else the reason.
std::variant<protocols::Tenths, NoRating> ratingFromText(const QString& typed, const protocols::RatingScale& scale);

/// "5.4", "10", always with a point; whole numbers without a decimal.
QString textOf(protocols::Tenths rating);

/// "5, agree" where the scale has words for its steps, else as textOf.
QString wordedText(protocols::Tenths rating, const protocols::RatingScale& scale);

/// "from 0 to 10, one decimal"
QString rangeText(const protocols::RatingScale& scale);

/// The rating of the scale's step that lies nearest to `fraction` (0..1) of the line.
protocols::Tenths ratingAt(double fraction, const protocols::RatingScale& scale);

}  // namespace study::app
