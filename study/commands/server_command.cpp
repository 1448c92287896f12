// vis2hap study move FROM TO, vis2hap study join ADDRESS [FOLDER], and vis2hap server roles|status ADDRESS
#include <CLI/CLI.hpp>
#include <memory>

#include "study/commands/command_line.h"
#include "study/commands/server/server_work.h"

namespace study::commands {

namespace {

struct RolesCall {
    std::string address;
    std::vector<std::string> logins;
    std::string imagesTo;
    bool releasesHeld = false;
};

void addStationOption(CLI::App& command, const std::shared_ptr<std::string>& station)
{
    command.add_option("--station", *station, "name of this station in the study (default: the computer's name)");
}

}  // namespace

void addMove(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("move", "move a study from its folder to a server, or back");
    auto from = std::make_shared<std::string>(), to = std::make_shared<std::string>(), station = std::make_shared<std::string>();
    command->add_option("FROM", *from, "the study's folder, or its address on the server")->required();
    command->add_option("TO", *to, "the address postgresql://USER@HOST/DATABASE?study=NAME, or the study's folder")->required();
    addStationOption(*command, station);
    auto givenUp = std::make_shared<std::vector<std::string>>();
    command
        ->add_option("--lose-answers-at", *givenUp,
                     "STATION: bring the study back although this station is away and holds a participant; answers that wait "
                     "there are lost to the study; may be repeated")
        ->allow_extra_args(false);
    command->callback([from, to, station, givenUp, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [from, to, station, givenUp] { return moveStudy(*from, *to, *station, *givenUp); };
    });
}

void addJoin(CLI::App& study, Action& action)
{
    auto* command = study.add_subcommand("join", "make the folder of a station for a study on a server");
    auto address = std::make_shared<std::string>(), folder = std::make_shared<std::string>(),
         station = std::make_shared<std::string>();
    command->add_option("ADDRESS", *address, "postgresql://USER@HOST/DATABASE?study=NAME")->required();
    command->add_option("FOLDER", *folder,
                        "folder to make, or a station's folder that takes the address (default: the study's name)");
    addStationOption(*command, station);
    command->callback([address, folder, station, &action] {
        action.surroundings = Surroundings::Core;
        action.handlesStudy = true;
        action.work = [address, folder, station] { return joinAsStation(*address, *folder, *station); };
    });
}

void addServer(CLI::App& app, Action& action)
{
    auto* server = app.add_subcommand("server", "prepare a server that several stations share");
    server->require_subcommand(1);
    auto* command = server->add_subcommand(
        "roles",
        "make the roles of a study: experimenter, monitor, analyst, display; grant them to logins that the server knows");
    auto call = std::make_shared<RolesCall>();
    command->add_option("ADDRESS", call->address, "postgresql://OWNER@HOST/DATABASE?study=NAME")->required();
    command->add_option("--grant", call->logins, "LOGIN=ROLE: experimenter, monitor, analyst or display; may be repeated")
        ->allow_extra_args(false);
    command
        ->add_option("--images", call->imagesTo,
                     "who gets the images: station (default), or display: stations then get tickets, see vis2hap display serve")
        ->check(CLI::IsMember({"station", "display"}));
    command->add_flag("--release-held", call->releasesHeld,
                      "give out again slots of participants who withdrew at a station, and presentations after three voids in a "
                      "row; prints whom it concerns");
    command->callback([call, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [call] { return grantRoles(call->address, call->logins, call->imagesTo, call->releasesHeld); };
    });
    auto* statusCommand = server->add_subcommand("status", "show progress and stations, for monitors, analysts and the owner");
    auto address = std::make_shared<std::string>();
    statusCommand->add_option("ADDRESS", *address, "postgresql://USER@HOST/DATABASE?study=NAME")->required();
    statusCommand->callback([address, &action] {
        action.surroundings = Surroundings::Core;
        action.work = [address] { return showServer(*address); };
    });
}

}  // namespace study::commands
