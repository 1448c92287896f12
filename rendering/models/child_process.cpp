#include "rendering/models/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

extern char** environ;  // NOLINT: the C library's own

namespace rendering::models {

namespace {

namespace fs = std::filesystem;

constexpr const char* install = "install libtorch-dev and libopenblas0-pthread, then build again";

/// The last line that says anything; the child's own name in front of it is taken off.
std::string lastLine(const fs::path& messages)
{
    std::istringstream stream(protocols::readIfPossible(messages).value_or(""));
    std::string line, last;
    while (std::getline(stream, line))
        if (!line.empty()) last = line;
    const std::string prefix = "vis2hap: ";
    return last.starts_with(prefix) ? last.substr(prefix.size()) : last;
}

std::vector<std::string> environmentForThreads()
{
    std::vector<std::string> variables;
    for (char** variable = environ; *variable != nullptr; ++variable) variables.emplace_back(*variable);
    for (const auto& [name, value] : missingThreadSettings()) variables.push_back(name + "=" + value);
    return variables;
}

/// As the C library wants lists of texts: pointers, the last one null.
std::vector<char*> pointersTo(std::vector<std::string>& texts)
{
    std::vector<char*> pointers;
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    return pointers;
}

pid_t started(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& messages)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, messages.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    pid_t child = 0;
    std::vector<std::string> surroundings = environmentForThreads();
    const int fault =
        ::posix_spawn(&child, program.c_str(), &actions, nullptr, pointersTo(words).data(), pointersTo(surroundings).data());
    posix_spawn_file_actions_destroy(&actions);
    if (fault != 0)
        throw protocols::environmentFault({std::string("the generators' program cannot be started: ") + std::strerror(fault),
                                           program.string(), "an executable file", install});
    return child;
}

int waitFor(pid_t child)
{
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            throw protocols::environmentFault({std::string("lost the generators' program: ") + std::strerror(errno), "", "", ""});
    return status;
}

protocols::Error told(int exitStatus, const std::string& line, const fs::path& program)
{
    switch (exitStatus) {
        case 1:
            return protocols::workFailed({line, "", "", ""});
        case 2:
            return protocols::badInput({line, "", "", ""});
        case 3:
            return protocols::environmentFault({line, "", "", ""});
        default:
            return protocols::environmentFault({"the generators' program cannot be loaded: " + line, program.string(),
                                                "libtorch where the loader finds it", install});
    }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> missingThreadSettings()
{
    std::vector<std::pair<std::string, std::string>> missing;
    if (std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr)
        missing.emplace_back("GOMP_SPINCOUNT", "10000");  // some ten microseconds
    if (std::getenv("OPENBLAS_NUM_THREADS") == nullptr) missing.emplace_back("OPENBLAS_NUM_THREADS", "1");
    return missing;
}

fs::path generatorProgram()
{
    if (const char* chosen = std::getenv("VIS2HAP_NN"); chosen != nullptr && *chosen != '\0') return chosen;
    std::error_code none;
    const fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
    for (const fs::path& candidate : {folder / "vis2hap-nn", folder.parent_path() / "vis2hap-nn"})
        if (fs::is_regular_file(candidate, none)) return candidate;
    throw protocols::environmentFault(
        {"the generators' program vis2hap-nn is missing", folder.string(), "it beside the program", install});
}

void runGeneratorProgram(const std::vector<std::string>& arguments, const fs::path& messages)
{
    const fs::path program = generatorProgram();
    const int status = waitFor(started(program, arguments, messages));
    if (WIFSIGNALED(status))
        throw protocols::environmentFault({"the generators' program was ended by signal " + std::to_string(WTERMSIG(status)),
                                           program.string(), "enough memory for it", "close other programs and try again"});
    if (WEXITSTATUS(status) != 0) throw told(WEXITSTATUS(status), lastLine(messages), program);
}

}  // namespace rendering::models
