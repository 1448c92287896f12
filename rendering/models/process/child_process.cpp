#include "rendering/models/process/child_process.h"

#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering::models {

namespace {

namespace fs = std::filesystem;

constexpr const char* install = "install libtorch-dev and libopenblas0-pthread, then build again";

/// Last line that is not empty, without the program's name in front.
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
    std::vector<std::string> variables = ownEnvironment();
    for (const auto& [name, value] : missingThreadSettings()) variables.push_back(name + "=" + value);
    return variables;
}

protocols::Error errorFrom(int exitStatus, const std::string& said, const fs::path& program)
{
    const std::string line =
        said.empty() ? program.string() + " ended with exit code " + std::to_string(exitStatus) + " and said nothing" : said;
    switch (exitStatus) {
        case 1:
            return protocols::workFailed({line, "", "", ""});
        case 2:
            return protocols::badInput({line, "", "", ""});
        case 3:
            return protocols::environmentFault({line, "", "", ""});
        default:
            return protocols::environmentFault(
                {"vis2hap-nn cannot be loaded: " + line, program.string(), "libtorch where the loader finds it", install});
    }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> missingThreadSettings()
{
    std::vector<std::pair<std::string, std::string>> missing;
    if (std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr)
        missing.emplace_back("GOMP_SPINCOUNT", "10000");  // About ten microseconds.
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
        {"the program vis2hap-nn is missing", folder.string(), "vis2hap-nn beside the program", install});
}

void runGeneratorProgram(const std::vector<std::string>& arguments, const fs::path& messages, const ProcessLimits& limits)
{
    const fs::path program = generatorProgram();
    const int status = LimitedProcess(program, arguments, environmentForThreads(), messages, limits).wait();
    if (WIFSIGNALED(status))
        throw protocols::environmentFault({"vis2hap-nn was ended by signal " + std::to_string(WTERMSIG(status)), program.string(),
                                           "enough memory for it", "close other programs and try again"});
    if (WEXITSTATUS(status) != 0) throw errorFrom(WEXITSTATUS(status), lastLine(messages), program);
}

}  // namespace rendering::models
