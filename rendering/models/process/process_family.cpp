#include "rendering/models/process/process_family.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>

namespace rendering::models {

namespace {

constexpr int cannotKeep = 127;  // as a shell's status for a program that cannot be started

/// Sends SIGKILL to every child of this process. Orphans of its descendants have become its children. False where the kernel
/// has no list of them.
bool killChildren()
{
    const int list = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    if (list < 0) return false;
    std::array<char, 4096> text{};
    pid_t child = 0;
    ssize_t count = 0;
    while ((count = ::read(list, text.data(), text.size())) > 0)
        for (ssize_t i = 0; i < count; ++i) {
            const char c = text[static_cast<std::size_t>(i)];
            if (c >= '0' && c <= '9') {
                child = child * 10 + (c - '0');
            } else {
                if (child > 0) ::kill(child, SIGKILL);
                child = 0;
            }
        }
    ::close(list);
    return true;
}

/// Kills and reaps until no child is left. `program` may have ended.
void endFamily(pid_t program)
{
    constexpr struct timespec moment {
        0, 1'000'000
    };
    while (true) {
        const pid_t ended = ::waitpid(-1, nullptr, WNOHANG);
        if (ended < 0 && errno != EINTR) return;
        if (ended != 0) continue;
        // The kernel's list may miss a child that appears meanwhile, so this repeats until none is left.
        if (!killChildren()) {
            ::kill(program, SIGKILL);
            return;
        }
        ::nanosleep(&moment, nullptr);
    }
}

/// Ends this process with the status of another one.
[[noreturn]] void endWith(int status)
{
    if (WIFEXITED(status)) ::_exit(WEXITSTATUS(status));
    const int number = WTERMSIG(status);
    ::signal(number, SIG_DFL);  // NOLINT: the same signal ends this process.
    sigset_t none;
    ::sigemptyset(&none);
    ::raise(number);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::_exit(cannotKeep);
}

[[noreturn]] void keep(pid_t program, const sigset_t& signals)
{
    while (true) {
        const int number = ::sigwaitinfo(&signals, nullptr);
        if (number < 0) continue;
        int status = 0;
        if (number != SIGCHLD) {
            endFamily(program);
            endWith(SIGKILL);
        }
        for (pid_t ended = 0; (ended = ::waitpid(-1, &status, WNOHANG)) > 0;)
            if (ended == program) {
                endFamily(program);
                endWith(status);
            }
    }
}

}  // namespace

void stayBehindAsKeeper(pid_t parent, int report)
{
    sigset_t all, before;
    ::sigfillset(&all);
    ::sigprocmask(SIG_SETMASK, &all, &before);
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(cannotKeep);  // The parent died before the line above.
    const pid_t keeper = ::getpid();
    const pid_t program = ::_Fork();
    if (program < 0) ::_exit(cannotKeep);
    if (program > 0) {
        ::close(report);
        ::close_range(STDERR_FILENO + 1, ~0U, 0);  // It becomes no other program, so nothing else closes what it inherited.
        sigset_t awaited;
        ::sigemptyset(&awaited);
        for (const int number : {SIGCHLD, SIGTERM, SIGINT, SIGHUP, SIGQUIT}) ::sigaddset(&awaited, number);
        keep(program, awaited);
    }
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != keeper) ::_exit(cannotKeep);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace rendering::models
