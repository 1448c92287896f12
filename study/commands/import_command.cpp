// vis2hap import KIND FROM... --out DIR [--fabric ID]
#include "protocols/errors.h"
#include "rendering/fabrics/import.h"
#include "study/commands/command_line.h"
#include "study/commands/picture_decoder.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>

namespace study::commands {

namespace {

struct ImportCall {
    std::string kind;
    std::vector<std::string> from;
    std::string out;
    std::string fabric;
};

int import(const ImportCall& call)
{
    rendering::fabrics::ImportRequest request;
    request.kind = rendering::fabrics::importKindNamed(call.kind);
    request.from.assign(call.from.begin(), call.from.end());
    request.out = call.out;
    if (!call.fabric.empty())
        request.fabric = protocols::FabricId(call.fabric);
    request.decodeOther = decodeByQt;
    for (const auto& line : rendering::fabrics::importRecordings(request))
        std::printf("%s\n", line.c_str());
    return 0;
}

}  // namespace

void addImport(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("import", "real recordings into a data set");
    auto call = std::make_shared<ImportCall>();
    command->add_option("KIND", call->kind, "photos, gelsight, friction-csv, tribometer, labview or slide")->required();
    command->add_option("FROM", call->from, "files or folders")->required();
    command->add_option("--out", call->out, "the data set; an existing one is added to")->required();
    command->add_option("--fabric", call->fabric, "put everything into this fabric, e.g. F03");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;  // Qt finds its JPEG reader through the application
        action.work = [call] { return import(*call); };
    });
}

}  // namespace study::commands
