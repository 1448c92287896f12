// vis2hap bench: speed and error of every stage that has a fast and an accurate way.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "protocols/files/errors.h"
#include "rendering/models/second_program.h"
#include "study/bench/bench.h"
#include "study/bench/bench_recordings.h"
#include "study/bench/bench_session.h"
#include "study/bench/bench_statistics.h"
#include "study/bench/generator_peer.h"
#include "study/bench/peer_programs.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/looking/picture_decoder.h"

namespace study::commands {

namespace {

using nlohmann::ordered_json;

const std::vector<std::string> stages{"signals", "statistics", "session", "generators"};

struct BenchCall {
    std::vector<std::string> wanted;
    bool peers = false;
    std::string data;
    JsonTarget target;
};

ordered_json jsonOf(const bench::BenchRow& row)
{
    return {{"stage", row.stage}, {"quality", row.quality},    {"ms", row.milliseconds},
            {"error", row.error}, {"error_is", row.errorUnit}, {"note", row.note}};
}

/// What the folder lacks is said at once, on standard error.
void addRecordings(ordered_json& rows, const std::string& folder)
{
    if (!std::filesystem::is_directory(folder))
        throw protocols::badInput(
            {"the folder of recordings is not there", folder, "a folder laid out as README, \"Bench on recordings\", says", ""});
    const auto recordings = bench::benchRecordings(folder, looking::decodeByQt);
    for (const auto& line : recordings.skipped) std::fprintf(stderr, "skipped: %s\n", line.c_str());
    for (const auto& row : recordings.rows) rows.push_back(jsonOf(row));
}

ordered_json signalRows(const BenchCall& call)
{
    ordered_json rows = ordered_json::array();
    for (const auto& row : bench::benchSignals()) rows.push_back(jsonOf(row));
    if (call.peers)
        for (const auto& [stage, times] : bench::signalPeerTimes())
            for (const auto& [peer, milliseconds] : times)
                rows.push_back({{"stage", stage},
                                {"quality", peer},
                                {"ms", milliseconds ? ordered_json(*milliseconds) : ordered_json()},
                                {"error", nullptr},
                                {"error_is", ""},
                                {"note", milliseconds ? "the same work, one thread, in this run" : "not installed"}});
    if (!call.data.empty()) addRecordings(rows, call.data);
    return rows;
}

/// Two rows a peer, and ours as it ran in the same turns.
void addGeneratorPeers(ordered_json& rows)
{
    const auto add = [&](const char* stage, const bench::PeerComparison& peer, const std::optional<double>& ours,
                         const std::optional<double>& theirs, const std::optional<double>& ratio) {
        const auto number = [](const std::optional<double>& value) { return value ? ordered_json(*value) : ordered_json(); };
        char note[160];
        std::snprintf(note, sizeof note, "ours in the same turns: %.2f ms; median of ten pairs", ours.value_or(0));
        rows.push_back({{"stage", stage},
                        {"quality", peer.peer},
                        {"ms", number(theirs)},
                        {"error", number(ratio)},
                        {"error_is", ratio ? "ours over theirs" : ""},
                        {"note", ratio ? std::string(note) : peer.whyNot}});
    };
    for (const bench::PeerComparison& peer : bench::compareGeneratorPeers()) {
        add("training step, 8 of 128x128", peer, peer.oursTrainMs, peer.theirsTrainMs, peer.trainRatio);
        add("networks alone, 1 of 128x128", peer, peer.oursInferMs, peer.theirsInferMs, peer.inferRatio);
        if (peer.answersApart)
            rows.back()["note"] =
                rows.back()["note"].get<std::string>() + "; same parameters, answers apart by " + numberText(*peer.answersApart);
    }
}

ordered_json generatorRows(bool peers)
{
    const auto bench = ordered_json::parse(rendering::models::outputOfSecondProgram({"bench", "--json"}));
    ordered_json rows = ordered_json::array();
    for (const auto& quality : bench["qualities"]) {
        char note[160];
        std::snprintf(note, sizeof note, "heights off by %.3f mm from accurate, photographs of 256x256; %.1f ms of 128x128",
                      quality["height_deviation_from_accurate_mm"].get<double>(), quality["ms_at_128"].get<double>());
        rows.push_back({{"stage", "photograph to height and friction"},
                        {"quality", quality["quality"]},
                        {"ms", quality["ms_per_photograph"]},
                        {"error", 100 * quality["mean_friction_relative_error"].get<double>()},
                        {"error_is", "% of mean friction, generated against measured"},
                        {"note", note}});
    }
    for (const auto& [field, picture] :
         {std::pair{"peak_mb_at_128", "128x128"}, {"peak_mb_at_largest", "the largest, 2048x2048"}})
        rows.push_back({{"stage", "memory of the generators"},
                        {"quality", ""},
                        {"ms", nullptr},
                        {"error", bench[field]},
                        {"error_is", "MB held at most"},
                        {"note", std::string("after a photograph of ") + picture}});
    if (peers) addGeneratorPeers(rows);
    return rows;
}

std::string cell(const ordered_json& number, const char* format)
{
    char text[40] = "";
    if (!number.is_null()) std::snprintf(text, sizeof text, format, number.get<double>());
    return text;
}

void print(const ordered_json& rows)
{
    std::printf("%-34s %-10s %10s %12s  %s\n", "stage", "quality", "ms", "error", "error is");
    for (const auto& row : rows) {
        const auto note = row["note"].get<std::string>();
        const auto unit = row["error_is"].get<std::string>();
        std::printf("%-34s %-10s %10s %12s  %s%s%s\n", row["stage"].get<std::string>().c_str(),
                    row["quality"].get<std::string>().c_str(), cell(row["ms"], "%.3f").c_str(),
                    cell(row["error"], "%.4g").c_str(), unit.c_str(), unit.empty() || note.empty() ? "" : "; ", note.c_str());
    }
}

ordered_json rowsOf(const std::string& stage, const BenchCall& call)
{
    if (stage == "signals") return signalRows(call);
    if (stage == "session") return bench::sessionRows();
    return stage == "statistics" ? bench::statisticsRows(call.peers) : generatorRows(call.peers);
}

int bench(const BenchCall& call)
{
    ordered_json rows = ordered_json::array();
    for (const auto& stage : call.wanted.empty() ? stages : call.wanted)
        for (auto& row : rowsOf(stage, call)) rows.push_back(row);
    if (call.target)
        writeJson(call.target, {{"schema", "vis2hap.bench/1"}, {"rows", rows}});
    else
        print(rows);
    return 0;
}

}  // namespace

void addBench(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("bench", "the speed-accuracy table of this machine");
    auto call = std::make_shared<BenchCall>();
    command->add_option("STAGE", call->wanted, "signals, statistics, session, generators (default: all)")
        ->check(CLI::IsMember(stages));
    command->add_flag("--peers", call->peers, "time R and Python's packages on the same work beside ours");
    command->add_option("--data", call->data, "a folder of recordings: the signal stages on them, against what is known of each");
    addJsonOption(*command, call->target);
    command->callback([call, &action] {
        action.surroundings = Surroundings::Offscreen;
        action.work = [call] { return bench(*call); };
    });
}

}  // namespace study::commands
