// vis2hap protocol check FILE, and vis2hap protocol show FILE
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/making/session_plan.h"

namespace study::commands {

namespace {

constexpr int badFile = 2;  ///< exit code of bad input

struct ProtocolCall {
    std::string file;
    JsonTarget target;
};

std::vector<std::string> remarksOf(const protocols::CheckedProtocol& checked)
{
    return checked.protocol ? making::remarksOn(*checked.protocol) : std::vector<std::string>();
}

nlohmann::ordered_json jsonOf(const ProtocolCall& call, const protocols::CheckedProtocol& checked)
{
    nlohmann::ordered_json json{{"schema", "vis2hap.protocol_check/1"}, {"file", call.file}, {"sound", checked.faults.empty()}};
    json["faults"] = nlohmann::ordered_json::array();
    for (const protocols::ProtocolFault& fault : checked.faults)
        json["faults"].push_back({{"line", fault.line}, {"column", fault.column}, {"fault", fault.text}});
    json["notes"] = remarksOf(checked);
    return json;
}

/// One line a fault, in the form that editors jump to: FILE:LINE:COLUMN: text.
int check(const ProtocolCall& call)
{
    const auto checked = protocols::checkedProtocol(protocols::readProtocolText(call.file), call.file);
    if (call.target) {
        writeJson(call.target, jsonOf(call, checked));
        return checked.faults.empty() ? 0 : badFile;
    }
    for (const protocols::ProtocolFault& fault : checked.faults)
        std::printf("%s:%zu:%zu: %s\n", protocols::printable(call.file).c_str(), fault.line, fault.column,
                    protocols::printable(fault.text).c_str());
    for (const std::string& remark : remarksOf(checked))
        std::printf("%s: note: %s\n", protocols::printable(call.file).c_str(), protocols::printable(remark).c_str());
    if (checked.faults.empty())
        std::printf("%s: no fault; `vis2hap protocol show %s` draws the session\n", protocols::printable(call.file).c_str(),
                    protocols::shellWord(call.file).c_str());
    else
        std::printf("%s: %zu %s; protocols/protocol.schema.json describes each field, and protocols/examples has examples\n",
                    protocols::printable(call.file).c_str(), checked.faults.size(),
                    checked.faults.size() == 1 ? "fault" : "faults");
    return checked.faults.empty() ? 0 : badFile;
}

int show(const ProtocolCall& call)
{
    const auto plan = making::sessionPlan(protocols::readProtocol(call.file));
    if (call.target)
        writeJson(call.target, plan);
    else
        std::printf("%s", protocols::printableLines(making::textOf(plan)).c_str());
    return 0;
}

void addPart(CLI::App& protocol, Action& action, const char* name, const char* help, int (*work)(const ProtocolCall&))
{
    auto* command = protocol.add_subcommand(name, help);
    auto call = std::make_shared<ProtocolCall>();
    command->add_option("FILE", call->file, "a protocol file")->required();
    addJsonOption(*command, call->target);
    command->callback([call, work, &action] { action.work = [call, work] { return work(*call); }; });
}

}  // namespace

void addProtocol(CLI::App& app, Action& action)
{
    auto* protocol = app.add_subcommand("protocol", "check a protocol file, or show the session that it makes");
    protocol->require_subcommand(1);
    addPart(*protocol, action, "check", "every fault of the file at once, each with line and column", check);
    addPart(*protocol, action, "show", "phases, counts, minutes, the balance that is possible, and the power", show);
}

}  // namespace study::commands
