// vis2hap bench: speed and error of every stage.
#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/bench/bench.h"
#include "study/bench/cost_curves.h"
#include "study/bench/extremes/extremes_page.h"
#include "study/bench/machine.h"
#include "study/bench/preset_choice.h"
#include "study/bench/trade_picture.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/shard_option.h"

namespace study::commands {

namespace {

struct BenchCall {
    std::vector<std::string> stages;
    bench::BenchOptions options;
    JsonTarget target;
    bool choose = false;
    std::filesystem::path svg, page;
    ShardOption shard;
};

constexpr const char* extremes = "extremes";
constexpr const char* curves = "curves";
constexpr double noisyPercent = 10;

/// The part of the work that runs, and the time since the beginning: one line that changes on a terminal, else plain lines.
class RunningPart {
public:
    ~RunningPart() { clear(); }

    void show(const std::string& part)
    {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - m_start);
        std::fprintf(stderr, m_terminal ? "\r\033[Kbench: %s (%lld s so far)" : "bench: %s (%lld s so far)\n", part.c_str(),
                     static_cast<long long>(seconds.count()));
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

std::size_t terminalColumns()
{
    winsize size{};
    return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 40 ? size.ws_col : 120;
}

/// The stages that a call names: all of them for none, and those that presets come from for --choose.
std::vector<std::string> stagesOf(const BenchCall& call)
{
    if (call.choose) return {"signals", "generators"};
    if (!call.stages.empty()) return call.stages;
    auto all = bench::benchStages();
    all.push_back(curves);
    return all;
}

struct Measured {
    std::vector<bench::BenchRow> rows;
    std::vector<bench::CostCurve> curves;
};

Measured measure(const BenchCall& call, const bench::BenchOptions& options)
{
    Measured measured;
    for (const auto& stage : stagesOf(call))
        if (stage == curves)
            measured.curves = bench::costCurves(options.begins);
        else
            for (auto& row : bench::benchStage(stage, options)) measured.rows.push_back(std::move(row));
    bench::markFronts(measured.rows);
    return measured;
}

/// The sentence about the machine below the table.
std::string machineLine(const std::vector<bench::BenchRow>& rows)
{
    std::string line = bench::machineInWords() + ".";
    const auto spread = bench::spreadPercent(rows);
    if (!spread) return line + "\n";
    char text[240];
    std::snprintf(
        text, sizeof text, " Half the distance of the quartiles is %.1f %% of the time (median over the rows).%s", *spread,
        *spread > noisyPercent ? "\nWarning: this machine is noisy now. Compare ratios within a stage only, or run again when "
                                 "nothing else runs."
                               : "");
    return line + text + "\n";
}

nlohmann::ordered_json jsonOf(const Measured& measured)
{
    auto table = nlohmann::ordered_json::array(), grown = nlohmann::ordered_json::array();
    for (const auto& row : measured.rows) table.push_back(bench::jsonOf(row));
    for (const auto& curve : measured.curves) grown.push_back(bench::jsonOf(curve));
    const auto spread = bench::spreadPercent(measured.rows);
    nlohmann::ordered_json json{{"schema", "vis2hap.bench/2"},
                                {"machine", bench::machineInWords()},
                                {"spread_percent", spread ? nlohmann::ordered_json(*spread) : nlohmann::ordered_json()},
                                {"noisy", spread.value_or(0) > noisyPercent},
                                {"rows", table},
                                {"curves", grown}};
    if (!spread) json["why"] = {{"spread_percent", "no stage was timed several times"}};
    return json;
}

void print(const Measured& measured)
{
    if (!measured.rows.empty())
        std::printf("%s%s\n%s", bench::tableOf(measured.rows).c_str(), machineLine(measured.rows).c_str(),
                    bench::tradeInCharacters(measured.rows, terminalColumns()).c_str());
    if (!measured.curves.empty()) std::printf("\n%s", bench::tableOf(measured.curves).c_str());
}

int runExtremes(const BenchCall& call, const bench::BenchOptions& options, RunningPart& running)
{
    const auto results = bench::runExtremes(options.peers, options.begins);
    running.clear();
    const auto machine = bench::machineInWords();
    if (!call.page.empty()) protocols::writeWholeFile(call.page, bench::extremesPage(results, machine, options.peers));
    if (call.target)
        writeJson(call.target, bench::extremesJson(results, machine));
    else
        std::fputs(bench::extremesText(results).c_str(), stdout);
    return bench::allReached(results) ? 0 : 1;
}

constexpr const char* benchName = "bench";

/// Whole curves of one machine: times of different machines do not belong into one table.
int runShardOfCurves(const BenchCall& call)
{
    if (call.stages != std::vector<std::string>{curves})
        throw protocols::badInput(
            {"only cost curves have shards", benchName, "vis2hap bench curves --shard K/N", "name the stage curves alone"});
    const stats::Share share = shareOf(call.shard, benchName, call.target);
    auto values = nlohmann::ordered_json::array();
    RunningPart running;
    for (const auto& curve : bench::costCurves([&running](const std::string& part) { running.show(part); }, share))
        values.push_back(bench::jsonOf(curve));
    running.clear();
    writeShard(call.shard, benchName,
               {{"stage", curves}, {"machine", bench::machineInWords()}, {"processor", bench::processorHash()}},
               {{"curves", values}});
    return 0;
}

int runBench(const BenchCall& call)
{
    if (call.shard.isGiven()) return runShardOfCurves(call);
    for (const auto& file : {call.svg, call.page})
        if (!file.empty()) protocols::requireWritable(file);
    auto options = call.options;
    if (!options.recordings.empty()) bench::requireRecordings(options.recordings);
    RunningPart running;
    options.begins = [&running](const std::string& part) { running.show(part); };
    options.skipped = [&running](const std::string& line) {
        running.clear();
        std::fprintf(stderr, "skipped: %s\n", line.c_str());
    };
    if (call.stages == std::vector<std::string>{extremes}) return runExtremes(call, options, running);
    const Measured measured = measure(call, options);
    running.clear();
    if (!call.svg.empty())
        protocols::writeWholeFile(call.svg, bench::tradeSvg(measured.rows, measured.curves, bench::machineInWords()));
    if (call.target)
        writeJson(call.target, jsonOf(measured));
    else if (call.choose)
        std::printf("%s%s", bench::choiceText(measured.rows).c_str(), machineLine(measured.rows).c_str());
    else
        print(measured);
    return 0;
}

/// The call's contradictions, as CLI11 reports them.
void requireSensible(const BenchCall& call)
{
    const bool asksForExtremes = std::find(call.stages.begin(), call.stages.end(), extremes) != call.stages.end();
    if (asksForExtremes && call.stages.size() > 1) throw CLI::ValidationError("extremes has a table of its own: name it alone");
    if (asksForExtremes && !call.svg.empty()) throw CLI::ValidationError("extremes has no picture: use --page FILE.html");
    if (!asksForExtremes && !call.page.empty()) throw CLI::ValidationError("--page belongs to vis2hap bench extremes");
    if (call.choose && !call.stages.empty())
        throw CLI::ValidationError("--choose measures the stages that presets fix: name none");
}

}  // namespace

void mergeBench(const shards::ShardedRun& run, const MergeOutput& output)
{
    requireNoFolder(output);
    std::string machine;
    Measured measured;
    try {
        machine = run.options().at("machine").get<std::string>();
        for (std::size_t i = 0; i < bench::costCurveCount(); ++i) {
            const std::size_t shard = i % run.shards.size();
            measured.curves.push_back(
                bench::curveFrom(run.shards[shard].values.at("curves").at(i / run.shards.size()), run.files[shard].string()));
        }
    } catch (const nlohmann::ordered_json::exception&) {
        throw protocols::badInput({"the shards do not hold every cost curve", run.files.front().string(),
                                   "shards as `vis2hap bench curves` writes them", "run the shards again"});
    }
    if (!output.json) return print(measured);
    auto json = jsonOf(measured);
    json["machine"] = machine;
    writeJson(output.json, json);
}

void addBench(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("bench", "print speed and error of every stage on this machine");
    auto call = std::make_shared<BenchCall>();
    auto stages = bench::benchStages();
    for (const char* more : {curves, extremes}) stages.push_back(more);
    command
        ->add_option("STAGE", call->stages,
                     "signals, perception, fabrics, statistics, session, generators, curves (default: all of these); extremes: "
                     "extreme inputs beside their known results")
        ->check(CLI::IsMember(stages));
    command->add_flag("--peers", call->options.peers, "also time R and packages of Python on the same work");
    command->add_option("--data", call->options.recordings,
                        "folder of recordings: also run the signal stages on them and compare with known values");
    command->add_option("--svg", call->svg, "also write the picture of time and error as an SVG file");
    command->add_flag(
        "--choose", call->choose,
        "print the settings of fast, balanced and accurate that the rule would choose on this machine; changes nothing");
    command->add_option("--page", call->page, "with extremes: also write the table as a page (HTML)");
    addJsonOption(*command, call->target);
    addShardOptions(*command, call->shard);
    command->callback([call, &action] {
        requireSensible(*call);
        action.surroundings = Surroundings::SeenIfPossible;
        action.work = [call] { return runBench(*call); };
    });
}

}  // namespace study::commands
