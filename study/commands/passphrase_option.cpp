#include "study/commands/passphrase_option.h"

#include <termios.h>
#include <unistd.h>

#include <QString>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <iterator>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/text_encoding.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "protocols/secrets/new_passphrase.h"

namespace study::commands {

namespace {

constexpr const char* variable = "VIS2HAP_PASSPHRASE";

constexpr int endingSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};

// For the handler, which may use nothing else.
termios terminalBefore{};
void (*handlersBefore[std::size(endingSignals)])(int) = {};

/// A handler from before may have files to remove.
void showAgainAndEnd(int number)
{
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &terminalBefore);
    for (std::size_t i = 0; i < std::size(endingSignals); ++i)
        if (endingSignals[i] == number) std::signal(number, handlersBefore[i]);
    (void)::raise(number);
}

/// Hides what is typed while it lives. A signal that ends the program shows it again.
class Unechoed {
public:
    Unechoed()
    {
        if (::tcgetattr(STDIN_FILENO, &terminalBefore) != 0) return;
        for (std::size_t i = 0; i < std::size(endingSignals); ++i) {
            handlersBefore[i] = std::signal(endingSignals[i], SIG_IGN);
            if (handlersBefore[i] != SIG_IGN) std::signal(endingSignals[i], showAgainAndEnd);  // SIG_IGN: as `nohup` wants it
        }
        m_handles = true;
        termios hidden = terminalBefore;
        hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
        m_isHidden = ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden) == 0;
    }
    ~Unechoed()
    {
        if (m_isHidden) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &terminalBefore);
        for (std::size_t i = 0; m_handles && i < std::size(endingSignals); ++i) std::signal(endingSignals[i], handlersBefore[i]);
    }
    Unechoed(const Unechoed&) = delete;
    Unechoed& operator=(const Unechoed&) = delete;

private:
    bool m_handles = false, m_isHidden = false;
};

bool hasTerminal() { return ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0; }

/// The same letters give the same bytes on every keyboard: one may send ü as one character, another as u and two dots.
std::string inOneForm(const std::string& typed, const std::string& where)
{
    if (protocols::firstByteThatIsNotUtf8(typed))
        throw protocols::badInput({"the passphrase is not UTF-8", where, "text in UTF-8", "save the file as UTF-8"});
    return QString::fromStdString(typed).normalized(QString::NormalizationForm_C).toStdString();
}

std::optional<std::string> asked(const std::string& question)
{
    std::fprintf(stderr, "%s: ", question.c_str());
    std::string line;
    const Unechoed hidden;
    const bool isThere = static_cast<bool>(std::getline(std::cin, line));
    std::fputc('\n', stderr);
    return isThere ? std::optional(inOneForm(line, "terminal")) : std::nullopt;
}

constexpr std::uint64_t largestPassphraseFile = std::uint64_t{1} << 20;  // a larger one was named by mistake

/// The first line of the file, without its end. Windows writes such files in UTF-16, too.
std::string firstLineOf(const std::string& file)
{
    const std::string text = protocols::decodedText(protocols::readWholeFile(file, largestPassphraseFile), file).text;
    return text.substr(0, text.find_first_of("\r\n"));
}

std::optional<std::string> givenBeforehand(const PassphraseOption& option)
{
    if (!option.file.empty()) return inOneForm(firstLineOf(option.file), option.file);
    // A shell takes the line feed off what it puts into a variable, and leaves the carriage return of a Windows file.
    if (const char* value = std::getenv(variable)) return inOneForm(protocols::withoutLineEnd(value), variable);
    return std::nullopt;
}

protocols::Error unusable(protocols::PassphraseFault fault)
{
    switch (fault) {
        case protocols::PassphraseFault::OnlyBlanks:
            return protocols::badInput(
                {"the passphrase holds only blanks", "", "letters, digits and signs", "choose another one"});
        case protocols::PassphraseFault::ControlCharacter:
            return protocols::badInput({"the passphrase holds a control character, which nobody can type", "",
                                        "letters, digits, signs and blanks", "choose another one"});
        case protocols::PassphraseFault::TooShort:
            break;
    }
    return protocols::badInput({"the passphrase is too short", "",
                                std::to_string(protocols::shortestPassphrase) + " characters or more",
                                "choose a longer one, such as four words"});
}

}  // namespace

void addPassphraseOption(CLI::App& command, PassphraseOption& option)
{
    command.add_option(
        "--passphrase-file", option.file,
        "file with the owner's passphrase in its first line (default: VIS2HAP_PASSPHRASE, then the terminal asks)");
}

database::Passphrase passphraseFrom(const PassphraseOption& option, const std::string& whose)
{
    // A file that is missing is an error, also where the key turns out to lie open.
    return [given = givenBeforehand(option), whose]() -> std::optional<std::string> {
        if (given) return given;
        return hasTerminal() ? asked(whose) : std::nullopt;
    };
}

database::Passphrase givenPassphrase(const PassphraseOption& option)
{
    return [given = givenBeforehand(option)] { return given; };
}

std::string newPassphrase(const PassphraseOption& option, const std::string& key)
{
    auto given = givenBeforehand(option);
    if (!given && hasTerminal()) {
        given = asked("passphrase for " + key);
        if (given && asked("the same again") != given)
            throw protocols::badInput({"the two passphrases differ", "", "the same passphrase twice", "try again"});
    }
    if (!given)
        throw protocols::badInput({"a passphrase is needed, which seals " + key, "",
                                   "a terminal to ask on, --passphrase-file FILE or " + std::string(variable),
                                   "give one; --no-passphrase leaves the key open, for simulated studies and tests"});
    if (const auto fault = protocols::faultOfNewPassphrase(*given)) throw unusable(*fault);
    return *given;
}

}  // namespace study::commands
