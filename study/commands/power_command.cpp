// vis2hap power: the effects that a planned study can detect, before any participant takes part. With --calibrate: how often
// each test of the report rejects in studies without a difference.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/protocol_json.h"
#include "study/analyse/power/planned_power.h"
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

std::vector<stats::CalibrationRow> calibrated(const stats::PowerOptions& options, std::size_t studies)
{
    if (studies == 0) return {};
    Progress progress("studies without a difference");
    auto calibration = analyse::calibrationOptionsOf(options, studies);
    calibration.simulation = withProgress(calibration.simulation, progress, stats::calibrationStudies(calibration));
    std::vector<stats::CalibrationRow> rows = stats::calibration(calibration);
    for (stats::CalibrationRow& row : stats::claimCalibration(calibration)) rows.push_back(std::move(row));
    return rows;
}

int power(const PowerCall& call)
{
    const auto protocol = call.protocol.empty()
                              ? protocols::protocolFromJson(protocols::paperProtocolJson(), "the paper's protocol")
                              : protocols::readProtocol(call.protocol);
    auto options = analyse::powerOptionsOf(protocol);
    if (call.participants) options.design.participants = static_cast<std::size_t>(*call.participants);
    options.simulation.studies = call.studies;
    options.simulation.seed = call.seed;
    const auto tests = planned(options);
    const auto calibration = calibrated(options, call.calibrate);
    if (!call.target) {
        analyse::printDesign(protocol.name, options);
        analyse::printTests(tests);
        if (!calibration.empty()) analyse::printCalibration(calibration);
        return 0;
    }
    ordered_json json{{"schema", "vis2hap.power/1"}, {"protocol", protocol.name}};
    analyse::putDesign(json, options);
    analyse::putTests(json, tests);
    if (!calibration.empty()) analyse::putCalibration(json, calibration);
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
    command->add_option("--seed", call->seed, "seed of the simulated studies")->capture_default_str();
    addJsonOption(*command, call->target);
    command->callback([call, &action] { action.work = [call] { return power(*call); }; });
}

}  // namespace study::commands
