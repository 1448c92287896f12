#include "study/records/study_status.h"

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "database/disk/server_note.h"
#include "database/server/server_progress.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/records/balance.h"
#include "reports/analysis/quality_flags.h"
#include "reports/data/registration.h"
#include "study/records/log_heads.h"
#include "study/records/realised_balance.h"
#include "study/records/stored_study.h"

namespace study::records {

namespace {

using nlohmann::ordered_json;

/// What a participant has answered so far.
struct AnswerCounts {
    int answered = 0, voided = 0, voidedPresentations = 0, corrected = 0, flagged = 0;
};
using CountsByParticipant = std::map<protocols::ParticipantId, AnswerCounts>;

CountsByParticipant countsOf(const database::StudyStore& store, const std::vector<database::CurrentAnswer>& answers)
{
    CountsByParticipant counts;
    for (const auto& answer : answers) {
        AnswerCounts& own = counts[answer.participant];
        ++(answer.voided ? own.voided : own.answered);
        own.corrected += answer.corrections > 0;
    }
    for (const auto& [participant, presentations] : store.voidedPresentations())
        counts[participant].voidedPresentations = presentations;
    for (const auto& flag : store.flags()) ++counts[flag.participant].flagged;
    return counts;
}

ordered_json answersOf(const protocols::ParticipantId& participant, const CountsByParticipant& counts)
{
    const auto found = counts.find(participant);
    const AnswerCounts own = found == counts.end() ? AnswerCounts{} : found->second;
    return {{"answers", own.answered},
            {"voided", own.voided},
            {"voided_presentations", own.voidedPresentations},
            {"corrected", own.corrected},
            {"flagged", own.flagged}};
}

/// Slots of a study on a server that its owner has to release.
std::set<int> heldSlotsOf(const database::StudyStore& store)
{
    if (store.serverFolder().empty()) return {};
    const auto note = database::readServerNote(store.serverFolder());
    if (!note) return {};
    return heldPlaces(database::progressOf(database::serverAddressFrom(note->address)));
}

ordered_json slotsOf(const database::StudyStore& store, const CountsByParticipant& counts)
{
    const std::set<int> held = heldSlotsOf(store);
    ordered_json rows = ordered_json::array();
    for (const auto& slot : store.slots()) {
        ordered_json row{{"slot", slot.number}, {"state", nameOf(slot.state)}};
        if (slot.state != database::SlotState::Free) {
            row["participant"] = slot.participant.value;
            row["kind"] = nameOf(slot.kind);
            row.update(answersOf(slot.participant, counts));
        } else if (held.contains(slot.number)) {
            row["held"] = true;
        }
        rows.push_back(row);
    }
    return rows;
}

ordered_json withdrawnOf(const database::StudyStore& store, const CountsByParticipant& counts)
{
    ordered_json rows = ordered_json::array();
    for (const auto& enrolment : store.enrolments())
        if (enrolment.state == database::SlotState::Withdrawn) {
            ordered_json row{
                {"slot", enrolment.slot}, {"participant", enrolment.participant.value}, {"kind", nameOf(enrolment.kind)}};
            row.update(answersOf(enrolment.participant, counts));
            rows.push_back(row);
        }
    return rows;
}

ordered_json flagsOf(const reports::StudyData& data)
{
    ordered_json rows = ordered_json::array();
    for (const reports::QualityFlag& flag : reports::qualityFlags(data))
        rows.push_back({{"participant", flag.participant ? ordered_json(*flag.participant) : ordered_json()},
                        {"flag", nameOf(flag.kind)},
                        {"why", flag.why}});
    return rows;
}

__attribute__((format(printf, 1, 2))) std::string line(const char* format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    std::string text(static_cast<std::size_t>(std::max(0, std::vsnprintf(nullptr, 0, format, arguments))), '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    va_end(arguments);
    return text;
}

/// A text of the study, which somebody may have altered, so that it stays in its line.
std::string word(const ordered_json& row, const char* field) { return protocols::printable(row[field].get<std::string>()); }

std::string peopleText(const ordered_json& status)
{
    std::string text;
    const int expected = status["answers_per_participant"];
    for (const auto& slot : status["slots"]) {
        if (slot["state"] == "free") {
            text += line("  slot %2d  %s\n", slot["slot"].get<int>(),
                         slot.contains("held") ? "waits for the owner: `vis2hap server roles ADDRESS --release-held`" : "free");
            continue;
        }
        text += line("  slot %2d  %-8s %-9s %-9s %d of %d answers, %d presentations voided, %d corrected, %d flagged\n",
                     slot["slot"].get<int>(), word(slot, "participant").c_str(), word(slot, "kind").c_str(),
                     word(slot, "state").c_str(), slot["answers"].get<int>(), expected, slot["voided_presentations"].get<int>(),
                     slot["corrected"].get<int>(), slot["flagged"].get<int>());
    }
    for (const auto& one : status["withdrawn"])
        text += line("  withdrew: %s (slot %d, %d answers, not analysed)\n", word(one, "participant").c_str(),
                     one["slot"].get<int>(), one["answers"].get<int>());
    return text;
}

ordered_json preregistrationOf(const reports::StudyData& data)
{
    if (data.registrations.empty()) return {{"registered", false}};
    const reports::Registration& first = data.registrations.front();
    ordered_json json{{"registered", true},
                      {"time", first.time},
                      {"sha256", first.sha256},
                      {"answers_before", first.answersBefore},
                      {"after_unblinding", first.afterUnblinding}};
    json["amendments"] = data.registrations.size() - 1;
    return json;
}

std::string preregistrationText(const ordered_json& registered)
{
    if (!registered["registered"].get<bool>()) return "not preregistered (`vis2hap study preregister` registers the plan)\n";
    std::string text = line("preregistered on %s, %s, SHA-256 %s\n", word(registered, "time").c_str(),
                            reports::timingText(registered["answers_before"], registered["after_unblinding"]).c_str(),
                            word(registered, "sha256").c_str());
    if (const int amendments = registered["amendments"]; amendments > 0) text += line("  amendments: %d\n", amendments);
    return text;
}

std::string balanceText(const ordered_json& ranges)
{
    std::string text;
    for (const auto& range : ranges)
        text += line("  %s: %d to %d\n", word(range, "what").c_str(), range["min"].get<int>(), range["max"].get<int>());
    return text;
}

/// The stored ranges. Throws workFailed where somebody altered them.
ordered_json plannedBalanceIn(const database::StudyFacts& facts)
{
    auto planned = protocols::storedOrderedJson(facts.plannedBalance);
    const bool isNamed = planned.is_object() && (!planned.contains("of") || planned["of"].is_string());
    // Development versions stored the balance of the study's own design.
    if (isNamed && planned.value("of", "") != protocols::balanceOfOthers) planned = {{"balance", ordered_json::array()}};
    const auto isCount = [](const ordered_json& range, const char* field) {
        return range.contains(field) && range[field].is_number_unsigned() &&
               std::in_range<int>(range[field].get<std::uint64_t>());
    };
    const auto isRange = [&](const ordered_json& range) {
        return range.is_object() && range.contains("what") && range["what"].is_string() && isCount(range, "min") &&
               isCount(range, "max");
    };
    const bool isSound = isNamed && planned.contains("balance") && planned["balance"].is_array() &&
                         std::ranges::all_of(planned["balance"], isRange);
    if (isSound) return planned;
    throw protocols::workFailed({"the planned balance of the study cannot be read", "study.db", "ranges of counts",
                                 "see `vis2hap verify`; restore the study from a backup"});
}

}  // namespace

ordered_json statusOf(const database::StudyStore& store, const database::Passphrase& passphrase)
{
    const auto facts = store.facts();
    const auto protocol = latestProtocolOf(store);
    const auto answers = store.answers();
    const CountsByParticipant counts = countsOf(store, answers);
    ordered_json json{{"schema", "vis2hap.status/1"}, {"study", facts.name}, {"protocol_sha256", facts.protocolSha256}};
    json["protocol_versions"] = store.protocolVersions().size();
    json["blinded"] = !store.unblinding().has_value();
    json["answers_per_participant"] = protocol.answersPerParticipant();
    json["minutes_per_participant"] = protocol.minutesPerParticipant();
    json["sittings_per_participant"] = protocol.sittingsPerParticipant();
    json["slots"] = slotsOf(store, counts);
    json["withdrawn"] = withdrawnOf(store, counts);
    std::map<std::string, int> kinds{{"human", 0}, {"scripted", 0}, {"simulated", 0}}, states;
    for (const auto& slot : store.slots())
        if (slot.state != database::SlotState::Free) ++kinds[nameOf(slot.kind)];
    for (const auto& slot : json["slots"]) ++states[slot.contains("held") ? "held" : slot.at("state").get<std::string>()];
    json["kinds"] = kinds;
    json["states"] = states;
    json.update(plannedBalanceIn(facts));
    const auto key = readKeyForAggregates(store, passphrase);
    const bool isShown = key && store.unblinding();  // the difference of two such counts names a trial
    json["balance_presented"] = isShown ? jsonOf(realisedBalance(store, answers, protocol, *key))["balance"] : ordered_json();
    if (!isShown) json["why"] = {{"balance_presented", "shown after the unblinding, because its counts name single trials"}};
    json["passphrase"] = facts.hasPassphrase;
    json["head"] = headTextOf(store);
    json["stamps"] = stampsOf(store, facts);
    const reports::StudyData data = store.unblinding() ? *studyData(store, passphrase, answers) : sealedStudyData(store, answers);
    json["preregistration"] = preregistrationOf(data);
    json["quality"] = flagsOf(data);
    return json;
}

std::string textOf(const ordered_json& status)
{
    std::string text = line("%s (%s)\n", word(status, "study").c_str(), status["blinded"].get<bool>() ? "blinded" : "unblinded");
    text += line("  planned: about %.0f minutes for each participant, sittings: %d\n",
                 status["minutes_per_participant"].get<double>(), status["sittings_per_participant"].get<int>());
    text += preregistrationText(status["preregistration"]);
    text += peopleText(status);
    if (!status["balance"].empty())
        text += "balance of other running orders by the same rules (those of this study are sealed):\n" +
                balanceText(status["balance"]);
    if (status["balance_presented"].is_null())
        text += "balance of the presentations so far: " + word(status["why"], "balance_presented") + "\n";
    else if (!status["balance_presented"].empty())
        text += "balance of the presentations so far:\n" + balanceText(status["balance_presented"]);
    for (const auto& stamp : status["stamps"]) text += "note: " + protocols::printable(stamp.get<std::string>()) + "\n";
    for (const auto& flag : status["quality"])
        text += "flag: " + (flag["participant"].is_string() ? word(flag, "participant") + " " : std::string()) +
                word(flag, "flag") + ": " + word(flag, "why") + "\n";
    text += "log head " + word(status, "head") + "\n";
    return text;
}

}  // namespace study::records
