#include "study/app/state/rating_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "protocols/files/typed_number.h"
#include "study/app/language/app_text.h"

namespace study::app {

using protocols::RatingScale;
using protocols::Tenths;

namespace {

/// Value of a text of digits; empty for other texts and for numbers too long for a rating.
std::optional<int> digits(const std::string& text)
{
    int value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool isWhole = fault == std::errc() && end == text.data() + text.size() && !text.empty() && text.front() != '-';
    return isWhole && text.size() <= 6 ? std::optional(value) : std::nullopt;
}

/// Tenths of a plain decimal number; empty if the text is not such a number or has more than one decimal.
std::optional<int> tenths(std::string text)
{
    const bool isNegative = text.starts_with('-');
    if (isNegative) text.erase(0, 1);
    const auto point = text.find('.');
    const auto whole = digits(text.substr(0, point));
    const auto decimal = point == std::string::npos ? std::optional(0) : digits(text.substr(point + 1));
    if (!whole || !decimal || (point != std::string::npos && text.size() - point != 2)) return std::nullopt;
    const int value = *whole * 10 + *decimal;
    return isNegative ? -value : value;
}

}  // namespace

std::variant<Tenths, NoRating> ratingFromText(const QString& typed, const RatingScale& scale)
{
    const std::string plain = protocols::typedNumber(typed.toStdString());
    if (plain.empty()) return NoRating{AppText::tr("Type the number that the participant says.")};
    const auto value = tenths(plain);
    if (!value)
        return NoRating{
            AppText::tr("“%1” is not a rating. Type a number with at most one decimal, such as 5.4.").arg(typed.trimmed())};
    const Tenths rating{*value};
    if (rating < scale.min || rating > scale.max)
        return NoRating{AppText::tr("%1 is outside the scale. Ratings go from %2 to %3. Ask the participant again.")
                            .arg(textOf(rating), textOf(scale.min), textOf(scale.max))};
    if (!scale.holds(rating))
        return NoRating{AppText::tr("%1 is between two steps of the scale. Ratings go in steps of %2. Ask the participant again.")
                            .arg(textOf(rating), textOf(scale.step))};
    return rating;
}

QString textOf(Tenths rating)
{
    const int size = std::abs(rating.value);
    QString text = QString::number(size / 10);
    if (size % 10 != 0) text += decimalMark() + QString::number(size % 10);
    return rating.value < 0 ? QLatin1Char('-') + text : text;
}

QString wordedText(Tenths rating, const RatingScale& scale)
{
    const int step = (rating.value - scale.min.value) / scale.step.value;
    const bool hasWords = scale.holds(rating) && step < static_cast<int>(scale.labels.size());
    if (!hasWords) return textOf(rating);
    return QStringLiteral("%1, %2").arg(textOf(rating), QString::fromStdString(scale.labels[static_cast<std::size_t>(step)]));
}

QString rangeText(const RatingScale& scale)
{
    const QString from = textOf(scale.min), to = textOf(scale.max);
    const int wholePoint = 10;
    if (scale.step.value == 1) return AppText::tr("from %1 to %2, one decimal").arg(from, to);
    if (scale.step.value == wholePoint && scale.min.value % wholePoint == 0)
        return AppText::tr("from %1 to %2, whole numbers").arg(from, to);
    return AppText::tr("from %1 to %2 in steps of %3").arg(from, to, textOf(scale.step));
}

Tenths ratingAt(double fraction, const RatingScale& scale)
{
    const double span = scale.max.value - scale.min.value;
    const double steps = std::round(std::clamp(fraction, 0.0, 1.0) * span / scale.step.value);
    return Tenths{std::min(scale.max.value, scale.min.value + static_cast<int>(steps) * scale.step.value)};
}

}  // namespace study::app
