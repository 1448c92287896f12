// vis2hap bench: speed and error of every stage that has a fast and an accurate way.
#include "protocols/errors.h"
#include "rendering/bench.h"
#include "study/commands/bench_session.h"
#include "study/commands/bench_statistics.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/second_program.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace study::commands {

namespace {

using nlohmann::ordered_json;

const std::vector<std::string> stages{"signals", "statistics", "session", "generators"};

ordered_json signalRows()
{
    ordered_json rows = ordered_json::array();
    for (const auto& row : rendering::benchSignals())
        rows.push_back({{"stage", row.stage}, {"quality", row.quality}, {"ms", row.milliseconds}, {"error", row.error},
                        {"error_is", row.errorUnit}, {"note", row.note}});
    return rows;
}

ordered_json generatorRows()
{
    const auto bench = ordered_json::parse(outputOfSecondProgram({"bench", "--json"}));
    ordered_json rows = ordered_json::array();
    for (const auto& quality : bench["qualities"]) {
        char note[120];
        std::snprintf(note, sizeof note, "heights off by %.3f mm from accurate, photographs of 256x256",
                      quality["height_deviation_from_accurate_mm"].get<double>());
        rows.push_back({{"stage", "photograph to height and friction"}, {"quality", quality["quality"]},
                        {"ms", quality["ms_per_photograph"]}, {"error", 100 * quality["mean_friction_relative_error"].get<double>()},
                        {"error_is", "% of mean friction, generated against measured"}, {"note", note}});
    }
    return rows;
}

void print(const ordered_json& rows)
{
    std::printf("%-34s %-10s %10s %12s  %s\n", "stage", "quality", "ms", "error", "error is");
    for (const auto& row : rows) {
        const auto note = row["note"].get<std::string>();
        std::printf("%-34s %-10s %10.3f %12.4g  %s%s%s\n", row["stage"].get<std::string>().c_str(),
                    row["quality"].get<std::string>().c_str(), row["ms"].get<double>(), row["error"].get<double>(),
                    row["error_is"].get<std::string>().c_str(), note.empty() ? "" : "; ", note.c_str());
    }
}

ordered_json rowsOf(const std::string& stage, bool peers)
{
    if (stage == "signals")
        return signalRows();
    if (stage == "session")
        return sessionRows();
    return stage == "statistics" ? statisticsRows(peers) : generatorRows();
}

int bench(std::vector<std::string> wanted, bool peers, const JsonTarget& target)
{
    if (wanted.empty())
        wanted = stages;
    ordered_json rows = ordered_json::array();
    for (const auto& stage : wanted)
        for (auto& row : rowsOf(stage, peers))
            rows.push_back(row);
    if (target)
        writeJson(target, {{"schema", "vis2hap.bench/1"}, {"rows", rows}});
    else
        print(rows);
    return 0;
}

}  // namespace

void addBench(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("bench", "the speed-accuracy table of this machine");
    auto wanted = std::make_shared<std::vector<std::string>>();
    auto peers = std::make_shared<bool>(false);
    auto target = std::make_shared<JsonTarget>();
    command->add_option("STAGE", *wanted, "signals, statistics, session, generators (default: all)")->check(CLI::IsMember(stages));
    command->add_flag("--peers", *peers, "time R and Python's packages on the same work beside ours");
    addJsonOption(*command, *target);
    command->callback([wanted, peers, target, &action] {
        action.surroundings = Surroundings::Offscreen;
        action.work = [=] { return bench(*wanted, *peers, *target); };
    });
}

}  // namespace study::commands
