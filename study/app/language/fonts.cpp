#include "study/app/language/fonts.h"

#include <QFontDatabase>
#include <QFontInfo>
#include <QGuiApplication>
#include <QLocale>
#include <algorithm>
#include <iterator>

#include "protocols/files/errors.h"

namespace study::app {

namespace {

/// A script, the name that Qt's font database has for it, and a small font of Debian.
struct ScriptFont {
    QLocale::Script script;
    QFontDatabase::WritingSystem writing;
    const char* package;
};

constexpr ScriptFont scriptFonts[] = {
    {QLocale::LatinScript, QFontDatabase::Latin, "fonts-dejavu-core"},
    {QLocale::GreekScript, QFontDatabase::Greek, "fonts-dejavu-core"},
    {QLocale::CyrillicScript, QFontDatabase::Cyrillic, "fonts-dejavu-core"},
    {QLocale::ArabicScript, QFontDatabase::Arabic, "fonts-dejavu-core"},
    {QLocale::SimplifiedHanScript, QFontDatabase::SimplifiedChinese, "fonts-wqy-microhei"},
    {QLocale::TraditionalHanScript, QFontDatabase::TraditionalChinese, "fonts-wqy-microhei"},
    {QLocale::JapaneseScript, QFontDatabase::Japanese, "fonts-ipafont-gothic"},
    {QLocale::KoreanScript, QFontDatabase::Korean, "fonts-nanum"},
    {QLocale::HebrewScript, QFontDatabase::Hebrew, "fonts-noto-core"},
    {QLocale::DevanagariScript, QFontDatabase::Devanagari, "fonts-noto-core"},
    {QLocale::BanglaScript, QFontDatabase::Bengali, "fonts-noto-core"},
    {QLocale::TamilScript, QFontDatabase::Tamil, "fonts-noto-core"},
    {QLocale::ThaiScript, QFontDatabase::Thai, "fonts-noto-core"},
    {QLocale::GeorgianScript, QFontDatabase::Georgian, "fonts-dejavu-core"},
    {QLocale::ArmenianScript, QFontDatabase::Armenian, "fonts-dejavu-core"},
};

}  // namespace

QString missingFontPackage(const QString& language)
{
    if (qobject_cast<QGuiApplication*>(QCoreApplication::instance()) == nullptr) return {};  // nothing is drawn
    const QLocale locale(QString(language).replace(QLatin1Char('-'), QLatin1Char('_')));
    // Without any font the database still lists aliases such as "Sans Serif", which lead to no family.
    if (QFontInfo(QGuiApplication::font()).family().isEmpty()) return QStringLiteral("fonts-dejavu-core");
    const auto* row = std::ranges::find(scriptFonts, locale.script(), &ScriptFont::script);
    if (locale.language() == QLocale::C || row == std::end(scriptFonts)) return {};
    return QFontDatabase::families(row->writing).isEmpty() ? QString::fromLatin1(row->package) : QString();
}

void requireFontFor(const QString& language)
{
    const QString package = missingFontPackage(language);
    if (package.isEmpty()) return;
    const std::string name = package.toStdString();
    throw protocols::environmentFault({"this computer has no font for the language '" + language.toStdString() + "'", "",
                                       "Debian's package " + name, "run: apt-get install " + name});
}

QString nameInList(const QString& language)
{
    const QLocale locale(language);
    const QString own = locale.language() == QLocale::English ? QStringLiteral("English") : locale.nativeLanguageName();
    if (own.isEmpty() || !missingFontPackage(language).isEmpty()) return QLocale::languageToString(locale.language());
    return own.left(1).toUpper() + own.mid(1);
}

}  // namespace study::app
