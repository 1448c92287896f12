// vis2hap analyse: requests in one JSON file, answers in another.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "study/analyse/analyse.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"

namespace study::commands {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

protocols::Error malformed(const std::string& what, const std::string& where)
{
    return protocols::badInput({what, where, "{\"cases\":[{\"id\":...,\"analysis\":...,\"inputs\":{...},\"options\":{...}}]}",
                                "correct the request file"});
}

json readRequests(const std::string& file)
{
    json document = protocols::parseStrictJson(protocols::readWholeFile(file), file);
    if (!document.is_object() || !document.contains("cases") || !document["cases"].is_array())
        throw malformed("the file has no array of cases", file);
    return document;
}

/// The ids of all cases. Each id must be unique, because the answers are stored by id.
std::vector<std::string> idsOf(const json& cases, const std::string& file)
{
    std::vector<std::string> ids;
    std::set<std::string> seen;
    for (const json& one : cases) {
        const std::string where = file + ", case " + std::to_string(ids.size() + 1);
        if (!one.is_object() || !one.contains("id") || !one["id"].is_string()) throw malformed("the case has no id", where);
        ids.push_back(one["id"].get<std::string>());
        if (!seen.insert(ids.back()).second) throw malformed("the id " + ids.back() + " is used twice", where);
    }
    return ids;
}

int analyse(const std::string& requests, const std::string& answers)
{
    const json document = readRequests(requests);
    const json& cases = document["cases"];
    const auto ids = idsOf(cases, requests);
    const auto folder = std::filesystem::absolute(requests).parent_path();
    ordered_json all = ordered_json::object();
    for (std::size_t i = 0; i < ids.size(); ++i) all[ids[i]] = analyse::answerOf(cases[i], folder);
    protocols::writeWholeFile(answers, all.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
    return 0;
}

int printList()
{
    std::cout << analyse::listOfAnalyses();
    return 0;
}

}  // namespace

void addAnalyse(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("analyse", "answer a file of requests for statistical analyses");
    auto requests = std::make_shared<std::string>();
    auto answers = std::make_shared<std::string>();
    auto list = std::make_shared<bool>(false);
    command->add_flag("--list", *list, "print all analyses with their inputs and options");
    command->add_option("REQUESTS", *requests, "JSON file with the requests");
    command->add_option("--out", *answers, "JSON file to write the answers to");
    command->callback([requests, answers, list, &action] {
        if (*list)
            action.work = printList;
        else if (requests->empty())
            throw CLI::RequiredError("REQUESTS");
        else if (answers->empty())
            throw CLI::RequiredError("--out");
        else
            action.work = [requests, answers] { return analyse(*requests, *answers); };
    });
}

}  // namespace study::commands
