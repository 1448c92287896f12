#include "study/bench/bench.h"

#include <cmath>
#include <cstdio>

#include "protocols/files/errors.h"
#include "study/bench/bench_fabrics.h"
#include "study/bench/bench_generators.h"
#include "study/bench/bench_models.h"
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

/// Sq of the known weave by the peer, against that of its exact heights.
std::string knownSqDifference(double sqMm)
{
    char text[80];
    std::snprintf(text, sizeof text, "; Sq of its surface differs by %.1e from the exact one",
                  std::abs(sqMm / knownWeaveSqMm() - 1));
    return text;
}

/// Adds a row for each peer, and the promise about the integration to our own row.
void addSignalPeers(std::vector<BenchRow>& rows)
{
    const std::string promised = "integration 480x640";
    for (const auto& [stage, peers] : signalPeers())
        for (const auto& [peer, result] : peers) {
            const auto& ms = result.milliseconds;
            if (stage == promised)
                for (BenchRow& row : rows)
                    if (row.stage == stage && row.quality == "fast")
                        row.promise = RatioPromise{peer, 0.5, ms ? std::optional(*row.milliseconds / *ms) : std::nullopt};
            BenchRow theirs{stage, peer, ms, {}, "", ms ? "the same work and input, one thread, in this run" : "not installed"};
            if (result.answer) theirs.note += knownSqDifference(*result.answer);
            rows.push_back(theirs);
        }
}

void addRecordings(std::vector<BenchRow>& rows, const BenchOptions& options)
{
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
        {"perception", [](const BenchOptions&) { return benchPerception(); }},
        {"fabrics", [](const BenchOptions&) { return benchFabrics(); }},
        {"statistics", [](const BenchOptions& options) { return benchStatistics(options.peers); }},
        {"session", [](const BenchOptions& options) { return benchSession(options.peers); }},
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

void requireRecordings(const std::filesystem::path& folder)
{
    if (!std::filesystem::is_directory(folder))
        throw protocols::badInput({"there is no folder of recordings", folder.string(),
                                   "the folders that README describes under \"Bench on recordings\"",
                                   "check the path of --data"});
}

std::vector<BenchRow> benchStage(const std::string& stage, const BenchOptions& options)
{
    for (const auto& one : stages())
        if (one.name == stage) {
            if (stage != "signals") begin(options, stage);  // which names its parts itself
            return one.run(options);
        }
    throw protocols::badInput({"there is no stage " + stage, "bench",
                               "signals, perception, fabrics, statistics, session or generators", "check the spelling"});
}

}  // namespace study::bench
