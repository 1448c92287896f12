#include "study/records/registered_plan.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"

namespace study::records {

namespace {

using nlohmann::json;

reports::PlannedDesign designOf(const protocols::Protocol& protocol, const database::StudyStore& store,
                                const std::string& protocolSha256)
{
    reports::PlannedDesign design;
    design.participants = store.slots().size();
    for (const auto& fabric : store.facts().fabrics) design.fabricIds.push_back(fabric.value);
    design.fabrics = design.fabricIds.size();
    for (const auto& condition : protocol.conditions) design.conditionIds.push_back(condition.value);
    design.conditions = design.conditionIds.size();
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) design.questions.push_back(question.id.value);
    for (const auto& contrast : contrastsInOrder(protocol)) design.contrastPairs.emplace_back(contrast.a.value, contrast.b.value);
    design.contrasts = design.contrastPairs.size();
    design.equivalenceBounds = protocol.equivalenceBounds;
    design.protocolSha256 = protocolSha256;
    return design;
}

reports::PlannedDesign designIn(const json& registered)
{
    const json& plan = registered.at("plan");
    reports::PlannedDesign design;
    design.participants = plan.at("participants");
    for (const json& fabric : plan.at("fabrics")) design.fabricIds.push_back(fabric.at("id"));
    design.fabrics = design.fabricIds.size();
    design.conditionIds = plan.at("conditions").get<std::vector<std::string>>();
    design.conditions = design.conditionIds.size();
    for (const json& question : plan.at("questions")) design.questions.push_back(question.at("id"));
    for (const json& contrast : plan.at("planned")) design.contrastPairs.emplace_back(contrast.at("a"), contrast.at("b"));
    design.contrasts = design.contrastPairs.size();
    design.equivalenceBounds = {plan.at("equivalence_bounds").at(0), plan.at("equivalence_bounds").at(1)};
    design.protocolSha256 = registered.at("study").at("protocol_sha256");
    return design;
}

/// Runs `read` on the registered JSON.
template <class Read>
auto readFrom(const database::StudyStore& store, const database::PreregistrationRecord& record, const Read& read)
{
    try {
        return read(protocols::storedJson(record.json));
    } catch (const json::exception&) {
        throw protocols::workFailed({"registered plan " + std::to_string(record.number) + " cannot be read",
                                     store.folder().folder.string(), "a plan of schema vis2hap.preregistration/1",
                                     "see `vis2hap verify`"});
    }
}

std::vector<reports::Registration> registrationsOf(const database::StudyStore& store,
                                                   const std::vector<database::PreregistrationRecord>& records)
{
    std::vector<reports::Registration> registrations;
    for (const auto& record : records)
        registrations.push_back(
            {record.number, record.wallTime, record.jsonSha256(), record.answersBefore, record.afterUnblinding,
             readFrom(store, record, [](const json& plan) { return plan.at("changes").get<std::vector<std::string>>(); }),
             &record == followedOf(records)});
    return registrations;
}

std::vector<std::string> changesBetween(const reports::PlannedDesign& planned, const reports::PlannedDesign& used)
{
    std::vector<std::string> changes;
    if (planned.equivalenceBounds != used.equivalenceBounds) changes.emplace_back("equivalence bounds");
    if (planned.contrastPairs != used.contrastPairs) changes.emplace_back("planned contrasts");
    if (changes.empty() && planned.protocolSha256 != used.protocolSha256) changes.emplace_back("texts or times only");
    return changes;
}

}  // namespace

const database::PreregistrationRecord* followedOf(const std::vector<database::PreregistrationRecord>& records)
{
    const database::PreregistrationRecord* followed = records.empty() ? nullptr : &records.front();
    for (const auto& record : records)
        if (record.answersBefore == 0 && !record.afterUnblinding) followed = &record;
    return followed;
}

void describePlan(const database::StudyStore& store, reports::StudyData& data)
{
    const auto facts = store.facts();
    const auto records = preregistrationsOf(store);
    const auto protocolIn = [&](const std::string& text) {
        return protocols::keptProtocolFromJson(text, "the study's protocol", facts.programVersion);
    };
    const auto latest = store.protocolVersions().back();
    const auto* followed = followedOf(records);
    reports::PlannedDesign design = followed != nullptr ? readFrom(store, *followed, designIn)
                                                        : designOf(protocolIn(facts.protocolJson), store, facts.protocolSha256);
    data.hasLog = true;
    data.registrations = registrationsOf(store, records);
    data.protocolInUse = latest.sha256;
    data.protocolChanges = changesBetween(design, designOf(protocolIn(latest.json), store, latest.sha256));
    data.equivalenceBounds = design.equivalenceBounds;
    if (data.blinded) {
        design.conditionIds.clear();
        design.contrastPairs.clear();
    }
    data.planned = design.contrastPairs;
    data.plannedDesign = std::move(design);
}

std::vector<std::string> faultsOfRegisteredFiles(const database::StudyStore& store)
{
    std::vector<std::string> faults;
    try {
        for (const auto& record : preregistrationsOf(store))
            for (const auto& [file, bytes] :
                 {std::pair(preregistrationFile(store.folder(), record.number, "txt"), &record.text),
                  std::pair(preregistrationFile(store.folder(), record.number, "json"), &record.json)}) {
                if (!std::filesystem::exists(file))
                    faults.push_back(file.filename().string() + ": missing (`vis2hap study preregister` writes it again)");
                else if (protocols::readIfPossible(file) != *bytes)
                    faults.push_back(file.filename().string() + ": differs from the plan that was registered on " +
                                     record.wallTime);
            }
    } catch (const protocols::Error&) {
        // The audit of the log reports a payload that cannot be read.
    }
    return faults;
}

}  // namespace study::records
