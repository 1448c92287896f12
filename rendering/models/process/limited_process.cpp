#include "rendering/models/process/limited_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "protocols/files/errors.h"
#include "protocols/secrets/secret_variables.h"
#include "rendering/models/process/process_family.h"

namespace rendering::models {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr std::uint64_t gibibyte = std::uint64_t{1} << 30;
constexpr const char* timeVariable = "VIS2HAP_NN_SECONDS";
constexpr const char* memoryVariable = "VIS2HAP_NN_MEMORY_MB";

/// nullopt where the variable is not set.
std::optional<std::uint32_t> chosenNumber(const char* variable)
{
    const char* text = std::getenv(variable);
    if (text == nullptr || *text == '\0') return std::nullopt;
    const std::string_view whole(text);
    std::uint32_t number = 0;
    const auto read = std::from_chars(whole.data(), whole.data() + whole.size(), number);
    if (read.ec != std::errc() || read.ptr != whole.data() + whole.size() || number == 0)
        throw protocols::badInput({"the value '" + std::string(whole) + "' is not a limit", variable, "a positive whole number",
                                   "correct or unset it"});
    return number;
}

std::uint64_t machineMemory()
{
    return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

ProcessLimits chosenInstead(ProcessLimits limits)
{
    if (const auto number = chosenNumber(timeVariable); number && limits.time) limits.time = seconds(*number);
    if (const auto number = chosenNumber(memoryVariable)) limits.memoryBytes = std::uint64_t{*number} << 20;
    return limits;
}

/// Pointers to texts with a null at the end, as the C library expects them.
std::vector<char*> cPointers(std::vector<std::string>& texts)
{
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

void limit(__rlimit_resource resource, std::uint64_t most)
{
    struct rlimit both {};
    if (::getrlimit(resource, &both) != 0) return;
    both.rlim_max = std::min<rlim_t>(both.rlim_max, most);
    both.rlim_cur = std::min<rlim_t>(both.rlim_cur, both.rlim_max);
    ::setrlimit(resource, &both);
}

/// What the new process needs before it becomes the program. It may be a copy of a process with several threads, so only
/// functions that are safe in signal handlers are called.
struct Preparation {
    pid_t parent = 0;
    int output = -1, errors = -1, input = -1;  ///< descriptors, or -1 for those of the parent
    bool withDescendants = false;
    ProcessLimits limits;
};

[[noreturn]] void becomeProgram(const Preparation& preparation, const char* program, char* const* words, char* const* variables,
                                int report)
{
    if (preparation.withDescendants) {
        stayBehindAsKeeper(preparation.parent, report);
    } else {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != preparation.parent) ::_exit(127);  // The parent died before the line above.
    }
    ::signal(SIGXFSZ, SIG_IGN);  // NOLINT: a write beyond the limit then fails with a reason.
#ifndef __SANITIZE_ADDRESS__     // Its shadow memory alone exceeds every limit.
    limit(RLIMIT_DATA, preparation.limits.memoryBytes);
#endif
    limit(RLIMIT_FSIZE, preparation.limits.fileBytes);
    limit(RLIMIT_NOFILE, static_cast<std::uint64_t>(preparation.limits.openFiles));
    limit(RLIMIT_CORE, 0);
    if (preparation.input >= 0) ::dup2(preparation.input, STDIN_FILENO);
    if (preparation.output >= 0) {
        ::dup2(preparation.output, STDOUT_FILENO);
        ::dup2(preparation.errors, STDERR_FILENO);
    }
    ::execve(program, words, variables);
    const int reason = errno;
    [[maybe_unused]] const ssize_t written = ::write(report, &reason, sizeof reason);
    ::_exit(127);
}

protocols::Error cannotStartProcess(const std::filesystem::path& program, int reason, const std::string& nextStep)
{
    return protocols::environmentFault({program.filename().string() + " cannot be started: " + std::strerror(reason),
                                        program.string(), "an executable file", nextStep});
}

int openedForAppending(const std::filesystem::path& file)
{
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
}

/// Closed with this value.
struct OpenDescriptor {
    int number = -1;
    explicit OpenDescriptor(int opened) : number(opened) {}
    ~OpenDescriptor() { close(); }
    OpenDescriptor(const OpenDescriptor&) = delete;
    OpenDescriptor& operator=(const OpenDescriptor&) = delete;
    void close()
    {
        if (number >= 0) ::close(number);
        number = -1;
    }
};

/// Waits until the process has ended or the time is over; without a kernel that offers a descriptor of a process, for a moment.
void waitForEnd(const OpenDescriptor& process, std::optional<milliseconds> left)
{
    if (process.number < 0) {
        std::this_thread::sleep_for(std::min(left.value_or(milliseconds(5)), milliseconds(5)));
        return;
    }
    struct pollfd ended {
        process.number, POLLIN, 0
    };
    constexpr milliseconds longest{1000000};
    ::poll(&ended, 1, left ? static_cast<int>(std::min(*left, longest).count()) : -1);
}

}  // namespace

ProcessLimits generationLimits(double megapixels)
{
    ProcessLimits limits;
    limits.time = seconds(600 + static_cast<std::int64_t>(std::ceil(240 * std::clamp(megapixels, 0.0, 1e6))));
    limits.memoryBytes = std::max(4 * gibibyte, machineMemory() / 2);
    limits.fileBytes = 4 * gibibyte;
    return chosenInstead(limits);
}

ProcessLimits trainingLimits()
{
    ProcessLimits limits;
    limits.memoryBytes = std::max(4 * gibibyte, machineMemory());
    limits.fileBytes = 16 * gibibyte;
    return chosenInstead(limits);
}

ProcessLimits benchLimits()
{
    ProcessLimits limits = generationLimits(0);
    if (!chosenNumber(timeVariable)) limits.time = std::chrono::hours(1);
    return limits;
}

std::vector<std::string> ownEnvironment() { return protocols::environmentWithoutSecrets(); }

LimitedProcess::LimitedProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                               const std::vector<std::string>& environment, const std::optional<std::filesystem::path>& output,
                               const ProcessLimits& limits)
    : LimitedProcess(program, arguments, ProcessSurroundings{.environment = environment, .output = output}, limits)
{
}

LimitedProcess::LimitedProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                               const ProcessSurroundings& surroundings, const ProcessLimits& limits)
    : m_program(program),
      m_timeLimit(limits.time),
      m_started(steady_clock::now()),
      m_withDescendants(surroundings.withDescendants)
{
    const auto& output = surroundings.output;
    const auto cannotStart = [&](int reason) { return cannotStartProcess(program, reason, surroundings.ifItCannotStart); };
    std::vector<std::string> words{program.string()}, variables = surroundings.environment;
    words.insert(words.end(), arguments.begin(), arguments.end());
    const std::vector<char*> wordPointers = cPointers(words), variablePointers = cPointers(variables);
    OpenDescriptor in(output ? ::open("/dev/null", O_RDONLY | O_CLOEXEC) : -1);
    OpenDescriptor out(output ? openedForAppending(*output) : -1);
    OpenDescriptor errors(output && surroundings.errors ? openedForAppending(*surroundings.errors) : -1);
    if (output && (in.number < 0 || out.number < 0 || (surroundings.errors && errors.number < 0))) throw cannotStart(errno);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw cannotStart(errno);
    OpenDescriptor from(ends[0]), to(ends[1]);
    const Preparation preparation{::getpid(), out.number,        errors.number < 0 ? out.number : errors.number,
                                  in.number,  m_withDescendants, limits};
    m_child = ::fork();
    if (m_child < 0) {
        m_child = 0;
        throw cannotStart(errno);
    }
    if (m_child == 0) becomeProgram(preparation, program.c_str(), wordPointers.data(), variablePointers.data(), to.number);
    to.close();
    int reason = 0;
    ssize_t count = 0;
    while ((count = ::read(from.number, &reason, sizeof reason)) < 0 && errno == EINTR) {
    }
    if (count == static_cast<ssize_t>(sizeof reason)) {
        kill();
        throw cannotStart(reason);
    }
}

LimitedProcess::~LimitedProcess() { kill(); }

void LimitedProcess::kill()
{
    if (m_child == 0) return;
    ::kill(m_child, m_withDescendants ? SIGTERM : SIGKILL);  // The keeper of a family kills it and ends.
    ::kill(m_child, SIGCONT);
    while (::waitpid(m_child, nullptr, 0) < 0 && errno == EINTR) {
    }
    m_child = 0;
}

int LimitedProcess::wait()
{
    if (const std::optional<int> status = statusInTime()) return *status;
    throw protocols::environmentFault(
        {m_program.filename().string() + " did not finish in time and was ended", m_program.string(),
         "an end within " + std::to_string(m_timeLimit->count()) + " s",
         std::string("close other programs and try again, or set ") + timeVariable + " to more seconds"});
}

std::optional<int> LimitedProcess::statusInTime()
{
    const OpenDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, m_child, 0)));
    while (true) {
        int status = 0;
        const pid_t ended = ::waitpid(m_child, &status, WNOHANG);
        if (ended == m_child) {
            m_child = 0;
            return status;
        }
        if (ended < 0 && errno != EINTR) {
            m_child = 0;
            throw protocols::environmentFault(
                {m_program.filename().string() + " was lost: " + std::strerror(errno), m_program.string(), "", "try again"});
        }
        std::optional<milliseconds> left;
        if (m_timeLimit) left = std::chrono::duration_cast<milliseconds>(m_started + *m_timeLimit - steady_clock::now());
        if (left && left->count() <= 0) {
            kill();
            return std::nullopt;
        }
        waitForEnd(process, left);
    }
}

}  // namespace rendering::models
