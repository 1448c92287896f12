// vis2hap power: the effects that a planned study can detect, before any participant takes part. With --calibrate: how often
// each test of the report rejects in studies without a difference. With --planted: how often its claims find a difference.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/analyse/power/kept_counts.h"
#include "study/analyse/power/planned_power.h"
#include "study/analyse/power/planted_report.h"
#include "study/analyse/power/power_report.h"
#include "study/analyse/power/shared_counts.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/progress.h"
#include "study/commands/parts/shard_option.h"

namespace study::commands {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t mostParticipants = 1000, mostStudies = 100000, mostCounted = 1000000;

/// Everything that the results depend on.
struct PowerPlan {
    std::string protocol;  ///< text of the file
    std::optional<int> participants;
    std::size_t studies = 500;
    std::size_t calibrate = 0;  ///< studies; 0: no calibration
    std::size_t planted = 0;    ///< studies of each truth; 0: no planted differences
    std::uint64_t seed = 1;
    std::string question = {};  ///< whose scale or alternatives the answers have; empty: the first of each kind
};

struct PowerCall {
    PowerPlan plan;
    std::string protocol;  ///< file; empty: the paper's protocol
    std::string resume;    ///< file of finished counts; empty: none
    ShardOption shard;
    JsonTarget target;
};

/// Where the counts of simulated studies come from, and where they go.
struct CountsOfRun {
    stats::Share share;
    std::optional<analyse::KeptCounts> kept;
    std::shared_ptr<analyse::SharedCounts> recorded, taken;  ///< of a shard; of a merged run, which simulates nothing
};

struct PowerResults {
    protocols::Protocol protocol;
    stats::PowerOptions options;
    std::vector<stats::PlannedTest> tests;
    std::vector<stats::CalibrationRow> calibration;
    std::vector<stats::PlantedCell> cells;
    analyse::TestedQuestions tested;
};

ordered_json optionsOf(const PowerPlan& plan)
{
    ordered_json options{
        {"protocol", plan.protocol}, {"participants", plan.participants ? ordered_json(*plan.participants) : ordered_json()},
        {"studies", plan.studies},   {"calibrate", plan.calibrate},
        {"planted", plan.planted},   {"seed", plan.seed}};
    if (!plan.question.empty()) options["question"] = plan.question;
    return options;
}

/// The plan of a merged run. `where`: a file of its shards. Throws badInput for options that optionsOf() did not write.
PowerPlan planFrom(const ordered_json& options, const std::string& where)
{
    try {
        const auto count = [&](const char* name, std::size_t most) {
            const std::size_t number = options.at(name).get_ref<const ordered_json::number_unsigned_t&>();
            if (number > most) throw ordered_json::other_error::create(501, "impossible count", nullptr);
            return number;
        };
        PowerPlan plan;
        plan.protocol = options.at("protocol").get<std::string>();
        if (!options.at("participants").is_null()) plan.participants = static_cast<int>(count("participants", mostParticipants));
        plan.studies = count("studies", mostStudies);
        plan.calibrate = count("calibrate", mostCounted);
        plan.planted = count("planted", mostCounted);
        plan.seed = options.at("seed").get_ref<const ordered_json::number_unsigned_t&>();
        if (options.contains("question")) plan.question = options.at("question").get<std::string>();
        return plan;
    } catch (const ordered_json::exception&) {
        throw protocols::badInput({"the options of the shards are not those of `vis2hap power`", where,
                                   "options as --shard writes them", "run the shards again"});
    }
}

template <class Options>
void prepare(Options& options, CountsOfRun& counts, Progress& progress, std::size_t (*studiesOf)(const Options&))
{
    options.simulation.share = counts.share;
    if constexpr (!std::is_same_v<Options, stats::PowerOptions>)
        if (counts.kept) analyse::resumeFrom(*counts.kept, options);
    if (counts.recorded) recordIn(*counts.recorded, options);
    if (counts.taken) return takeFrom(*counts.taken, options);
    options.simulation.done = [&progress, all = studiesOf(options), sum = std::make_shared<std::size_t>(0)](std::size_t studies) {
        *sum += studies;
        progress.show(static_cast<int>(*sum), static_cast<int>(all));
    };
}

std::vector<stats::PlannedTest> planned(stats::PowerOptions options, CountsOfRun& counts)
{
    Progress progress("simulated studies");
    prepare(options, counts, progress, stats::plannedStudies);
    return stats::plannedTests(options);
}

std::vector<stats::CalibrationRow> calibrated(const stats::PowerOptions& options, std::size_t studies, CountsOfRun& counts)
{
    if (studies == 0) return {};
    Progress progress("studies without a difference");
    auto calibration = analyse::calibrationOptionsOf(options, studies);
    prepare(calibration, counts, progress, stats::calibrationStudies);
    std::vector<stats::CalibrationRow> rows = stats::calibration(calibration);
    for (stats::CalibrationRow& row : stats::claimCalibration(calibration)) rows.push_back(std::move(row));
    return rows;
}

std::vector<stats::PlantedCell> planted(const protocols::Protocol& protocol, const stats::PowerOptions& options,
                                        std::size_t studies, CountsOfRun& counts)
{
    if (studies == 0) return {};
    Progress progress("studies with a planted difference");
    auto planted = analyse::plantedOptionsOf(protocol, options, studies);
    prepare(planted, counts, progress, stats::plantedClaimStudies);
    return stats::plantedCells(planted);
}

PowerResults resultsOf(const PowerPlan& plan, const std::string& where, CountsOfRun& counts)
{
    PowerResults results{protocols::protocolFromJson(plan.protocol, where), {}, {}, {}, {}, {}};
    results.tested = analyse::testedQuestions(results.protocol, plan.question);
    results.options = analyse::powerOptionsOf(results.protocol, results.tested);
    if (plan.participants) results.options.design.participants = static_cast<std::size_t>(*plan.participants);
    results.options.simulation.studies = plan.studies;
    results.options.simulation.seed = plan.seed;
    results.tests = planned(results.options, counts);
    results.calibration = calibrated(results.options, plan.calibrate, counts);
    results.cells = planted(results.protocol, results.options, plan.planted, counts);
    return results;
}

void show(const PowerResults& results, const JsonTarget& target)
{
    const auto& [protocol, options, tests, calibration, cells, tested] = results;
    if (!target) {
        analyse::printDesign(protocol.name, options);
        std::fputs(protocols::printableLines(analyse::textOf(tested)).c_str(), stdout);
        analyse::printTests(tests);
        if (!calibration.empty()) analyse::printCalibration(calibration);
        if (!cells.empty()) analyse::printPlanted(cells);
        return;
    }
    ordered_json json{{"schema", "vis2hap.power/1"}, {"protocol", protocol.name}};
    analyse::putDesign(json, options);
    analyse::putTested(json, tested);
    analyse::putTests(json, tests);
    if (!calibration.empty()) analyse::putCalibration(json, calibration);
    if (!cells.empty()) analyse::putPlanted(json, cells);
    writeJson(target, json);
}

int power(const PowerCall& call)
{
    PowerPlan plan = call.plan;
    if (!call.resume.empty() && plan.calibrate == 0 && plan.planted == 0)
        throw protocols::badInput({"--resume counts nothing by itself", "", "--calibrate N or --planted N beside it", ""});
    plan.protocol = call.protocol.empty() ? protocols::paperProtocolJson() : protocols::readProtocolText(call.protocol);
    CountsOfRun counts;
    counts.share = shareOf(call.shard, "power", call.target);
    if (!call.resume.empty()) counts.kept.emplace(call.resume);
    if (call.shard.isGiven()) counts.recorded = std::make_shared<analyse::SharedCounts>();
    const PowerResults results = resultsOf(plan, call.protocol.empty() ? "the paper's protocol" : call.protocol, counts);
    if (call.shard.isGiven())
        writeShard(call.shard, "power", optionsOf(plan), jsonOf(*counts.recorded));
    else
        show(results, call.target);
    return 0;
}

}  // namespace

void mergePower(const shards::ShardedRun& run, const MergeOutput& output)
{
    requireNoFolder(output);
    CountsOfRun counts;
    for (std::size_t i = 0; i < run.shards.size(); ++i) {
        const std::string where = run.files[i].string();
        auto part = analyse::sharedCountsFrom(run.shards[i].values, where);
        if (i == 0)
            counts.taken = std::make_shared<analyse::SharedCounts>(std::move(part));
        else
            counts.taken->add(part, where);
    }
    const std::string where = run.files.front().string();
    show(resultsOf(planFrom(run.options(), where), where, counts), output.json);
}

void addPower(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("power", "the effects that this design can detect, before any participant takes part");
    auto call = std::make_shared<PowerCall>();
    command->add_option("--protocol", call->protocol, "the study's protocol (default: the paper's)");
    command->add_option("--participants", call->plan.participants, "number of participants (default: the protocol's)")
        ->check(CLI::Range(std::size_t{2}, mostParticipants));
    command
        ->add_option("--question", call->plan.question,
                     "question whose scale the ratings have, or whose alternatives the choices have (default: the first rated "
                     "question and the first choice)")
        ->type_name("ID");
    command->add_option("--studies", call->plan.studies, "number of simulated studies for each effect")
        ->check(CLI::Range(std::size_t{20}, mostStudies))
        ->capture_default_str();
    command
        ->add_option("--calibrate", call->plan.calibrate,
                     "also print how often each test rejects in N studies without a difference")
        ->check(CLI::Range(std::size_t{100}, mostCounted))
        ->option_text("N");
    command
        ->add_option("--planted", call->plan.planted,
                     "also print how often the claims find a planted difference in N studies of each kind, beside lmerTest's "
                     "model, and how often their intervals hold the truth")
        ->check(CLI::Range(std::size_t{100}, mostCounted))
        ->option_text("N");
    command
        ->add_option("--resume", call->resume,
                     "keep finished counts of --calibrate and --planted in FILE, and continue from it after an interruption")
        ->type_name("FILE");
    command->add_option("--seed", call->plan.seed, "seed of the simulated studies")->capture_default_str();
    addJsonOption(*command, call->target);
    addShardOptions(*command, call->shard);
    command->callback([call, &action] { action.work = [call] { return power(*call); }; });
}

}  // namespace study::commands
