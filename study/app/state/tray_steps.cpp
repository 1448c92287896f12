#include "study/app/state/tray_steps.h"

#include <QStringList>
#include <algorithm>
#include <optional>

#include "study/app/language/app_text.h"
#include "study/app/state/answer_form.h"

namespace study::app {

namespace {

std::optional<std::size_t> placeOf(const std::string& piece, const std::vector<std::string>& tray)
{
    const auto found = std::ranges::find(tray, piece);
    return found == tray.end() ? std::nullopt : std::optional<std::size_t>(found - tray.begin());
}

QString textOfStep(const TrayStep& step, bool hasLetters)
{
    const QString piece = QString::fromStdString(step.piece);
    if (step.to.isEmpty()) return AppText::tr("take off %1").arg(piece);
    if (!hasLetters) return AppText::tr("put %1 on the tray").arg(piece);
    return step.from.isEmpty() ? AppText::tr("put %1 on %2").arg(piece, step.to)
                               : AppText::tr("move %1 from %2 to %3").arg(piece, step.from, step.to);
}

/// A line breaks only between two steps, so that a code stays beside its place. The long name of a fabric may break, too.
QString unbroken(const QString& step)
{
    constexpr qsizetype longest = 30;
    return step.size() > longest ? step : QString(step).replace(QLatin1Char(' '), QChar(QChar::Nbsp));
}

}  // namespace

std::vector<TrayStep> trayStepsTo(const std::vector<std::string>& wanted, const std::vector<std::string>& placed)
{
    std::vector<TrayStep> off, moved, on;
    for (std::size_t place = 0; place < placed.size(); ++place)
        if (!placeOf(placed[place], wanted)) off.push_back({placed[place], slotLetter(place), {}});
    for (std::size_t place = 0; place < wanted.size(); ++place) {
        const auto from = placeOf(wanted[place], placed);
        if (!from)
            on.push_back({wanted[place], {}, slotLetter(place)});
        else if (*from != place)
            moved.push_back({wanted[place], slotLetter(*from), slotLetter(place)});
    }
    std::vector<TrayStep> steps = std::move(off);
    steps.insert(steps.end(), moved.begin(), moved.end());
    steps.insert(steps.end(), on.begin(), on.end());
    return steps;
}

QString trayStepsText(const std::vector<TrayStep>& steps, std::size_t slots)
{
    // A piece that only changes its place on a tray of one slot needs no act.
    QStringList texts;
    for (const TrayStep& step : steps)
        if (slots > 1 || step.from.isEmpty() || step.to.isEmpty()) texts << unbroken(textOfStep(step, slots > 1));
    if (texts.isEmpty()) return AppText::tr("All pieces stay on the tray.");
    QString text = texts.join(QString(QChar(QChar::Nbsp)) + QStringLiteral("· "));
    text[0] = text[0].toUpper();
    return text;
}

}  // namespace study::app
