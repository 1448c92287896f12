#include "study/commands/parts/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace study::commands {

namespace {

constexpr int barWidth = 30;

std::string durationText(double seconds)
{
    const int whole = std::max(0, static_cast<int>(seconds + 0.5));
    if (whole < 60) return std::to_string(whole) + " s";
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
}

}  // namespace

Progress::Progress(std::string label)
    : m_label(std::move(label)),
      m_terminal(isatty(STDERR_FILENO) != 0),
      m_start(std::chrono::steady_clock::now()),
      m_lastDrawn(m_start - std::chrono::seconds(1))
{
}

Progress::~Progress()
{
    if (m_open) std::fputs("\n", stderr);
}

std::string Progress::remaining(int done, int total) const
{
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    if (done >= total) return "done in " + durationText(elapsed);
    if (done <= 0 || elapsed < 0.5) return "";
    return durationText(elapsed * (total - done) / done) + " left";
}

void Progress::show(int done, int total, const std::string& what)
{
    if (total <= 0) return;
    if (!m_terminal) {
        const int tenth = 10 * done / total;
        if (tenth == m_lastTenth || (done > 0 && tenth == 0)) return;
        m_lastTenth = tenth;
        std::fprintf(stderr, "%s: %d of %d %s\n", m_label.c_str(), done, total, remaining(done, total).c_str());
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (done < total && now - m_lastDrawn < std::chrono::milliseconds(100)) return;
    m_lastDrawn = now;
    const int filled = barWidth * done / total;
    const std::string bar = std::string(filled, '#') + std::string(barWidth - filled, '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %d/%d %s %s", m_label.c_str(), bar.c_str(), done, total, remaining(done, total).c_str(),
                 done < total ? what.c_str() : "");
    m_open = done < total;
    if (!m_open) std::fputs("\n", stderr);
    std::fflush(stderr);
}

void StagesShown::show(const std::string& stage, int done, int total)
{
    if (!m_progress || stage != m_stage) {
        m_progress.reset();  // ends the line of the stage before
        m_progress = std::make_unique<Progress>(stage);
    }
    m_stage = stage;
    m_progress->show(done, total);
}

}  // namespace study::commands
