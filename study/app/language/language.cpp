#include "study/app/language/language.h"

#include <QCoreApplication>
#include <QFile>
#include <QFileInfo>
#include <QLibraryInfo>
#include <QLocale>
#include <QStringList>
#include <QtEndian>
#include <algorithm>
#include <utility>

#include "protocols/files/errors.h"
#include "study/app/language/fonts.h"

namespace study::app {

namespace {

/// What each catalogue says of itself. The translations are the language's own name, the reviewer and the version.
constexpr const char* contextOfFacts = "study::app::Catalogue";
//: The name of your language in your language, such as "Deutsch".
constexpr const char* nameFact = QT_TRANSLATE_NOOP("study::app::Catalogue", "name of the language");
//: The native speaker who has checked the catalogue. Leave it empty until somebody has.
constexpr const char* reviewerFact = QT_TRANSLATE_NOOP("study::app::Catalogue", "reviewer");
//: The version of the program that the catalogue is made for, such as "0.6.0".
constexpr const char* versionFact = QT_TRANSLATE_NOOP("study::app::Catalogue", "version of the program");

constexpr const char* languageKey = "language";
constexpr const char* shippedTags[] = {"de", "zh_CN"};

QString factOf(const QTranslator& texts, const char* fact) { return texts.translate(contextOfFacts, fact); }

QString pathOfShipped(const QString& tag) { return QStringLiteral(":/translations/vis2hap_%1.qm").arg(tag); }

std::unique_ptr<QTranslator> shippedTexts(const QString& tag)
{
    auto texts = std::make_unique<QTranslator>();
    if (!texts->load(pathOfShipped(tag))) return nullptr;
    return texts;
}

/// "0.6" of "0.6.1": only these parts of the version change texts.
QString seriesOf(const QString& version) { return version.section(QLatin1Char('.'), 0, 1); }

QString namesOfShipped()
{
    QStringList tags;
    for (const Language& one : shippedLanguages()) tags << one.tag;
    return tags.join(QStringLiteral(", "));
}

protocols::Error faultOfCatalogue(const std::string& what, const QString& file, const QString& expected)
{
    return protocols::badInput({what, file.toStdString(), expected.toStdString(),
                                "update it as CONTRIBUTING.md says (\"A language\"), or leave --language out"});
}

/// The longest catalogue that is read, bytes; those of the program have some 300,000.
constexpr qint64 largestCatalogue = qint64{1} << 24;

quint32 numberAt(const QByteArray& bytes, qsizetype at) { return qFromBigEndian<quint32>(bytes.constData() + at); }

/// Whether the parts of a message lie in the section of messages. Qt 6.4 follows their lengths without a look.
bool isSoundMessage(const QByteArray& messages, qsizetype at)
{
    enum Tag : char {
        End = 1,
        SourceText16 = 2,
        Translation = 3,
        Context16 = 4,
        Obsolete = 5,
        SourceText = 6,
        Context = 7,
        Comment = 8
    };
    while (at < messages.size()) {
        const char tag = messages[at++];
        if (tag < SourceText16 || tag > Comment || tag == Context16) return true;  // Qt ends here
        if (messages.size() - at < 4) return false;
        const qint64 length = tag == Obsolete ? 0 : numberAt(messages, at);
        at += 4;
        if (tag == Translation && length % 2 != 0) return true;
        if (length > messages.size() - at) return false;
        at += length;
    }
    return false;
}

/// Whether a catalogue made by lrelease can be looked up without reading beside it.
bool isSoundCatalogue(const QByteArray& bytes)
{
    constexpr qsizetype magic = 16;
    constexpr uchar contextsTag = 0x2f, hashesTag = 0x42, messagesTag = 0x69, otherFilesTag = 0x96;
    QByteArray hashes, messages;
    for (qsizetype at = magic; at < bytes.size();) {
        if (bytes.size() - at < 5) return false;
        const auto tag = static_cast<uchar>(bytes[at]);
        const qint64 length = numberAt(bytes, at + 1);
        at += 5;
        if (tag == 0 || length == 0) break;  // Qt ends here
        if (tag == contextsTag || tag == otherFilesTag || length > bytes.size() - at) return false;
        if (tag == hashesTag) hashes = bytes.mid(at, length);
        if (tag == messagesTag) messages = bytes.mid(at, length);
        at += length;
    }
    constexpr qsizetype entry = 8;  // a hash and the place of its message
    if (hashes.size() % entry != 0) return false;
    for (qsizetype at = 0; at < hashes.size(); at += entry)
        if (!isSoundMessage(messages, numberAt(hashes, at + 4))) return false;
    return true;
}

/// Keeps its bytes: Qt maps a file, and a window would end with it when somebody replaced it.
class CatalogueInMemory : public QTranslator {
public:
    explicit CatalogueInMemory(const QString& path)
    {
        QFile file(path);
        if (file.open(QIODevice::ReadOnly) && file.size() <= largestCatalogue) m_bytes = file.read(file.size());
        m_isLoaded = isSoundCatalogue(m_bytes) &&
                     load(reinterpret_cast<const uchar*>(m_bytes.constData()), static_cast<int>(m_bytes.size()));
    }
    bool isLoaded() const { return m_isLoaded; }

private:
    QByteArray m_bytes;
    bool m_isLoaded = false;
};

/// The catalogue in a file, made for this version of the program.
std::unique_ptr<QTranslator> textsInFile(const QString& file, const QString& version)
{
    if (!QFileInfo(file).isFile())
        throw protocols::badInput({"there is no such catalogue", file.toStdString(),
                                   "a file made by lrelease, or one of " + namesOfShipped().toStdString(), "correct --language"});
    auto texts = std::make_unique<CatalogueInMemory>(file);
    if (!texts->isLoaded() || factOf(*texts, nameFact).isEmpty())
        throw faultOfCatalogue("this is no catalogue of this program, or it is damaged", file,
                               QStringLiteral("a file that lrelease made from study/app/translations"));
    const QString madeFor = factOf(*texts, versionFact);
    if (seriesOf(madeFor) != seriesOf(version))
        throw faultOfCatalogue("the catalogue was made for version " + (madeFor.isEmpty() ? "?" : madeFor.toStdString()), file,
                               QStringLiteral("a catalogue for version %1").arg(version));
    return texts;
}

}  // namespace

std::vector<Language> shippedLanguages()
{
    std::vector<Language> all{Language()};
    for (const char* tag : shippedTags)
        if (const auto texts = shippedTexts(QString::fromLatin1(tag)))
            all.push_back({QString::fromLatin1(tag), factOf(*texts, nameFact), factOf(*texts, reviewerFact)});
    return all;
}

std::optional<QString> shippedTagFor(const QString& wanted)
{
    const QLocale asked(QString(wanted).replace(QLatin1Char('-'), QLatin1Char('_')));
    if (asked.language() == QLocale::C) return std::nullopt;
    for (const Language& one : shippedLanguages()) {
        const QLocale shipped(one.tag);
        if (shipped.language() == asked.language() && shipped.script() == asked.script()) return one.tag;
    }
    return std::nullopt;
}

LanguageInUse::LanguageInUse(const QString& program) : m_version(program.section(QLatin1Char(' '), -1)) {}

LanguageInUse::~LanguageInUse() { remove(); }

void LanguageInUse::use(const QString& wanted)
{
    const bool isFile = wanted.endsWith(QLatin1String(".qm")) || wanted.contains(QLatin1Char('/'));
    if (isFile) {
        auto texts = textsInFile(wanted, m_version);
        if (!texts->language().isEmpty()) requireFontFor(texts->language());
        const Language own{wanted, factOf(*texts, nameFact), factOf(*texts, reviewerFact)};
        return install(own, std::move(texts));
    }
    const auto tag = shippedTagFor(wanted);
    if (!tag)
        throw protocols::badInput({"there is no catalogue for the language '" + wanted.toStdString() + "'", "--language",
                                   "one of " + namesOfShipped().toStdString() + ", or a file *.qm",
                                   "CONTRIBUTING.md says how to make one (\"A language\")"});
    const auto all = shippedLanguages();
    const Language shipped = *std::ranges::find(all, *tag, &Language::tag);
    requireFontFor(*tag);
    install(shipped, *tag == Language().tag ? nullptr : shippedTexts(*tag));
}

void LanguageInUse::install(const Language& language, std::unique_ptr<QTranslator> texts)
{
    remove();
    m_language = language;
    m_texts = std::move(texts);
    if (!m_texts) return;
    auto ofQt = std::make_unique<QTranslator>();
    const QLocale locale(m_texts->language().isEmpty() ? language.tag : m_texts->language());
    if (ofQt->load(locale, QStringLiteral("qtbase"), QStringLiteral("_"), QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
        m_qtTexts = std::move(ofQt);
    if (m_qtTexts) QCoreApplication::installTranslator(m_qtTexts.get());
    QCoreApplication::installTranslator(m_texts.get());
}

void LanguageInUse::remove()
{
    for (auto* texts : {&m_texts, &m_qtTexts})
        if (*texts) QCoreApplication::removeTranslator(texts->get());
    m_texts.reset();
    m_qtTexts.reset();
}

QString chooseLanguage(LanguageInUse& use, const QString& asked, const QSettings* settings)
{
    if (!asked.isEmpty()) {
        use.use(asked);
        return {};
    }
    try {
        const QString kept = settings ? settings->value(languageKey).toString() : QString();
        if (!kept.isEmpty()) {
            use.use(kept);
            return {};
        }
        for (const QString& wanted : QLocale::system().uiLanguages())
            if (const auto tag = shippedTagFor(wanted)) {
                use.use(*tag);
                return {};
            }
    } catch (const std::exception& fault) {
        return QString::fromUtf8(fault.what());
    }
    return {};
}

void rememberLanguage(QSettings* settings, const QString& tag)
{
    if (settings) settings->setValue(languageKey, tag);
}

}  // namespace study::app
