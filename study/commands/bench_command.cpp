// vis2hap bench: speed and error of every stage.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "study/bench/bench.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"

namespace study::commands {

namespace {

struct BenchCall {
    std::vector<std::string> stages;
    bench::BenchOptions options;
    JsonTarget target;
};

/// One line on a terminal: the part of the work that runs, and the time since the beginning. Nothing elsewhere.
class RunningPart {
public:
    ~RunningPart() { clear(); }

    void show(const std::string& part)
    {
        if (!m_terminal) return;
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - m_start);
        std::fprintf(stderr, "\r\033[Kbench: %s (%lld s so far)", part.c_str(), static_cast<long long>(seconds.count()));
        std::fflush(stderr);
    }

    void clear()
    {
        if (m_terminal) std::fputs("\r\033[K", stderr);
    }

private:
    bool m_terminal = isatty(STDERR_FILENO) != 0;
    std::chrono::steady_clock::time_point m_start = std::chrono::steady_clock::now();
};

int runBench(const BenchCall& call)
{
    auto options = call.options;
    RunningPart running;
    options.begins = [&running](const std::string& part) { running.show(part); };
    options.skipped = [&running](const std::string& line) {
        running.clear();
        std::fprintf(stderr, "skipped: %s\n", line.c_str());
    };
    std::vector<bench::BenchRow> rows;
    for (const auto& stage : call.stages.empty() ? bench::benchStages() : call.stages)
        for (auto& row : bench::benchStage(stage, options)) rows.push_back(std::move(row));
    running.clear();
    if (!call.target) {
        std::fputs(bench::tableOf(rows).c_str(), stdout);
        return 0;
    }
    auto table = nlohmann::ordered_json::array();
    for (const auto& row : rows) table.push_back(jsonOf(row));
    writeJson(call.target, {{"schema", "vis2hap.bench/1"}, {"rows", table}});
    return 0;
}

}  // namespace

void addBench(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("bench", "print speed and error of every stage on this machine");
    auto call = std::make_shared<BenchCall>();
    command->add_option("STAGE", call->stages, "signals, fabrics, statistics, session, generators (default: all)")
        ->check(CLI::IsMember(bench::benchStages()));
    command->add_flag("--peers", call->options.peers, "also time R and packages of Python on the same work");
    command->add_option("--data", call->options.recordings,
                        "folder of recordings: also run the signal stages on them and compare with known values");
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Offscreen;
        action.work = [call] { return runBench(*call); };
    });
}

}  // namespace study::commands
