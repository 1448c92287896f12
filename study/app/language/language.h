// The language of the operator's window: the catalogues that are built into the program, and one of a laboratory's own in a file.
// Keys, file formats and reports are the same in every language. What participants read and hear follows the protocol
// (protocols/usual_texts.h), not this choice.
#pragma once

#include <QSettings>
#include <QString>
#include <QTranslator>
#include <memory>
#include <optional>
#include <vector>

namespace study::app {

/// A language that the window has texts in; English, the original, by default.
struct Language {
    QString tag = QStringLiteral("en");        ///< "de", "zh_CN"; of a file: its path
    QString name = QStringLiteral("English");  ///< in the language itself: "Deutsch"
    QString reviewer = {};                     ///< a native speaker who checked the texts; empty: nobody did
};

/// English first, then the catalogues of the program.
std::vector<Language> shippedLanguages();

/// The shipped language for a BCP 47 tag or a name of a locale ("de", "de-CH", "de_DE.UTF-8", "zh-Hans"); empty: none. The main
/// part decides, and for Chinese the script.
std::optional<QString> shippedTagFor(const QString& wanted);

/// Texts of this language are in use while the value lives; afterwards, and at first, it is English.
class LanguageInUse {
public:
    /// `program`: "vis2hap 0.6.0"; a catalogue in a file must be made for this version.
    explicit LanguageInUse(const QString& program);
    ~LanguageInUse();
    LanguageInUse(const LanguageInUse&) = delete;
    LanguageInUse& operator=(const LanguageInUse&) = delete;

    /// Takes a shipped language by its tag, or a catalogue by its file (*.qm). Throws badInput for an unknown tag, and for a file
    /// that is none, is damaged or was made for another version; the language before then stays.
    void use(const QString& wanted);

    const Language& language() const { return m_language; }

private:
    void install(const Language& language, std::unique_ptr<QTranslator> texts);
    void remove();

    QString m_version;
    Language m_language;
    std::unique_ptr<QTranslator> m_texts;    ///< null: English
    std::unique_ptr<QTranslator> m_qtTexts;  ///< of Qt's own dialogs, where Debian's package is installed
};

/// The language of a run: `asked` on the command line, else the one that the settings keep, else the first of the system's that
/// is shipped. Throws badInput where `asked` cannot be used. A kept one that cannot be used leaves English, and the reason is
/// returned.
QString chooseLanguage(LanguageInUse& use, const QString& asked, const QSettings* settings);

/// Keeps the choice for later runs.
void rememberLanguage(QSettings* settings, const QString& tag);

}  // namespace study::app
