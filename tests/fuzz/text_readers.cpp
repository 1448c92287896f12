#include "tests/fuzz/text_readers.h"

#include <QCoreApplication>
#include <QString>
#include <QXmlStreamReader>
#include <algorithm>
#include <cstdint>
#include <utility>

#include "protocols/files/markup_text.h"
#include "protocols/files/utf8.h"
#include "reports/documents/html_entities.h"
#include "reports/documents/report_tex.h"
#include "reports/text/tex_text.h"
#include "study/app/language/below.h"
#include "study/app/language/language.h"
#include "tests/fuzz/inputs.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using study::app::LanguageInUse;

/// Whether groups and formulas of LaTeX are closed in the text itself, so that it cannot change what stands behind it.
bool isClosedTex(const std::string& tex)
{
    int depth = 0;
    bool isFormula = false;
    for (std::size_t at = 0; at < tex.size(); ++at) {
        if (tex[at] == '\\') {
            ++at;
            continue;
        }
        if (tex[at] == '$') isFormula = !isFormula;
        if (tex[at] == '{') ++depth;
        if (tex[at] == '}' && --depth < 0) return false;
        if (tex[at] == '%' || tex[at] == '#' || tex[at] == '&') return false;
    }
    return depth == 0 && !isFormula;
}

void writeMarkup(const std::string& bytes)
{
    const std::string escaped = protocols::escapedMarkup(bytes);
    require(escaped.find_first_of("<>\"'") == std::string::npos, "markup was not escaped");
    QXmlStreamReader xml(reports::asXml("<i title=\"" + escaped + "\">" + escaped + "</i>"));
    QString text;
    while (!xml.atEnd())
        if (xml.readNext() == QXmlStreamReader::Characters) text += xml.text();
    require(!xml.hasError(), "escaped text is no XML");
    QString wanted = QString::fromStdString("x" + bytes);  // Qt would drop a byte order mark at the beginning
    wanted.remove(0, 1).removeIf([](QChar c) {
        return (c < ' ' && c != '\n' && c != '\r' && c != '\t') || c.unicode() >= 0xFFFE ||
               (c.unicode() >= 0x202A && c.unicode() <= 0x202E) || (c.unicode() >= 0x2066 && c.unicode() <= 0x2069);
    });
    wanted.replace("\r\n", "\n").replace('\r', '\n');
    const bool isUtf8 = !protocols::firstByteThatIsNotUtf8(bytes);
    require(text == wanted || !isUtf8, "escaped text is not read as it was");
    require(text.contains(QChar(0x202E)) == false, "escaped text turns what is behind it");

    require(isClosedTex(reports::escapedTex(bytes)), "text opens a group of LaTeX");
    require(isClosedTex(reports::breakableTex(bytes)), "breakable text opens a group of LaTeX");
    const std::string tex = reports::texOfHtml("<p>" + escaped + " <code>" + escaped + "</code><b>end</b></p>");
    require(isClosedTex(tex) && tex.find("\\textbf{end}") != std::string::npos, "text changes the LaTeX behind it");
    require(reports::texWidth(bytes) >= 0, "text has no width");
}

/// Sentences stay as they are where the window's language does not know them, and none takes long.
void translateText(const std::string& bytes)
{
    static LanguageInUse language(QStringLiteral("vis2hap " VIS2HAP_VERSION));
    if (language.language().tag != QLatin1String("de")) language.use(QStringLiteral("de"));
    const QString text = QString::fromStdString(bytes);
    const QString own = study::app::inOwnLanguage(text);
    require(own.isEmpty() == text.isEmpty(), "a text is lost in another language");
}

std::string big(std::uint32_t number)
{
    return {static_cast<char>(number >> 24), static_cast<char>(number >> 16), static_cast<char>(number >> 8),
            static_cast<char>(number)};
}

std::string section(unsigned char tag, const std::string& content)
{
    return static_cast<char>(tag) + big(static_cast<std::uint32_t>(content.size())) + content;
}

/// Under which Qt keeps a text: the hash of ELF files.
std::uint32_t hashOf(const std::string& text)
{
    std::uint32_t hash = 0;
    for (const char c : text) {
        hash = (hash << 4) + static_cast<unsigned char>(c);
        const std::uint32_t top = hash & 0xf0000000;
        hash = (hash ^ (top >> 24)) & ~top;
    }
    return hash == 0 ? 1 : hash;
}

/// A catalogue as lrelease writes it, with a language's own name and the version, or with neither.
std::string catalogue(const std::string& locale, bool hasFacts)
{
    constexpr unsigned char context = 7, source = 6, comment = 8, translation = 3, end = 1;
    const auto wide = [](const std::string& text) {
        std::string bytes;
        for (const char c : text) bytes += {'\0', c};
        return bytes;
    };
    std::vector<std::pair<std::uint32_t, std::string>> messages;
    const auto add = [&](const std::string& text, const std::string& own) {
        messages.push_back({hashOf(text), section(translation, wide(own)) + section(comment, "") + section(source, text) +
                                              section(context, "study::app::Catalogue") + static_cast<char>(end)});
    };
    if (hasFacts) add("name of the language", "Own");
    if (hasFacts) add("version of the program", VIS2HAP_VERSION);
    add("reviewer", "somebody");
    std::ranges::sort(messages);
    std::string hashes, all;
    for (const auto& [hash, message] : messages) {
        hashes += big(hash) + big(static_cast<std::uint32_t>(all.size()));
        all += message;
    }
    return std::string("\x3c\xb8\x64\x18\xca\xef\x9c\x95\xcd\x21\x1c\xbf\x60\xa1\xbd\xdd", 16) + section(0xa7, locale) +
           section(0x42, hashes) + section(0x69, all) + section(0x88, std::string("\x01\x01", 2));
}

void useCatalogue(const fs::path& file, const std::string& bytes)
{
    put(file, bytes);
    LanguageInUse language(QStringLiteral("vis2hap " VIS2HAP_VERSION));
    language.use(QString::fromStdString(file.string()));
    require(!language.language().name.isEmpty(), "a catalogue without the name of its language was taken");
    for (const char* text : {"name of the language", "reviewer", "version of the program", "another"})
        for (const int count : {-1, 0, 1, 2, 1000000}) QCoreApplication::translate("study::app::Catalogue", text, "", count);
}

}  // namespace

std::vector<Reader> writtenTextReaders(const fs::path& folder)
{
    const fs::path file = folder / "own.qm";
    return {{"markup",
             {"Which piece feels like <this> & \"that\"?\n\tIt's 5 % of $1_000 {a} ~ [b] \\c^2 #3",
              "Gr\xC3\xB6\xC3\x9F"
              "e \xE2\x80\xAE abc \xE2\x89\xA4 3 \xC2\xB5m \xE4\xB8\xAD &nbsp; <br> &amp;",
              "\x01\x1f\xff\xfe\xed\xa0\x80 ]]>", "\xEF\xBB\xBFmarked \r\x01\n \r\xE2\x80\xAE\n \r\r\n"},
             writeMarkup},
            {"catalogue",
             {catalogue("de", true), catalogue("", true), catalogue("zh_CN", false)},
             [file](const std::string& bytes) { useCatalogue(file, bytes); }},
            {"own-language",
             {"The piece in slot 2 is not confirmed. It must be A.",
              "/tmp/study: the display refuses: no amplifier; expected 1.5; correct it", "There is no answer to Q1 yet.; words",
              "Slot 1 holds Slot 1 holds A. It must be B. It must be C.: a: b: The session is finished."},
             translateText}};
}

}  // namespace fuzz
