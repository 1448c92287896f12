#include "study/bench/bench_generators.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/models/process/second_program.h"
#include "study/bench/generator_peer.h"

namespace study::bench {

namespace {

using nlohmann::ordered_json;

std::string text(const char* format, auto... values)
{
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

/// The peer's row. Our time from the same turns is in the note.
BenchRow peerRow(const char* stage, const PeerComparison& peer, const std::optional<double>& ours,
                 const std::optional<double>& theirs, const std::optional<double>& ratio)
{
    const std::string note = ratio ? text("ours in the same turns: %.2f ms; median of ten pairs", ours.value_or(0)) : peer.whyNot;
    return {stage, peer.peer, theirs, ratio, ratio ? "ours over theirs" : "", note};
}

bool isPythonTorch(const PeerComparison& peer) { return peer.peer.starts_with("python torch"); }

void addPeers(std::vector<BenchRow>& rows)
{
    for (const PeerComparison& peer : compareGeneratorPeers()) {
        rows.push_back(peerRow("training step, 8 of 128x128", peer, peer.oursTrainMs, peer.theirsTrainMs, peer.trainRatio));
        if (isPythonTorch(peer)) rows.back().promise = RatioPromise{"Python torch", 1.0, peer.trainRatio};
        rows.push_back(peerRow("networks alone, 1 of 128x128", peer, peer.oursInferMs, peer.theirsInferMs, peer.inferRatio));
        if (peer.answersApart)
            rows.back().note += "; with the same parameters the outputs differ by " + protocols::shortest(*peer.answersApart);
    }
}

BenchRow qualityRow(const ordered_json& quality)
{
    return {"photograph to height and friction",
            quality.at("quality").get<std::string>(),
            quality.at("ms_per_photograph").get<double>(),
            100 * quality.at("mean_friction_relative_error").get<double>(),
            "% of mean friction, generated against measured",
            text("heights differ by %.3f mm from accurate; photographs of 256x256 px; 128x128 px take %.1f ms",
                 quality.at("height_deviation_from_accurate_mm").get<double>(), quality.at("ms_at_128").get<double>())};
}

/// The relief against the known one of the same place.
BenchRow reliefRow(const ordered_json& quality)
{
    return {"photograph to relief",
            quality.at("quality").get<std::string>(),
            quality.at("ms_per_photograph").get<double>(),
            quality.at("relief_error_percent").get<double>(),
            "% of Sq",
            "known relief of the same place, waves up to 3 mm; time with friction"};
}

/// The same work by the networks of 0.5.0, in the same turns.
BenchRow earlierRow(const ordered_json& quality)
{
    return {"photograph of 128x128, beside 0.5.0",
            quality.at("quality").get<std::string>(),
            quality.at("ms_at_128").get<double>(),
            quality.at("ratio_at_128_to_version_0_5_0").get<double>(),
            "ours over theirs",
            "both in the same turns, median of the ratios"};
}

BenchRow memoryRow(const ordered_json& bench, const char* field, const char* photograph)
{
    return {"memory of the generators",
            "",
            {},
            bench.at(field).get<double>(),
            "MB held at most",
            std::string("after a photograph of ") + photograph};
}

}  // namespace

std::vector<BenchRow> rowsOfGenerators(const std::string& answer)
{
    std::vector<BenchRow> rows;
    try {
        const auto bench = ordered_json::parse(answer);
        const auto& qualities = bench.at("qualities");
        for (const auto& quality : qualities) rows.push_back(qualityRow(quality));
        for (const auto& quality : qualities) rows.push_back(reliefRow(quality));
        for (const auto& quality : qualities)
            if (quality.at("ratio_at_128_to_version_0_5_0").get<double>() > 0) rows.push_back(earlierRow(quality));
        rows.push_back(memoryRow(bench, "peak_mb_at_128", "128x128"));
        rows.push_back(memoryRow(bench, "peak_mb_at_largest", "the largest, 2048x2048"));
    } catch (const ordered_json::exception&) {
        throw protocols::workFailed({"vis2hap-nn answered something else", rendering::models::secondProgram(),
                                     "the numbers of its bench", "build both programs again"});
    }
    return rows;
}

std::vector<BenchRow> benchGenerators(bool peers)
{
    std::vector<BenchRow> rows = rowsOfGenerators(rendering::models::outputOfSecondProgram({"bench", "--json"}));
    if (peers) addPeers(rows);
    markFronts(rows);
    return rows;
}

}  // namespace study::bench
