#include "study/commands/parts/safe_outputs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "protocols/files/errors.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;

struct Paths {
    std::vector<std::string> outputs, inputs;
};

void addPaths(const CLI::App& command, Paths& paths)
{
    std::set<std::string> outputs{"out", "json", "csv", "shard-file", "sheet", "picture", "svg", "page", "plots"};
    if (command.get_name() == "new") outputs.insert("images");  // `server roles --images` takes a word
    for (const CLI::Option* option : command.get_options()) {
        const auto& names = option->get_lnames();
        const auto has = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
        if (option->count() == 0 || has("resume")) continue;  // a resumed shard goes on in its own file
        auto& list = std::ranges::any_of(outputs, has) ? paths.outputs : paths.inputs;
        for (const std::string& value : option->results())
            if (!value.empty()) list.push_back(value);
    }
    for (const CLI::App* sub : command.get_subcommands()) addPaths(*sub, paths);
}

/// The study folder that holds the path or is the path; empty for none.
fs::path studyAround(const fs::path& path)
{
    std::error_code unknown;
    for (fs::path folder = fs::weakly_canonical(fs::absolute(path, unknown), unknown); !unknown; folder = folder.parent_path()) {
        const auto has = [&](const char* name) { return fs::is_regular_file(folder / name, unknown); };
        if (has("study.db") || (has("server.json") && has("protocol.json"))) return folder;  // the second: on a server
        if (folder == folder.parent_path()) break;
        unknown.clear();
    }
    return {};
}

bool isSameFile(const std::string& one, const std::string& other)
{
    std::error_code missing;
    return fs::is_regular_file(one, missing) && fs::equivalent(one, other, missing) && !missing;
}

/// Whether the input is a data set and the output a file of it.
bool isFileOfDataset(const std::string& output, const std::string& input)
{
    std::error_code missing;
    if (!fs::is_regular_file(output, missing) || !fs::is_regular_file(fs::path(input) / "dataset.json", missing)) return false;
    const fs::path dataset = fs::canonical(input, missing), file = fs::canonical(output, missing);
    return !missing && std::ranges::mismatch(dataset, file).in1 == dataset.end();
}

}  // namespace

void requireFilledArguments(const CLI::App& app)
{
    for (const CLI::Option* option : app.get_options()) {
        const bool mayBeEmpty = option->get_expected_min() == 0;  // such as --json without the name of a file
        if (option->count() == 0 || mayBeEmpty) continue;
        if (std::ranges::any_of(option->results(), [](const std::string& value) { return value.empty(); }))
            throw protocols::badInput({option->get_name() + " is given, and empty", app.get_name(), "a value",
                                       "is a variable of the shell not set? Set it, or leave the argument out"});
    }
    for (const CLI::App* sub : app.get_subcommands()) requireFilledArguments(*sub);
}

void requireSafeOutputs(const CLI::App& app)
{
    Paths paths;
    addPaths(app, paths);
    for (const std::string& output : paths.outputs) {
        if (const fs::path study = studyAround(output); !study.empty())
            throw protocols::badInput({"the output would lie in the study folder", output, "a place outside " + study.string(),
                                       "choose another folder; nothing was written"});
        const auto isRead = [&](const std::string& input) { return isSameFile(output, input) || isFileOfDataset(output, input); };
        if (std::ranges::any_of(paths.inputs, isRead))
            throw protocols::badInput({"the output would replace a file that the command reads", output,
                                       "the name of another file", "choose another name; nothing was written"});
    }
}

}  // namespace study::commands
