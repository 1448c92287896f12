#include "study/participant/programs/child_program.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <QCoreApplication>
#include <array>
#include <csignal>
#include <cstdio>
#include <utility>

#include "protocols/files/errors.h"

namespace study::participant {

void becomeChildProgram()
{
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // also where the end of the input is not noticed
    ::close_range(3, ~0U, 0);
    std::signal(SIGPIPE, SIG_IGN);
}

int reported(const std::string& program, const std::exception& fault, int code)
{
    std::fprintf(stderr, "%s: %s\n", program.c_str(), fault.what());
    return code;
}

InputLines::InputLines(std::string program, std::function<void(const std::string&)> take)
    : m_program(std::move(program)), m_take(std::move(take)), m_notifier(STDIN_FILENO, QSocketNotifier::Read)
{
    QObject::connect(&m_notifier, &QSocketNotifier::activated, &m_notifier, [this] { read(); });
}

void InputLines::read()
{
    std::array<char, 65536> bytes{};
    const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count <= 0) return QCoreApplication::exit(0);
    try {
        for (const std::string& line : m_lines.take({bytes.data(), static_cast<std::size_t>(count)})) m_take(line);
    } catch (const protocols::Error& fault) {
        // The app never sends such a line, so this program cannot know what it should do.
        QCoreApplication::exit(reported(m_program, fault, 1));
    }
}

}  // namespace study::participant
