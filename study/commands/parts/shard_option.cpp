#include "study/commands/parts/shard_option.h"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "study/commands/parts/version_text.h"

namespace study::commands {

namespace {

std::filesystem::path fileOf(const ShardOption& option, const std::string& command, const stats::Share& share)
{
    return option.file.empty() ? shards::usualFileOf(command, share) : std::filesystem::path(option.file);
}

}  // namespace

void addShardOptions(CLI::App& command, ShardOption& option)
{
    auto* number = command.add_option(
        "--shard", option.number, "do part K of N of the work and keep its values in a file; `vis2hap merge` joins all parts");
    number->type_name("K/N");
    command
        .add_option("--shard-file", option.file,
                    "the file of the shard (default: " + command.get_name() + "-K-of-N.json in this folder)")
        ->type_name("FILE")
        ->needs(number);
}

stats::Share shareOf(const ShardOption& option, const std::string& command, const JsonTarget& target)
{
    if (!option.isGiven()) return {};
    const stats::Share share = shards::shareNamed(option.number);
    if (target)
        throw protocols::badInput({"--json was given together with --shard", command, "a shard's own file, by --shard-file",
                                   "leave --json out, and give it to `vis2hap merge`"});
    protocols::requireWritable(fileOf(option, command, share));
    return share;
}

void requireNoFolder(const MergeOutput& output)
{
    if (!output.out.empty())
        throw protocols::badInput({"these shards have no folder of results", "--out " + output.out,
                                   "their text, or one object by --json", "leave --out out"});
}

void writeShard(const ShardOption& option, const std::string& command, nlohmann::ordered_json options,
                nlohmann::ordered_json values)
{
    const stats::Share share = shards::shareNamed(option.number);
    const std::filesystem::path file = fileOf(option, command, share);
    shards::writeShard(file, {versionText(), command, std::move(options), share, std::move(values)});
    std::printf("wrote shard %s to %s; join all shards with `vis2hap merge`\n", shards::textOf(share).c_str(),
                protocols::printable(file.string()).c_str());
}

}  // namespace study::commands
