#include "tests/fuzz/shard_readers.h"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/strict_json.h"
#include "study/analyse/power/shared_counts.h"
#include "study/evaluation/left_out/leave_one_out.h"
#include "study/shards/shard_file.h"
#include "study/simulation/simulation_shard.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

study::analyse::SharedCounts someCounts()
{
    study::analyse::SharedCounts counts;
    counts.planned["ratings, difference of 0.5"] = {{10, 4, 0}, {10, 0, 2}};
    counts.calibrated["guesses"] = {{10, 1, 0}};
    counts.planted["alike"] = {{"different", false, {10, 4, 4}, {10, 3, 3}, {10, 5, 5}, {10, -2, 2}},
                               {"interval", true, {10, 300, 9000, 36}, {10, 3, 3, 36}, {10, 5, 5, 36}, {10, -2, 2, 36}}};
    return counts;
}

study::evaluation::LeftOutFabric someFabric()
{
    study::evaluation::LeftOutFabric fabric{protocols::FabricId("F01"), "ab12", 100, 7, {{"generated", "generated", {}}}};
    at(fabric.predictors[0].values, study::evaluation::Measure::FrictionMae) = 0.25;
    return fabric;
}

std::string someShard(const fs::path& folder)
{
    const fs::path file = folder / "shard.json";
    study::shards::writeShard(file,
                              {"vis2hap 1.0.0", "power", {{"studies", 10}, {"protocol", "{}"}}, {0, 1}, jsonOf(someCounts())});
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void readShard(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    const auto run = study::shards::readRun({file}, "vis2hap 1.0.0");
    if (run.shards.size() != 1 || run.shards[0].share.parts != 1) throw std::runtime_error("a run that lacks shards was read");
}

/// Questions, conditions and fabrics of a small study, of which only the numbers matter.
study::simulation::SharedSimulation someSimulation()
{
    study::simulation::SharedSimulation simulation;
    simulation.study.protocol.phases.resize(1);
    simulation.study.protocol.phases[0].questions.resize(1);
    simulation.study.protocol.conditions = {protocols::ConditionId("f"), protocols::ConditionId("h")};
    simulation.study.fabrics = {protocols::FabricId("F01"), protocols::FabricId("F02")};
    return simulation;
}

std::string someAnswers()
{
    study::simulation::SimulatedAnswers one;
    one.number = 1;
    one.values = {1, 0, study::simulation::SimulatedAnswers::none, 1};
    one.seconds = {2.5, 3, std::numeric_limits<double>::quiet_NaN(), 1};
    return study::simulation::answersJson({one}).dump();
}

void readAnswers(const std::string& bytes)
{
    const auto answers =
        study::simulation::answersFrom(protocols::parseStrictOrderedJson(bytes, "answers"), someSimulation(), 1, 1, "answers");
    if (answers.size() != 1 || answers[0].values.size() != 4 || answers[0].seconds.size() != 4)
        throw std::runtime_error("answers of another number were read");
}

/// What was read is written and read again without a difference.
void readValues(const std::string& bytes)
{
    const ordered_json values = protocols::parseStrictOrderedJson(bytes, "values");
    if (values.is_object() && values.contains("fabric")) {
        const auto fabric = study::evaluation::leftOutFrom(values, "values");
        const ordered_json written = leftOutJson(fabric);
        if (leftOutJson(study::evaluation::leftOutFrom(written, "written")) != written)
            throw std::runtime_error("values of a fabric are not read as they were written");
        study::evaluation::leaveOneOutText({"set", {fabric}});
        return;
    }
    auto counts = study::analyse::sharedCountsFrom(values, "values");
    const ordered_json written = jsonOf(counts);
    if (jsonOf(study::analyse::sharedCountsFrom(written, "written")) != written)
        throw std::runtime_error("counts are not read as they were written");
    counts.add(study::analyse::sharedCountsFrom(written, "written"), "written");
}

}  // namespace

std::vector<Reader> shardReaders(const fs::path& folder)
{
    return {{"shard", {someShard(folder)}, [folder](const std::string& bytes) { readShard(folder / "shard.json", bytes); }},
            {"shard-values", {jsonOf(someCounts()).dump(), leftOutJson(someFabric()).dump()}, readValues},
            {"simulated-answers", {someAnswers()}, readAnswers}};
}

}  // namespace fuzz
