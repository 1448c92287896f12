#include "study/app/language/below.h"

#include <QCoreApplication>
#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

#include "study/app/language/app_text.h"
#include "study/app/language/below_table.h"

namespace study::app {

namespace {

// A driver or a server may send texts without an end, and each sentence is tried at each place.
constexpr qsizetype shortestSentence = 30, longestSentence = 600, longestText = 30'000;
constexpr int mostColons = 12;
constexpr const char* mostSteps = "(*LIMIT_MATCH=20000)";  // of one sentence at one place, as PCRE counts them

/// A sentence of the table as a pattern that finds what the room filled in. A value ends before the next part of a message.
struct Sentence {
    const char* english;
    QRegularExpression pattern;
    QList<int> places;  ///< the numbers of %1, %2, … in their order in the sentence
    qsizetype known;    ///< characters that must be the same
};

Sentence sentenceFrom(const char* english)
{
    static const QRegularExpression place(QStringLiteral("%([1-9])"));
    const QString text = QString::fromUtf8(english);
    Sentence sentence{english, {}, {}, 0};
    QString pattern;
    qsizetype from = 0;
    for (auto found = place.globalMatch(text); found.hasNext();) {
        const auto one = found.next();
        const QString plain = text.mid(from, one.capturedStart() - from);
        pattern += QRegularExpression::escape(plain) + QStringLiteral("((?:(?!; ).)+?)");
        sentence.known += plain.size();
        sentence.places << one.captured(1).toInt();
        from = one.capturedEnd();
    }
    sentence.known += text.size() - from;
    sentence.pattern = QRegularExpression(
        QLatin1String(mostSteps) + QRegularExpression::anchoredPattern(pattern + QRegularExpression::escape(text.mid(from))),
        QRegularExpression::DotMatchesEverythingOption);
    return sentence;
}

/// The sentences with the most known characters first, so that the most exact one is taken.
const std::vector<Sentence>& sentences()
{
    static const std::vector<Sentence> all = [] {
        std::vector<Sentence> made;
        for (const char* english : tableOfBelow()) made.push_back(sentenceFrom(english));
        std::ranges::stable_sort(made, std::ranges::greater(), &Sentence::known);
        return made;
    }();
    return all;
}

QString translated(const char* english) { return QCoreApplication::translate(contextOfBelow, english); }

bool isTranslating() { return translated("words") != QLatin1String("words"); }

QString wholeOf(const QString& english);

/// A name is kept as it is; a sentence inside another one is translated.
QString filledIn(const QString& english)
{
    static const QRegularExpression decimal(QStringLiteral("^-?\\d+\\.\\d+$"));
    if (decimal.match(english).hasMatch()) return QString(english).replace(QLatin1Char('.'), decimalMark());
    const QString own = wholeOf(english);
    return own.isEmpty() ? english : own;
}

/// Empty where the table has no such sentence.
QString wholeOf(const QString& english)
{
    for (const Sentence& sentence : sentences()) {
        const auto found = sentence.pattern.match(english);
        if (!found.hasMatch()) continue;
        const QString own = translated(sentence.english);
        // All at once: a value may itself hold "%2".
        QString filled;
        for (qsizetype at = 0; at < own.size(); ++at) {
            const int number = own[at] == QLatin1Char('%') && at + 1 < own.size() ? own[at + 1].digitValue() : -1;
            const qsizetype place = number < 1 ? -1 : sentence.places.indexOf(number);
            if (place < 0)
                filled += own[at];
            else {
                filled += filledIn(found.captured(static_cast<int>(place) + 1));
                ++at;
            }
        }
        return filled;
    }
    return {};
}

/// "WHERE: WHAT" with WHAT translated; WHERE may hold colons.
QString afterPlace(const QString& english)
{
    int tried = 0;
    for (qsizetype colon = english.indexOf(QLatin1String(": ")); colon >= 0 && tried < mostColons;
         colon = english.indexOf(QLatin1String(": "), colon + 1), ++tried) {
        const QString own = wholeOf(english.mid(colon + 2));
        if (!own.isEmpty()) return english.left(colon + 2) + own;
    }
    return english;
}

}  // namespace

QString inOwnLanguage(const QString& english)
{
    if (english.isEmpty() || !isTranslating()) return english;
    if (english.size() <= longestSentence)
        if (const QString own = wholeOf(english); !own.isEmpty()) return own;
    QStringList parts = english.split(QStringLiteral("; "));
    qsizetype tried = 0;
    for (QString& part : parts) {
        if (part.size() > longestSentence || (tried += shortestSentence + part.size()) > longestText) continue;
        const QString own = wholeOf(part);
        part = own.isEmpty() ? afterPlace(part) : own;
    }
    return parts.join(AppText::tr("; ", "between the parts of a message"));
}

QString inOwnLanguage(const char* english) { return inOwnLanguage(QString::fromUtf8(english)); }

QString inOwnLanguage(const std::string& english) { return inOwnLanguage(QString::fromStdString(english)); }

std::vector<QString> sentencesFromBelow()
{
    std::vector<QString> all;
    for (const char* english : tableOfBelow()) all.push_back(QString::fromUtf8(english));
    return all;
}

}  // namespace study::app
