#include "rendering/models/second_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "protocols/files/errors.h"

extern char** environ;

namespace rendering::models {

std::string secondProgram()
{
    if (const char* chosen = std::getenv("VIS2HAP_NN")) return chosen;
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "vis2hap-nn").string();
}

namespace {

protocols::Error cannotStart()
{
    return protocols::environmentFault({"the neural-network part cannot be started", secondProgram(), "vis2hap-nn and libtorch",
                                        "install libtorch (apt-get install libtorch-dev) or run ./run again"});
}

/// A child whose standard output and error go where `actions` say.
pid_t start(const std::vector<std::string>& arguments, const posix_spawn_file_actions_t* actions)
{
    const std::string program = secondProgram();
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    pid_t child = 0;
    if (posix_spawn(&child, program.c_str(), actions, nullptr, argv.data(), environ) != 0) throw cannotStart();
    return child;
}

int exitCodeOf(pid_t child)
{
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// The loader complains in its own many words; asked for its usage first, the child tells us in silence.
void requireLoadable()
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const pid_t child = start({"--help"}, &actions);
    posix_spawn_file_actions_destroy(&actions);
    if (exitCodeOf(child) != 0) throw cannotStart();
}

}  // namespace

int runSecondProgram(const std::vector<std::string>& arguments)
{
    requireLoadable();
    return exitCodeOf(start(arguments, nullptr));
}

std::string outputOfSecondProgram(const std::vector<std::string>& arguments)
{
    requireLoadable();
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) throw cannotStart();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    const pid_t child = start(arguments, &actions);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    std::string text;
    std::array<char, 4096> chunk{};
    for (ssize_t n = 0; (n = read(ends[0], chunk.data(), chunk.size())) > 0;) text.append(chunk.data(), static_cast<size_t>(n));
    close(ends[0]);
    if (exitCodeOf(child) != 0)
        throw protocols::workFailed({"the neural-network part failed", secondProgram(), "", "see the line above"});
    return text;
}

}  // namespace rendering::models
