// A child process with limits of time, memory and files. It dies with its parent, also when the parent is killed.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rendering::models {

struct ProcessLimits {
    std::optional<std::chrono::seconds> time;  ///< wall time; none where absent
    std::uint64_t memoryBytes = 0;             ///< memory that the process may write to
    std::uint64_t fileBytes = 0;               ///< largest file that it may write
    int openFiles = 256;
};

/// Limits of vis2hap-nn. The environment variables VIS2HAP_NN_SECONDS and VIS2HAP_NN_MEMORY_MB replace those of time and memory;
/// values that are not positive whole numbers throw badInput.
///   generation  10 minutes and 4 more for each megapixel; half of the machine's memory, at least 4 GiB; files of 4 GiB
///   training    any time, because --steps and --minutes limit it; the machine's memory; files of 16 GiB
ProcessLimits generationLimits(double megapixels);
ProcessLimits trainingLimits();
/// A measurement of the generators (`vis2hap bench`): an hour.
ProcessLimits benchLimits();

/// What a process runs in.
struct ProcessSurroundings {
    std::vector<std::string> environment;              ///< exactly these variables, "NAME=VALUE"
    std::optional<std::filesystem::path> output = {};  ///< file for its standard output; its standard input is empty
    std::optional<std::filesystem::path> errors = {};  ///< file for its standard error; absent: that of `output`
    bool withDescendants = false;                      ///< nothing that it starts outlives it
    std::string ifItCannotStart = "install libtorch-dev and libopenblas0-pthread, then build again";  ///< what to do then
};

class LimitedProcess {
public:
    /// Starts `program` within limits and surroundings; both files are appended to. Without `output` it has the input and output
    /// of this process. Throws environmentFault where it cannot be started.
    LimitedProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const ProcessSurroundings& surroundings, const ProcessLimits& limits);
    /// Starts `program` with exactly the variables `environment`. Its standard output and error are appended to `output`, and its
    /// standard input is empty; without `output` it has those of this process. Throws environmentFault where it cannot be
    /// started.
    LimitedProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment, const std::optional<std::filesystem::path>& output,
                   const ProcessLimits& limits);
    /// Kills the process if it still runs, with its descendants where they belong to it.
    ~LimitedProcess();
    LimitedProcess(const LimitedProcess&) = delete;
    LimitedProcess& operator=(const LimitedProcess&) = delete;

    pid_t number() const { return m_child; }

    /// Waits for the end and returns the status of waitpid(2). The thread that made this value must call it, because the process
    /// dies with that thread. Throws environmentFault where the time limit was reached; the process is then killed.
    int wait();

    /// The same; nothing where the time limit was reached.
    std::optional<int> statusInTime();

private:
    void kill();

    std::filesystem::path m_program;
    std::optional<std::chrono::seconds> m_timeLimit;
    std::chrono::steady_clock::time_point m_started;
    pid_t m_child = 0;  ///< 0 after its end
    bool m_withDescendants = false;
};

/// Variables of this process, "NAME=VALUE", without passphrases and passwords.
std::vector<std::string> ownEnvironment();

}  // namespace rendering::models
