// vis2hap analyse: requests in one JSON file, answers in another.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "study/analyse/analyse.h"
#include "study/analyse/request_file.h"
#include "study/commands/command_line.h"

namespace study::commands {

namespace {

int analyse(const std::string& requests, const std::string& answers)
{
    const auto folder = std::filesystem::absolute(requests).parent_path();
    const auto all = analyse::answersTo(protocols::readWholeFile(requests, protocols::largestJson), requests, folder);
    protocols::writeWholeFile(answers, all.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
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
