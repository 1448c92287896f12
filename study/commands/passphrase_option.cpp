#include "study/commands/passphrase_option.h"

#include <termios.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace study::commands {

namespace {

constexpr const char* variable = "VIS2HAP_PASSPHRASE";
constexpr std::size_t shortestPassphrase = 8;

/// Hides what is typed while it lives.
class Unechoed {
public:
    Unechoed()
    {
        if (::tcgetattr(STDIN_FILENO, &m_before) != 0) return;
        termios hidden = m_before;
        hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
        m_isHidden = ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden) == 0;
    }
    ~Unechoed()
    {
        if (m_isHidden) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &m_before);
    }
    Unechoed(const Unechoed&) = delete;
    Unechoed& operator=(const Unechoed&) = delete;

private:
    termios m_before{};
    bool m_isHidden = false;
};

bool hasTerminal() { return ::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0; }

std::optional<std::string> asked(const std::string& question)
{
    std::fprintf(stderr, "%s: ", question.c_str());
    std::string line;
    const Unechoed hidden;
    const bool isThere = static_cast<bool>(std::getline(std::cin, line));
    std::fputc('\n', stderr);
    return isThere ? std::optional(line) : std::nullopt;
}

/// The first line of the file, without its end.
std::string firstLineOf(const std::string& file)
{
    std::string text = protocols::readWholeFile(file);
    text = text.substr(0, text.find('\n'));
    if (text.ends_with('\r')) text.pop_back();
    return text;
}

std::optional<std::string> givenBeforehand(const PassphraseOption& option)
{
    if (!option.file.empty()) return firstLineOf(option.file);
    if (const char* value = std::getenv(variable)) return std::string(value);
    return std::nullopt;
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
    return [option, whose]() -> std::optional<std::string> {
        if (auto given = givenBeforehand(option)) return given;
        return hasTerminal() ? asked(whose) : std::nullopt;
    };
}

database::Passphrase givenPassphrase(const PassphraseOption& option)
{
    return [option] { return givenBeforehand(option); };
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
    if (given->size() < shortestPassphrase)
        throw protocols::badInput({"the passphrase is too short", "", std::to_string(shortestPassphrase) + " characters or more",
                                   "choose a longer one, such as four words"});
    return *given;
}

}  // namespace study::commands
