// vis2hap power: what a planned study can and cannot detect, before anyone is tested; with --calibrate,
// how often each test of the report rejects when there is nothing to find.
#include <CLI/CLI.hpp>
#include <memory>

#include "protocols/protocol_json.h"
#include "stats/power/calibration.h"
#include "stats/power/power_plan.h"
#include "study/commands/command_line.h"
#include "study/commands/json_output.h"
#include "study/commands/power_tables.h"
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

// What the default truth is written for; other scales are taken as this one stretched.
constexpr double hapticScale = 10;

void putScale(stats::RatingTruth& truth, const protocols::RatingScale& scale)
{
    truth.scaleMin = scale.min.inScaleUnits();
    truth.scaleMax = scale.max.inScaleUnits();
    truth.scaleStep = scale.step.inScaleUnits();
    const double stretch = (truth.scaleMax - truth.scaleMin) / hapticScale;
    truth.centre = truth.scaleMin + stretch * truth.centre;
    for (double* variance :
         {&truth.participant, &truth.fabric, &truth.participantCondition, &truth.fabricCondition, &truth.residual})
        *variance *= stretch * stretch;
}

stats::PowerOptions optionsFor(const protocols::Protocol& protocol, const PowerCall& call)
{
    stats::PowerOptions options;
    options.design.participants = static_cast<std::size_t>(call.participants.value_or(protocol.participants));
    options.design.fabrics = static_cast<std::size_t>(protocol.fabricCount);
    options.design.conditions = protocol.conditions.size();
    options.equivalenceBounds = protocol.equivalenceBounds;
    options.simulation.studies = call.studies;
    options.simulation.seed = call.seed;
    options.hasChoices = options.hasRatings = false;
    for (const auto& phase : protocol.phases) {
        if (const auto* choice = std::get_if<protocols::ForcedChoice>(&phase.task); choice && !options.hasChoices) {
            options.hasChoices = true;
            options.design.alternatives = choice->alternatives;
        }
        if (const auto* rating = std::get_if<protocols::Rating>(&phase.task); rating && !options.hasRatings) {
            options.hasRatings = true;
            putScale(options.ratings, rating->scale);
        }
    }
    return options;
}

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
    Progress progress("studies with nothing to find");
    stats::CalibrationOptions calibration;
    calibration.design = options.design;
    calibration.ratings = options.ratings;
    calibration.choices = options.choices;
    calibration.mixedModelStudies = studies;
    calibration.simulation.studies = studies;
    calibration.simulation.seed = options.simulation.seed;
    calibration.simulation = withProgress(calibration.simulation, progress, stats::calibrationStudies(calibration));
    return stats::calibration(calibration);
}

int power(const PowerCall& call)
{
    const auto protocol = call.protocol.empty()
                              ? protocols::protocolFromJson(protocols::paperProtocolJson(), "the paper's protocol")
                              : protocols::readProtocol(call.protocol);
    const auto options = optionsFor(protocol, call);
    const auto tests = planned(options);
    const auto calibration = calibrated(options, call.calibrate);
    if (!call.target) {
        printDesign(protocol.name, options);
        printTests(tests);
        if (!calibration.empty()) printCalibration(calibration);
        return 0;
    }
    ordered_json json{{"schema", "vis2hap.power/1"}, {"protocol", protocol.name}};
    putDesign(json, options);
    putTests(json, tests);
    if (!calibration.empty()) putCalibration(json, calibration);
    writeJson(call.target, json);
    return 0;
}

}  // namespace

void addPower(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("power", "what this design can and cannot detect, before anyone is tested");
    auto call = std::make_shared<PowerCall>();
    command->add_option("--protocol", call->protocol, "the study's protocol (default: the paper's)");
    command->add_option("--participants", call->participants, "instead of the protocol's number")->check(CLI::Range(2, 1000));
    command->add_option("--studies", call->studies, "simulated studies for each effect")
        ->check(CLI::Range(20, 100000))
        ->capture_default_str();
    command->add_option("--calibrate", call->calibrate, "also: how often each test rejects where nothing differs, in N studies")
        ->check(CLI::Range(100, 1000000))
        ->type_name("N");
    command->add_option("--seed", call->seed, "draws the simulated studies")->capture_default_str();
    addJsonOption(*command, call->target);
    command->callback([call, &action] { action.work = [call] { return power(*call); }; });
}

}  // namespace study::commands
