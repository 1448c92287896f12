#include "rendering/models/process/second_program.h"

#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "rendering/models/process/child_process.h"
#include "rendering/models/process/limited_process.h"

namespace rendering::models {

std::string secondProgram() { return generatorProgram().string(); }

namespace {

protocols::Error cannotStart()
{
    return protocols::environmentFault({"vis2hap-nn cannot be started", secondProgram(), "vis2hap-nn and libtorch",
                                        "install libtorch (apt-get install libtorch-dev) or run ./run again"});
}

/// Runs the program to its end; `output` receives what it prints, or this terminal.
int exitCodeWithin(const ProcessLimits& limits, const std::vector<std::string>& arguments,
                   const std::optional<std::filesystem::path>& output)
{
    const int status = LimitedProcess(secondProgram(), arguments, ownEnvironment(), output, limits).wait();
    if (WIFSIGNALED(status))
        throw protocols::environmentFault({"vis2hap-nn was ended by signal " + std::to_string(WTERMSIG(status)), secondProgram(),
                                           WTERMSIG(status) == SIGKILL ? "enough memory for it" : "a program that ends by itself",
                                           "try again, a training with --resume"});
    return WEXITSTATUS(status);
}

/// Throws environmentFault where the program cannot be loaded. The loader's own messages are long, so a silent trial run with
/// --help comes first.
void requireLoadable()
{
    ProcessLimits limits = trainingLimits();
    limits.time = std::chrono::minutes(5);
    const int status = LimitedProcess(secondProgram(), {"--help"}, ownEnvironment(), "/dev/null", limits).wait();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw cannotStart();
}

}  // namespace

int runSecondProgram(const std::vector<std::string>& arguments)
{
    requireLoadable();
    return exitCodeWithin(trainingLimits(), arguments, std::nullopt);
}

std::string outputOfSecondProgram(std::vector<std::string> arguments)
{
    requireLoadable();
    const protocols::TemporaryFolder folder;
    const std::filesystem::path output = folder.path() / "output";
    arguments.push_back(output.string());
    if (exitCodeWithin(benchLimits(), arguments, std::nullopt) != 0)
        throw protocols::workFailed({"vis2hap-nn failed", secondProgram(), "exit code 0", "see the line above"});
    return protocols::readWholeFile(output);
}

}  // namespace rendering::models
