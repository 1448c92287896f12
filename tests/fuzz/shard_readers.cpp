#include "tests/fuzz/shard_readers.h"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "study/analyse/power/shared_counts.h"
#include "study/bench/cost_curves.h"
#include "study/evaluation/left_out/leave_one_out.h"
#include "study/shards/shard_file.h"
#include "study/simulation/simulation_analysis.h"
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

study::bench::CostCurve someCurve()
{
    study::bench::CostCurve curve{"integration", "pixels", true, {{16, 1.5, 2.0}, {64, 7, {}}, {256, 30, 9.0}}, {}, {}};
    study::bench::fitExponent(curve);
    return curve;
}

constexpr const char* program = "vis2hap 1.0.0";

std::string shardOf(const fs::path& folder, const std::string& command, const ordered_json& options, const ordered_json& values)
{
    const fs::path file = folder / "shard.json";
    study::shards::writeShard(file, {program, command, options, {0, 1}, values});
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
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
    if (values.is_object() && values.contains("work")) {
        const auto curve = study::bench::curveFrom(values, "values");
        const ordered_json written = jsonOf(curve);
        if (jsonOf(study::bench::curveFrom(written, "written")) != written)
            throw std::runtime_error("a cost curve is not read as it was written");
        study::bench::tableOf({curve});
        return;
    }
    auto counts = study::analyse::sharedCountsFrom(values, "values");
    const ordered_json written = jsonOf(counts);
    if (jsonOf(study::analyse::sharedCountsFrom(written, "written")) != written)
        throw std::runtime_error("counts are not read as they were written");
    counts.add(study::analyse::sharedCountsFrom(written, "written"), "written");
}

/// The text with the hash that its content needs: a changed text would else go no further than its hash.
std::string hashedShard(const std::string& bytes)
{
    try {
        ordered_json json = protocols::parseStrictOrderedJson(bytes, "shard");
        if (!json.is_object() || !json.contains("sha256")) return bytes;
        json.erase("sha256");
        json["sha256"] = protocols::sha256(nlohmann::json(json).dump());
        return json.dump();
    } catch (const protocols::Error&) {
        return bytes;
    } catch (const nlohmann::json::exception&) {
        return bytes;  // not UTF-8
    }
}

/// As `merge` goes on with the shards of `simulate --in-memory`.
void mergeAnswers(const study::shards::Shard& shard)
{
    const auto shared = study::simulation::sharedSimulationFrom(shard.options, "shard");
    study::simulation::SimulationRequest whole;
    whole.count = shared.participants;
    const auto own = study::simulation::shareOf(whole, shard.share);
    const auto answers = study::simulation::answersFrom(shard.values.at("answers"), shared, own.first, own.count, "shard");
    study::simulation::analysisOf(shared.study, answers);
}

/// As it goes on with those of `train --leave-one-out`.
void mergeFabrics(const study::shards::Shard& shard)
{
    study::evaluation::LeaveOneOut result{shard.options.at("dataset").get<std::string>(), {}};
    for (const ordered_json& fabric : shard.options.at("fabrics")) {
        result.fabrics.push_back(study::evaluation::leftOutFrom(shard.values.at(fabric.get<std::string>()), "shard"));
        if (result.fabrics.back().predictors.size() != result.fabrics.front().predictors.size()) return;
    }
    study::evaluation::leaveOneOutText(result);
    study::evaluation::leaveOneOutJson(result);
}

void readShard(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << hashedShard(bytes);
    const auto run = study::shards::readRun({file}, program);
    if (run.shards.size() != 1 || run.shards[0].share.parts != 1) throw std::runtime_error("a run that lacks shards was read");
    try {
        if (run.command() == "simulate") mergeAnswers(run.shards[0]);
        if (run.command() == "train") mergeFabrics(run.shards[0]);
    } catch (const ordered_json::exception&) {
        throw protocols::badInput({"the shard lacks values", "shard", "", ""});
    }
    if (run.command() != "power") return;
    auto counts = study::analyse::sharedCountsFrom(run.shards[0].values, "shard");
    counts.add(study::analyse::sharedCountsFrom(jsonOf(counts), "shard"), "shard");
}

ordered_json answersOfEverybody()
{
    std::vector<study::simulation::SimulatedAnswers> everybody(2);
    for (std::size_t i = 0; i < everybody.size(); ++i) {
        everybody[i].number = static_cast<int>(i) + 1;
        everybody[i].values = {1, 0, 1, 0, 35, 62, 40, static_cast<std::int16_t>(50 + i)};
        everybody[i].seconds = {2.5, 3, 2, 1, 4, 3.5, 2.25, 1};
    }
    return study::simulation::answersJson(everybody);
}

/// A shard of each command that has some.
std::vector<std::string> someShards(const fs::path& folder)
{
    const char* const protocol =
        R"({"schema":"vis2hap.protocol/1","name":"s","participants":2,"fabrics":["F01","F02"],"conditions":["v_grey","h&f"],)"
        R"("phases":[{"questions":["Q1"],"alternatives":2},{"questions":["Q2"],"scale":{"min":0,"max":10}}]})";
    return {shardOf(folder, "power", {{"studies", 10}, {"protocol", "{}"}}, jsonOf(someCounts())),
            shardOf(folder, "simulate",
                    {{"study", "s"},
                     {"protocol", protocol},
                     {"protocol_sha256", std::string(64, 'a')},
                     {"made_by", "1.0.0"},
                     {"made_with", "vis2hap 1.0.0"},
                     {"fabrics", {"F01", "F02"}},
                     {"participants", 2},
                     {"mishaps", false},
                     {"seed", 1}},
                    {{"study_folder", "s"}, {"answers", answersOfEverybody()}}),
            shardOf(folder, "train", {{"dataset", "set"}, {"fabrics", ordered_json::array({"F01"})}},
                    {{"F01", leftOutJson(someFabric())}})};
}

}  // namespace

std::vector<Reader> shardReaders(const fs::path& folder)
{
    return {
        {"shard", someShards(folder), [folder](const std::string& bytes) { readShard(folder / "shard.json", bytes); }},
        {"shard-values", {jsonOf(someCounts()).dump(), leftOutJson(someFabric()).dump(), jsonOf(someCurve()).dump()}, readValues},
        {"simulated-answers", {someAnswers()}, readAnswers}};
}

}  // namespace fuzz
