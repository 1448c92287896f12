// vis2hap power: the effects that a planned study can detect, before any participant takes part. With --calibrate: how often
// each test of the report rejects in studies without a difference. With --planted: how often its claims find a difference.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "study/analyse/power/kept_counts.h"
#include "study/analyse/power/planned_power.h"
#include "study/analyse/power/planted_report.h"
#include "study/analyse/power/power_report.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/progress.h"

namespace study::commands {

namespace {

using nlohmann::ordered_json;

struct PowerCall {
    std::string protocol;
    std::optional<int> participants;
    std::size_t studies = 500;
    std::size_t calibrate = 0;  ///< studies; 0: no calibration
    std::size_t planted = 0;    ///< studies of each truth; 0: no planted differences
    std::string resume;         ///< file of finished counts; empty: none
    std::uint64_t seed = 1;
    JsonTarget target;
};

stats::SimulationOptions withProgress(stats::SimulationOptions simulation, Progress& progress, std::size_t all)
{
    simulation.done = [&progress, all, sum = std::make_shared<std::size_t>(0)](std::size_t studies) {
        *sum += studies;
        progress.show(static_cast<int>(*sum), static_cast<int>(all));
    };
    return simulation;
}

std::vector<stats::PlannedTest> planned(stats::PowerOptions options)
{
    Progress progress("simulated studies");
    options.simulation = withProgress(options.simulation, progress, stats::plannedStudies(options));
    return stats::plannedTests(options);
}

std::vector<stats::CalibrationRow> calibrated(const stats::PowerOptions& options, const PowerCall& call)
{
    if (call.calibrate == 0) return {};
    Progress progress("studies without a difference");
    auto calibration = analyse::calibrationOptionsOf(options, call.calibrate);
    std::optional<analyse::KeptCounts> kept;
    if (!call.resume.empty()) analyse::resumeFrom(kept.emplace(call.resume), calibration);
    calibration.simulation = withProgress(calibration.simulation, progress, stats::calibrationStudies(calibration));
    std::vector<stats::CalibrationRow> rows = stats::calibration(calibration);
    for (stats::CalibrationRow& row : stats::claimCalibration(calibration)) rows.push_back(std::move(row));
    return rows;
}

std::vector<stats::PlantedCell> planted(const protocols::Protocol& protocol, const stats::PowerOptions& options,
                                        const PowerCall& call)
{
    if (call.planted == 0) return {};
    Progress progress("studies with a planted difference");
    auto planted = analyse::plantedOptionsOf(protocol, options, call.planted);
    std::optional<analyse::KeptCounts> kept;
    if (!call.resume.empty()) analyse::resumeFrom(kept.emplace(call.resume), planted);
    planted.simulation = withProgress(planted.simulation, progress, stats::plantedClaimStudies(planted));
    return stats::plantedCells(planted);
}

int power(const PowerCall& call)
{
    if (!call.resume.empty() && call.calibrate == 0 && call.planted == 0)
        throw protocols::badInput({"--resume counts nothing by itself", "", "--calibrate N or --planted N beside it", ""});
    const auto protocol = call.protocol.empty()
                              ? protocols::protocolFromJson(protocols::paperProtocolJson(), "the paper's protocol")
                              : protocols::readProtocol(call.protocol);
    auto options = analyse::powerOptionsOf(protocol);
    if (call.participants) options.design.participants = static_cast<std::size_t>(*call.participants);
    options.simulation.studies = call.studies;
    options.simulation.seed = call.seed;
    const auto tests = planned(options);
    const auto calibration = calibrated(options, call);
    const auto cells = planted(protocol, options, call);
    if (!call.target) {
        analyse::printDesign(protocol.name, options);
        analyse::printTests(tests);
        if (!calibration.empty()) analyse::printCalibration(calibration);
        if (!cells.empty()) analyse::printPlanted(cells);
        return 0;
    }
    ordered_json json{{"schema", "vis2hap.power/1"}, {"protocol", protocol.name}};
    analyse::putDesign(json, options);
    analyse::putTests(json, tests);
    if (!calibration.empty()) analyse::putCalibration(json, calibration);
    if (!cells.empty()) analyse::putPlanted(json, cells);
    writeJson(call.target, json);
    return 0;
}

}  // namespace

void addPower(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("power", "the effects that this design can detect, before any participant takes part");
    auto call = std::make_shared<PowerCall>();
    command->add_option("--protocol", call->protocol, "the study's protocol (default: the paper's)");
    command->add_option("--participants", call->participants, "number of participants (default: the protocol's)")
        ->check(CLI::Range(2, 1000));
    command->add_option("--studies", call->studies, "number of simulated studies for each effect")
        ->check(CLI::Range(20, 100000))
        ->capture_default_str();
    command
        ->add_option("--calibrate", call->calibrate, "also print how often each test rejects in N studies without a difference")
        ->check(CLI::Range(100, 1000000))
        ->type_name("N");
    command
        ->add_option("--planted", call->planted,
                     "also print how often the claims find a planted difference in N studies of each kind, beside lmerTest's "
                     "model, and how often their intervals hold the truth")
        ->check(CLI::Range(100, 1000000))
        ->type_name("N");
    command
        ->add_option("--resume", call->resume,
                     "keep finished counts of --calibrate and --planted in FILE, and continue from it after an interruption")
        ->type_name("FILE");
    command->add_option("--seed", call->seed, "seed of the simulated studies")->capture_default_str();
    addJsonOption(*command, call->target);
    command->callback([call, &action] { action.work = [call] { return power(*call); }; });
}

}  // namespace study::commands
