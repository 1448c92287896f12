// vis2hap merge SHARD...: joins the shards of one run and prints what the run in one process would have printed.
#include <CLI/CLI.hpp>
#include <map>
#include <memory>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/shard_option.h"

namespace study::commands {

namespace {

struct MergeCall {
    std::vector<std::string> files;
    MergeOutput output;
};

using MergeRun = void (*)(const shards::ShardedRun& run, const MergeOutput& output);
const std::map<std::string, MergeRun> mergedCommands{
    {"bench", mergeBench}, {"power", mergePower}, {"simulate", mergeSimulate}, {"train", mergeLeaveOneOut}};

int merge(const MergeCall& call)
{
    const auto run = shards::readRun({call.files.begin(), call.files.end()}, versionText());
    const auto found = mergedCommands.find(run.command());
    if (found == mergedCommands.end())
        throw protocols::badInput({"the shards belong to the unknown command \"" + protocols::printable(run.command()) + "\"",
                                   run.files.front().string(), "shards of this program", "name other files"});
    found->second(run, call.output);
    return 0;
}

}  // namespace

void addMerge(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("merge", "join the shards of a run (--shard K/N) and print its results");
    auto call = std::make_shared<MergeCall>();
    command->add_option("SHARD", call->files, "the files of all shards of one run, in any order")->required();
    addJsonOption(*command, call->output.json);
    command->add_option("--out", call->output.out, "with shards of `simulate --in-memory`: folder for the results");
    command->callback([call, &action] { action.work = [call] { return merge(*call); }; });
}

}  // namespace study::commands
