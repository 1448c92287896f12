#include "study/records/registered_plan.h"

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "reports/text/plain_words.h"
#include "study/records/followed_versions.h"

namespace study::records {

namespace {

using nlohmann::json;

/// Two phases may have an instruction of one name, and two sentences for it.
void addText(std::vector<reports::PlannedText>& texts, const std::string& name, const std::string& text)
{
    const auto known = std::ranges::find(texts, name, &reports::PlannedText::name);
    if (known == texts.end())
        texts.push_back({name, text});
    else
        known->text += "\n" + text;
}

std::vector<reports::PlannedText> textsOf(const protocols::Protocol& protocol)
{
    std::vector<reports::PlannedText> texts;
    for (const auto& phase : protocol.phases) {
        for (const auto& question : phase.questions) addText(texts, reports::wordingNameOf(question.id.value), question.text);
        for (const auto& one : phase.instructions) {
            const std::string name = "the instruction " + one.id.value;
            addText(texts, "wording of " + name, one.text);
            addText(texts, "deadline of " + name, one.deadlineSeconds ? protocols::shortest(*one.deadlineSeconds) : "none");
        }
    }
    return texts;
}

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
    design.hasUsualBounds = protocol.hasUsualBounds;
    design.answersPerRendering = static_cast<std::size_t>(protocol.answersPerRendering());
    design.protocolSha256 = protocolSha256;
    design.texts = textsOf(protocol);
    return design;
}

reports::PlannedDesign designOf(const database::ProtocolVersion& version, const database::StudyStore& store)
{
    return designOf(protocols::keptProtocolFromJson(version.json, "the study's protocol", store.facts().programVersion), store,
                    version.sha256);
}

/// Throws std::out_of_range for a number that no study has.
std::size_t participantsIn(const json& plan)
{
    constexpr std::uint64_t most = 100'000;
    const json& participants = plan.at("participants");
    if (!participants.is_number_unsigned() || participants.get<std::uint64_t>() > most) throw std::out_of_range("participants");
    return participants.get<std::size_t>();
}

reports::PlannedDesign designIn(const json& registered)
{
    const json& plan = registered.at("plan");
    reports::PlannedDesign design;
    design.participants = participantsIn(plan);
    for (const json& fabric : plan.at("fabrics")) design.fabricIds.push_back(fabric.at("id"));
    design.fabrics = design.fabricIds.size();
    design.conditionIds = plan.at("conditions").get<std::vector<std::string>>();
    design.conditions = design.conditionIds.size();
    for (const json& question : plan.at("questions")) {
        design.questions.push_back(question.at("id"));
        addText(design.texts, reports::wordingNameOf(design.questions.back()), question.value("text", ""));
    }
    for (const json& contrast : plan.at("planned")) design.contrastPairs.emplace_back(contrast.at("a"), contrast.at("b"));
    design.contrasts = design.contrastPairs.size();
    design.equivalenceBounds = {plan.at("equivalence_bounds").at(0), plan.at("equivalence_bounds").at(1)};
    design.protocolSha256 = registered.at("study").at("protocol_sha256");
    return design;
}

/// Adds what the registered JSON does not tell, by the version of the protocol that it names.
void addFromProtocol(reports::PlannedDesign& design, const database::StudyStore& store)
{
    const auto versions = store.protocolVersions();
    const auto named = std::ranges::find(versions, design.protocolSha256, &database::ProtocolVersion::sha256);
    if (named == versions.end()) return;
    const reports::PlannedDesign stated = designOf(*named, store);
    design.hasUsualBounds = stated.hasUsualBounds;
    design.answersPerRendering = stated.answersPerRendering;
    design.texts = stated.texts;  // as this version reads them, which is how it reads the latest protocol
}

/// Runs `read` on the registered JSON.
template <class Read>
auto readFrom(const database::StudyStore& store, const database::PreregistrationRecord& record, const Read& read)
{
    const auto unreadable = [&] {
        return protocols::workFailed({"registered plan " + std::to_string(record.number) + " cannot be read",
                                      store.folder().folder.string(), "a plan of schema vis2hap.preregistration/1",
                                      "see `vis2hap verify`"});
    };
    try {
        return read(protocols::storedJson(record.json));
    } catch (const json::exception&) {
        throw unreadable();
    } catch (const std::out_of_range&) {
        throw unreadable();
    }
}

bool isInTime(const database::PreregistrationRecord& record) { return record.answersBefore == 0 && !record.afterUnblinding; }

/// The last plan that was registered in time; if there is none, the first one. Null where none is registered.
const database::PreregistrationRecord* followedOf(const std::vector<database::PreregistrationRecord>& records)
{
    const database::PreregistrationRecord* followed = records.empty() ? nullptr : &records.front();
    for (const auto& record : records)
        if (isInTime(record)) followed = &record;
    return followed;
}

std::vector<reports::Registration> registrationsOf(const database::StudyStore& store,
                                                   const std::vector<database::PreregistrationRecord>& records,
                                                   const database::PreregistrationRecord* followed)
{
    std::vector<reports::Registration> registrations;
    for (const auto& record : records)
        registrations.push_back(
            {record.number, record.wallTime, record.jsonSha256(), record.answersBefore, record.afterUnblinding,
             readFrom(store, record, [](const json& plan) { return plan.at("changes").get<std::vector<std::string>>(); }),
             &record == followed});
    return registrations;
}

/// Where neither protocol states bounds, an earlier version of this program may have had another default.
bool differInBounds(const reports::PlannedDesign& planned, const reports::PlannedDesign& used)
{
    return planned.equivalenceBounds != used.equivalenceBounds && !(planned.hasUsualBounds && used.hasUsualBounds);
}

/// The parts of a plan that an amended protocol can change.
std::vector<std::string> changesOfPlan(const reports::PlannedDesign& planned, const reports::PlannedDesign& used)
{
    std::vector<std::string> changes;
    if (differInBounds(planned, used)) changes.emplace_back(reports::equivalenceBoundsChanged);
    if (planned.contrastPairs != used.contrastPairs) changes.emplace_back("planned contrasts");
    return changes;
}

/// What `used` lets participants be asked or told otherwise. The plan states no other texts and times.
std::vector<std::string> textsChangedBetween(const reports::PlannedDesign& planned, const reports::PlannedDesign& used)
{
    std::vector<std::string> changes;
    if (planned.protocolSha256 == used.protocolSha256) return changes;
    for (const reports::PlannedText& one : used.texts) {
        const auto before = std::ranges::find(planned.texts, one.name, &reports::PlannedText::name);
        if (before != planned.texts.end() && before->text != one.text) changes.push_back(one.name);
    }
    if (changes.empty() && changesOfPlan(planned, used).empty()) changes.emplace_back("texts or times only");
    return changes;
}

/// The plan that counts, and the registration that states it; null where the protocol does.
struct CountingPlan {
    reports::PlannedDesign design;
    const database::PreregistrationRecord* followed = nullptr;
};

CountingPlan countingPlan(const database::StudyStore& store, const std::vector<database::PreregistrationRecord>& records)
{
    CountingPlan plan{designOf(versionBeforeAnswers(store), store), followedOf(records)};
    if (plan.followed == nullptr) return plan;
    reports::PlannedDesign registered = readFrom(store, *plan.followed, designIn);
    addFromProtocol(registered, store);
    // A plan after answers binds nobody: it may not change what the protocol stated before them.
    if (store.protocolVersions().size() == 1 || isInTime(*plan.followed) || changesOfPlan(plan.design, registered).empty())
        plan.design = std::move(registered);
    else
        plan.followed = nullptr;
    return plan;
}

/// What states the bounds and the contrasts of the plan. `latest`: what the latest protocol states.
void describeOrigins(const CountingPlan& plan, const reports::PlannedDesign& latest, reports::StudyData& data)
{
    using reports::PlanOrigin;
    const bool isRegistered = plan.followed != nullptr;
    data.boundsFrom = plan.design.hasUsualBounds ? PlanOrigin::Program : PlanOrigin::Protocol;
    // A registered text names its bounds also where they were the default.
    if (isRegistered && (plan.design.hasUsualBounds || differInBounds(plan.design, latest)))
        data.boundsFrom = PlanOrigin::RegisteredPlan;
    const bool hasOthers = plan.design.contrastPairs != latest.contrastPairs;
    data.plannedFrom = isRegistered && hasOthers ? PlanOrigin::RegisteredPlan : PlanOrigin::Protocol;
}

}  // namespace

void describePlan(const database::StudyStore& store, reports::StudyData& data)
{
    const auto records = preregistrationsOf(store);
    const auto versions = store.protocolVersions();
    const auto& latest = versions.back();
    CountingPlan plan = countingPlan(store, records);
    reports::PlannedDesign& design = plan.design;
    const reports::PlannedDesign used = designOf(latest, store);
    data.hasLog = true;
    data.registrations = registrationsOf(store, records, plan.followed);
    data.planVersion = versions.size() > 1 && plan.followed == nullptr ? versionBeforeAnswers(store).version : 0;
    data.protocolInUse = latest.sha256;
    data.protocolChanges = changesOfPlan(design, used);
    data.changedTexts = textsChangedBetween(design, used);
    describeOrigins(plan, used, data);
    data.equivalenceBounds = design.equivalenceBounds;
    if (data.blinded) {
        design.conditionIds.clear();
        design.contrastPairs.clear();
    }
    data.planned = design.contrastPairs;
    data.plannedDesign = std::move(design);
}

std::string noteOnPlan(const database::StudyStore& store, const protocols::Protocol& amended)
{
    const auto records = preregistrationsOf(store);
    const CountingPlan plan = countingPlan(store, records);
    const auto changes = changesOfPlan(plan.design, designOf(amended, store, {}));
    if (changes.empty()) return {};
    const std::string what = reports::listed(changes);
    const bool isAnswered = store.firstEventOfKind("answered").has_value();
    if (isAnswered || store.unblinding())
        return what + (isAnswered ? " changed after the first answer" : " changed after the unblinding") +
               ": reports keep those of the plan before, and name the change";
    if (plan.followed == nullptr) return {};
    return "the registered plan states other " + what +
           ": reports keep it, unless `vis2hap study preregister` registers the change before the first answer";
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
