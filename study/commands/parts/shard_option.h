// The options `--shard K/N` and `--shard-file FILE` of commands whose work consists of independent runs.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/commands/parts/json_output.h"
#include "study/shards/shard_file.h"

namespace CLI {
class App;
}

namespace study::commands {

struct ShardOption {
    std::string number;  ///< "K/N"; empty: the whole run
    std::string file;    ///< empty: shards::usualFileOf()

    bool isGiven() const { return !number.empty(); }
};

/// Adds both options; `option` must live until the line is parsed.
void addShardOptions(CLI::App& command, ShardOption& option);

/// The share of the work; all of it where no shard was asked for. Throws badInput for a shard together with --json, and where the
/// file cannot be written.
stats::Share shareOf(const ShardOption& option, const std::string& command, const JsonTarget& target);

/// Writes the shard and names its file on standard output.
void writeShard(const ShardOption& option, const std::string& command, nlohmann::ordered_json options,
                nlohmann::ordered_json values);

/// Where the results of a merged run go.
struct MergeOutput {
    JsonTarget json;
    std::string out;  ///< folder, for commands that write one; else empty
};

/// Print and write what the run in one process would have. Throw badInput for damaged shards and for another output.
void mergeBench(const shards::ShardedRun& run, const MergeOutput& output);
void mergePower(const shards::ShardedRun& run, const MergeOutput& output);
void mergeLeaveOneOut(const shards::ShardedRun& run, const MergeOutput& output);
void mergeSimulate(const shards::ShardedRun& run, const MergeOutput& output);

/// Throws badInput where a folder was named for results that have none.
void requireNoFolder(const MergeOutput& output);

}  // namespace study::commands
