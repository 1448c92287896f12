// The option --explain of every command that computes: what is planned before the work, and what was found after it. Commands
// about a study print counts and times only, so that nothing that they print depends on the condition of a trial.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}
namespace protocols {
class OpenedFiles;
}

namespace study::commands {

/// Networks that a command starts in vis2hap-nn.
enum class Networks {
    None,
    IfGenerated,  ///< only for conditions with generated signals
    Always,
};

/// One row of the table of all commands that compute.
struct CommandNeeds {
    const char* command;  ///< "render", "study new"
    const char* reads;
    const char* computes;
    Networks networks = Networks::None;
    const char* libraries = "";  ///< that it loads while it runs, besides those of the program's start
};

std::span<const CommandNeeds> commandNeeds();

/// Libraries (file names with .so) that this process maps into memory, sorted.
std::set<std::string> mappedLibraries();

/// Resources of one call. Does nothing until begin() finds --explain.
class Explanation {
public:
    Explanation();
    ~Explanation();
    Explanation(const Explanation&) = delete;
    Explanation& operator=(const Explanation&) = delete;

    /// Adds --explain to each command of the table that the command line has.
    void addOptions(CLI::App& app);

    /// Where the called command has --explain: prints what the table plans and begins to observe.
    void begin(const CLI::App& app);
    /// Prints what was found.
    void end();

private:
    void print(const std::string& text) const;

    std::shared_ptr<bool> m_isAsked;
    const CommandNeeds* m_needs = nullptr;
    bool m_toErrors = false;  ///< standard output holds JSON alone
    std::chrono::steady_clock::time_point m_start;
    std::vector<std::filesystem::path> m_inputs;
    std::unique_ptr<protocols::OpenedFiles> m_opened;
    std::set<std::string> m_librariesBefore;
};

/// Times of the stages of a command's work, which the command itself knows.
class StageTimes {
public:
    /// `isOn`: --explain was given; without it nothing is printed.
    explicit StageTimes(bool isOn) : m_isOn(isOn) {}

    bool isOn() const { return m_isOn; }
    /// Prints text at once: a plan that only the command itself can state.
    void print(const std::string& text) const;
    /// Ends the stage before. The time of stages with one name is added up.
    void begin(const std::string& name);
    /// Ends the last stage and prints the times.
    void end();

private:
    using Clock = std::chrono::steady_clock;

    bool m_isOn;
    Clock::time_point m_start;
    std::string m_stage;
    std::vector<std::pair<std::string, double>> m_times;  ///< ms
};

/// Whether --explain was given to this command.
bool isExplained(const CLI::App& command);

}  // namespace study::commands
