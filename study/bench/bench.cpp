#include "study/bench/bench.h"

#include "protocols/files/errors.h"
#include "study/bench/bench_fabrics.h"
#include "study/bench/bench_generators.h"
#include "study/bench/bench_recordings.h"
#include "study/bench/bench_session.h"
#include "study/bench/bench_signals.h"
#include "study/bench/bench_statistics.h"
#include "study/bench/peer_programs.h"
#include "study/looking/picture_decoder.h"

namespace study::bench {

namespace {

void begin(const BenchOptions& options, const std::string& part)
{
    if (options.begins) options.begins(part);
}

void addSignalPeers(std::vector<BenchRow>& rows)
{
    for (const auto& [stage, times] : signalPeerTimes())
        for (const auto& [peer, milliseconds] : times)
            rows.push_back(
                {stage, peer, milliseconds, {}, "", milliseconds ? "the same work, one thread, in this run" : "not installed"});
}

void addRecordings(std::vector<BenchRow>& rows, const BenchOptions& options)
{
    if (!std::filesystem::is_directory(options.recordings))
        throw protocols::badInput({"there is no folder of recordings", options.recordings.string(),
                                   "the folders that README describes under \"Bench on recordings\"",
                                   "check the path of --data"});
    auto recordings = benchRecordings(options.recordings, looking::decodeByQt, options.begins);
    if (options.skipped)
        for (const auto& line : recordings.skipped) options.skipped(line);
    for (auto& row : recordings.rows) rows.push_back(std::move(row));
}

std::vector<BenchRow> signalStage(const BenchOptions& options)
{
    begin(options, "signals: known surfaces and traces");
    auto rows = benchSignals();
    if (options.peers) {
        begin(options, "signals: other programs");
        addSignalPeers(rows);
    }
    if (!options.recordings.empty()) addRecordings(rows, options);
    return rows;
}

struct NamedStage {
    std::string name;
    std::vector<BenchRow> (*run)(const BenchOptions&);
};

const std::vector<NamedStage>& stages()
{
    static const std::vector<NamedStage> all{
        {"signals", signalStage},
        {"fabrics", [](const BenchOptions&) { return benchFabrics(); }},
        {"statistics", [](const BenchOptions& options) { return benchStatistics(options.peers); }},
        {"session", [](const BenchOptions&) { return benchSession(); }},
        {"generators", [](const BenchOptions& options) { return benchGenerators(options.peers); }}};
    return all;
}

}  // namespace

const std::vector<std::string>& benchStages()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& stage : stages()) all.push_back(stage.name);
        return all;
    }();
    return names;
}

std::vector<BenchRow> benchStage(const std::string& stage, const BenchOptions& options)
{
    for (const auto& one : stages())
        if (one.name == stage) {
            if (stage != "signals") begin(options, stage);  // which names its parts itself
            return one.run(options);
        }
    throw protocols::badInput(
        {"there is no stage " + stage, "bench", "signals, fabrics, statistics, session or generators", "check the spelling"});
}

}  // namespace study::bench
