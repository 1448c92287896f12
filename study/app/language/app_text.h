// Texts of the window outside classes with tr() of their own. lupdate finds them under one context.
#pragma once

#include <QCoreApplication>
#include <QString>
#include <QStringList>

namespace study::app {

/// AppText::tr("…") in functions that belong to no QObject.
struct AppText {
    Q_DECLARE_TR_FUNCTIONS(study::app::AppText)
};

/// The language of the window as a tag for protocols: "en", "de", "zh".
inline QString languageOfWindow()
{
    //: The BCP 47 tag of your language, such as "de": new protocols take their texts for participants from it.
    return AppText::tr("en", "language of new protocols");
}

/// "." or ","; every field takes both.
inline QString decimalMark() { return AppText::tr(".", "decimal mark"); }

/// ", " between the names of a list.
inline QString listMark() { return AppText::tr(", ", "between the names of a list"); }

/// Sentences one after the other. Some languages put no space between them.
inline QString sentencesTogether(const QStringList& sentences)
{
    QString text;
    for (const QString& sentence : sentences)
        text = text.isEmpty() ? sentence : AppText::tr("%1 %2", "two sentences").arg(text, sentence);
    return text;
}

}  // namespace study::app
