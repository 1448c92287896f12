#include "study/app/kept_settings.h"

#include <QFile>
#include <QRegularExpression>
#include <cctype>
#include <filesystem>

#include "protocols/files/safe_text.h"

namespace study::app {

namespace {

bool isOctal(char one) { return one >= '0' && one <= '7'; }
bool isHexadecimal(char one) { return std::isxdigit(static_cast<unsigned char>(one)) != 0; }

/// Moves `at` behind the digits and returns the character that they name: its last 16 bits, as in QSettings.
char numberedCharacter(const QByteArray& ini, qsizetype& at, int base)
{
    char16_t value = 0;
    const auto isDigit = base == 16 ? isHexadecimal : isOctal;
    for (; at < ini.size() && isDigit(ini[at]); ++at) {
        const int digit = QByteArray(1, ini[at]).toInt(nullptr, 16);
        value = static_cast<char16_t>(value * base + digit);
    }
    return value < 0x80 ? static_cast<char>(value) : '?';
}

/// The text as QSettings takes it: without quotes, and with the characters that escapes stand for.
QByteArray withoutEscapes(const QByteArray& ini)
{
    QByteArray plain;
    for (qsizetype at = 0; at < ini.size();) {
        const char one = ini[at++];
        if (one == '"') continue;
        if (one != '\\' || at == ini.size()) {
            plain += one;
        } else if (isOctal(ini[at])) {
            plain += numberedCharacter(ini, at, 8);
        } else if (ini[at] == 'x' && at + 1 < ini.size() && isHexadecimal(ini[at + 1])) {
            plain += numberedCharacter(ini, ++at, 16);
        } else if (const char next = ini[at++]; next == '\n' || next == '\r') {  // the line goes on
            if (at < ini.size() && (ini[at] == '\n' || ini[at] == '\r') && ini[at] != next) ++at;
        }  // No other escape stands for a letter, "@" or "(".
    }
    return plain;
}

}  // namespace

bool namesObjects(const QByteArray& ini)
{
    static const QRegularExpression object(QStringLiteral("[=,]\\s*@(Variant|DateTime)\\("));
    return QString::fromLatin1(withoutEscapes(ini)).contains(object);
}

std::string setUnreadableAside(const QString& file)
{
    QFile opened(file);
    if (!opened.open(QIODevice::ReadOnly)) return {};
    const bool isLarge = opened.size() > largestSettings;
    if (!isLarge && !namesObjects(opened.readAll())) return {};
    const std::filesystem::path from = file.toStdString(), to = from.string() + ".unreadable";
    std::filesystem::rename(from, to);
    return "the settings of the window were not read, because " +
           std::string(isLarge ? "they are larger than 1 MiB" : "a value holds an object instead of a text or number") +
           "; the window starts with the usual ones; the file is kept as " + protocols::printable(to.string());
}

}  // namespace study::app
