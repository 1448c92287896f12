// The file of a shard: what one of several processes computed of a run. `vis2hap merge` joins the shards of a run.
//   {"schema":"vis2hap.shard/1","program":"vis2hap X.Y.Z","command":"power","options":{...},"shard":K,"shards":N,
//    "values":{...},"sha256":"..."}
// "options" hold everything that the result depends on, with the content of files instead of their names. "sha256" is that of all
// other members, as JSON with sorted keys and without spaces.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "stats/kernels/share.h"

namespace study::shards {

/// Most shards of a run.
inline constexpr std::size_t mostShards = 100000;
/// Largest file of a shard, bytes.
inline constexpr std::uint64_t largestShard = std::uint64_t{1} << 27;

struct Shard {
    std::string program;  ///< name and version
    std::string command;
    nlohmann::ordered_json options;
    stats::Share share;
    nlohmann::ordered_json values;
};

/// "3/16" is part 2 of 16. Throws badInput.
stats::Share shareNamed(std::string_view text);
/// "3/16"
std::string textOf(const stats::Share& share);
/// The file in the current folder where the user names none: "power-3-of-16.json".
std::filesystem::path usualFileOf(const std::string& command, const stats::Share& share);

/// Writes the whole file or nothing. Throws environmentFault.
void writeShard(const std::filesystem::path& file, const Shard& shard);

/// Throws badInput for a text that writeShard() did not write, and for an altered one. `where` names the file.
Shard shardFrom(std::string_view text, const std::string& where);

/// The shards of one run with their files.
struct ShardedRun {
    std::vector<std::filesystem::path> files;
    std::vector<Shard> shards;  ///< all of the run, in the order of their numbers

    const std::string& command() const { return shards.front().command; }
    const nlohmann::ordered_json& options() const { return shards.front().options; }
};

/// Reads the shards of one run, in any order. Throws badInput where a file is damaged, belongs to another run or to another
/// version than `program`, or where a shard is missing or doubled.
ShardedRun readRun(const std::vector<std::filesystem::path>& files, const std::string& program);

}  // namespace study::shards
