#include "study/commands/parts/json_output.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"

namespace study::commands {

void addJsonOption(CLI::App& command, JsonTarget& target)
{
    command
        .add_option_function<std::vector<std::string>>(
            "--json", [&target](const std::vector<std::string>& values) { target = values.empty() ? "" : values.front(); },
            "print one JSON object instead of text, or write it to FILE")
        ->expected(0, 1)
        ->type_name("[FILE]")
        ->trigger_on_parse();
}

void writeJson(const JsonTarget& target, const nlohmann::ordered_json& object)
{
    const std::string text = object.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (target->empty())
        std::fputs(text.c_str(), stdout);
    else
        protocols::writeWholeFile(*target, text);
}

}  // namespace study::commands
