// Progress of long work on standard error: a bar with the remaining time on a terminal, else plain lines.
#pragma once

#include <chrono>
#include <memory>
#include <string>

namespace study::commands {

class Progress {
public:
    explicit Progress(std::string label);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Prints at most ten times a second on a terminal, else one line for every tenth of the work. `what` names the current step.
    void show(int done, int total, const std::string& what = {});

private:
    std::string remaining(int done, int total) const;

    std::string m_label;
    bool m_terminal;
    std::chrono::steady_clock::time_point m_start, m_lastDrawn;
    int m_lastTenth = -1;
    bool m_open = false;
};

/// A bar for each stage of the work.
class StagesShown {
public:
    void show(const std::string& stage, int done, int total);

private:
    std::string m_stage;
    std::unique_ptr<Progress> m_progress;
};

}  // namespace study::commands
