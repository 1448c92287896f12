#include "study/making/preregistration.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/making/plan_json.h"
#include "study/making/plan_text.h"

namespace study::making {

namespace {

namespace fs = std::filesystem;
using database::PreregistrationRecord;
using nlohmann::ordered_json;

struct RegisteredFile {
    fs::path file;
    const std::string& bytes;
};

std::vector<RegisteredFile> filesOf(const database::StudyFolder& folder, const PreregistrationRecord& record)
{
    return {{preregistrationFile(folder, record.number, "txt"), record.text},
            {preregistrationFile(folder, record.number, "json"), record.json}};
}

/// A file with other content is somebody's work, or an altered plan: it stays, and the call ends.
void requireUnaltered(const RegisteredFile& one)
{
    if (fs::exists(one.file) && protocols::readWholeFile(one.file) != one.bytes)
        throw protocols::badInput({"the file differs from the registered plan", one.file.string(),
                                   "SHA-256 " + protocols::sha256(one.bytes),
                                   "move the file away and repeat the command, which writes the registered plan"});
}

void requireAbsent(const fs::path& file)
{
    if (fs::exists(file))
        throw protocols::badInput({"a file with this name exists, and it is not registered", file.string(), "no such file",
                                   "move the file away and repeat the command"});
    protocols::requireWritable(file);
}

void writeMissing(const RegisteredFile& one, std::vector<fs::path>& written)
{
    if (fs::exists(one.file)) return;
    protocols::writeWholeFile(one.file, one.bytes);
    written.push_back(one.file);
}

std::vector<std::string> changesBetween(const ordered_json& before, const ordered_json& now)
{
    std::vector<std::string> changes;
    for (const auto& [part, value] : now.items())
        if (!before.contains(part) || before[part] != value) changes.push_back(part);
    for (const auto& [part, value] : before.items())
        if (!now.contains(part)) changes.push_back(part);
    return changes;
}

/// Whether the plan is the same but for the sentences of the flags: another version of this program wrote them.
bool onlyRulesDiffer(const ordered_json& before, const ordered_json& now, const std::vector<std::string>& changes)
{
    const char* part = "exclusions";
    if (changes != std::vector<std::string>{part} || !before.contains(part) || !before[part].is_object()) return false;
    ordered_json earlier = before[part], later = now[part];
    earlier.erase("rules");
    later.erase("rules");
    return earlier == later;
}

/// The registered JSON, with the object "plan". Throws workFailed where somebody altered it.
ordered_json registeredJson(const database::StudyStore& store, const PreregistrationRecord& record)
{
    auto json = protocols::storedOrderedJson(record.json);
    if (json.is_object() && json.contains("plan") && json["plan"].is_object()) return json;
    throw protocols::workFailed({"registered plan " + std::to_string(record.number) + " cannot be read",
                                 store.folder().folder.string(), "a plan of schema vis2hap.preregistration/1",
                                 "see `vis2hap verify`; restore the study from a backup"});
}

/// Whether the version of the protocol that was registered states no bounds, either.
bool statesNoBounds(const database::StudyStore& store, const ordered_json& registered)
{
    const ordered_json::json_pointer hash("/study/protocol_sha256");
    const auto versions = store.protocolVersions();
    const auto named = std::ranges::find_if(versions, [&](const database::ProtocolVersion& version) {
        return registered.contains(hash) && registered.at(hash) == version.sha256;
    });
    return named != versions.end() &&
           protocols::keptProtocolFromJson(named->json, "the study's protocol", store.facts().programVersion).hasUsualBounds;
}

/// A protocol without bounds keeps those that were registered for it. An earlier version of this program had another default.
void keepRegisteredBounds(const database::StudyStore& store, const ordered_json& registered, StudyPlan& plan)
{
    const ordered_json::json_pointer low("/plan/equivalence_bounds/0"), high("/plan/equivalence_bounds/1");
    if (!plan.protocol.hasUsualBounds || !statesNoBounds(store, registered)) return;
    if (!registered.contains(high) || !registered.at(low).is_number() || !registered.at(high).is_number()) return;
    plan.protocol.equivalenceBounds = {registered.at(low), registered.at(high)};
    plan.power = analyse::questionPowers(plan.protocol);
}

/// By the log: an erasure takes answers away, but not that they were given.
bool isAnythingKnown(const database::StudyStore& store)
{
    return store.firstEventOfKind("answered").has_value() || store.unblinding().has_value();
}

RegistrationStamp stampFor(const database::StudyStore& store, const PreregistrationCall& call,
                           const std::vector<PreregistrationRecord>& earlier, std::vector<std::string> changes)
{
    // By the log: an erasure takes answers away, but not that they were given.
    const std::size_t given = store.eventsAfter(0, "answered"), kept = store.answerCount();
    RegistrationStamp stamp{static_cast<int>(earlier.size()) + 1,
                            call.wallTime,
                            call.who,
                            given,
                            store.unblinding().has_value(),
                            {},
                            std::move(changes),
                            given - std::min(given, kept)};
    for (const auto& record : earlier) stamp.earlierHashes.push_back(record.jsonSha256());
    return stamp;
}

PreregistrationRecord recordOf(const StudyPlan& plan, const RegistrationStamp& stamp)
{
    PreregistrationRecord record{stamp.number, stamp.answersBefore, stamp.afterUnblinding, stamp.who, planText(plan, stamp),
                                 {},           stamp.time};
    record.json = planJson(plan, stamp, record.textSha256());
    return record;
}

void requireUtf8(const std::string& who)
{
    try {
        (void)ordered_json(who).dump();
    } catch (const ordered_json::exception&) {
        throw protocols::badInput({"the name is not valid UTF-8", "--who", "UTF-8 text", "type the name again"});
    }
}

fs::path inOut(const PreregistrationCall& call, const fs::path& file) { return call.out / file.filename(); }

/// Before the plan is recorded: a folder that cannot be made ends the call while nothing is registered.
void makeOut(const PreregistrationCall& call)
{
    if (!call.out.empty()) protocols::makeFolders(call.out);
}

void writeFiles(const database::StudyStore& store, const PreregistrationCall& call,
                const std::vector<PreregistrationRecord>& records, Preregistered& done)
{
    for (const auto& record : records)
        for (const auto& one : filesOf(store.folder(), record)) writeMissing(one, done.written);
    if (call.out.empty()) return;
    for (const auto& one : filesOf(store.folder(), records.back()))
        writeMissing({inOut(call, one.file), one.bytes}, done.written);
}

}  // namespace

Preregistered preregister(database::StudyStore& store, const PreregistrationCall& call)
{
    requireUtf8(call.who);
    StudyPlan plan = planOf(store, call.program);
    std::vector<PreregistrationRecord> records = preregistrationsOf(store);
    for (const auto& record : records)
        for (const auto& one : filesOf(store.folder(), record)) requireUnaltered(one);

    Preregistered done;
    if (!records.empty()) {
        const ordered_json before = registeredJson(store, records.back());
        keepRegisteredBounds(store, before, plan);
        const ordered_json now = plannedPart(plan);
        done.changes = changesBetween(before["plan"], now);
        // Known answers make a late amendment, which nobody has asked for.
        if (isAnythingKnown(store) && onlyRulesDiffer(before["plan"], now, done.changes)) done.changes.clear();
    }
    done.isNew = records.empty() || !done.changes.empty();
    makeOut(call);
    if (done.isNew) {
        const auto record = recordOf(plan, stampFor(store, call, records, done.changes));
        for (const auto& one : filesOf(store.folder(), record)) {
            requireAbsent(one.file);
            if (!call.out.empty()) requireAbsent(inOut(call, one.file));
        }
        recordPreregistration(store, record);
        records.push_back(record);
    } else if (!call.out.empty()) {
        for (const auto& one : filesOf(store.folder(), records.back())) requireUnaltered({inOut(call, one.file), one.bytes});
    }
    done.record = records.back();
    for (const auto& one : filesOf(store.folder(), done.record)) done.files.push_back(one.file);
    writeFiles(store, call, records, done);
    return done;
}

}  // namespace study::making
