#include "database/server/server_replies.h"

#include <QDateTime>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "database/stored_texts.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"

namespace database {

namespace {

using Json = nlohmann::json;

constexpr std::string_view familiarisationPrefix = "familiarisation:";
constexpr int mostSlots = 100'000;  ///< more than any protocol has participants

protocols::Error unreadable(const std::string& what, const std::string& where)
{
    return protocols::workFailed(
        {"the server's reply cannot be read: " + what, where, "", "use the version of this program that moved the study there"});
}

template <class Read>
auto reading(const std::string& where, const Read& read)
{
    try {
        return read();
    } catch (const Json::exception& fault) {
        throw unreadable(fault.what(), where);
    } catch (const std::out_of_range& fault) {
        throw unreadable(fault.what(), where);
    }
}

std::string replyText(const Json& object, const char* field)
{
    const auto found = object.find(field);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<std::string> replyTexts(const Json& object, const char* field)
{
    const Json& list = object.at(field);
    return list.is_string() ? textsOf(list.get<std::string>()) : list.get<std::vector<std::string>>();
}

/// A whole number of a reply. Throws std::out_of_range where it does not fit: the library would take 4294967297 for 1.
template <class Whole>
Whole replyNumber(const Json& object, const char* field)
{
    const Json& value = object.at(field);
    const bool isUnsigned = value.is_number_unsigned();
    const bool fits = isUnsigned ? std::in_range<Whole>(value.get<std::uint64_t>())
                                 : value.is_number_integer() && std::in_range<Whole>(value.get<std::int64_t>());
    if (!fits) throw std::out_of_range(std::string(field) + " is no whole number that fits");
    return value.get<Whole>();
}

int replyInt(const Json& object, const char* field) { return replyNumber<int>(object, field); }
std::int64_t replyInt64(const Json& object, const char* field) { return replyNumber<std::int64_t>(object, field); }

LogHead headIn(const Json& reply)
{
    const Json& head = reply.at("head");
    return {replyInt64(head, "sequence"), head.at("hash").get<std::string>()};
}

protocols::BlindedTrial trialIn(const Json& json)
{
    protocols::BlindedTrial trial;
    trial.number = {replyInt(json, "number")};
    trial.phase = replyInt(json, "phase");
    if (trial.phase < 0) throw std::out_of_range("phase is negative");
    trial.presentationCode = protocols::PresentationCode(json.at("presentation_code").get<std::string>());
    trial.instruction = protocols::InstructionId(replyText(json, "instruction"));
    trial.aim = protocols::speedAimNamed(replyText(json, "aim"));
    if (const auto deadline = json.find("deadline_ms"); deadline != json.end() && deadline->is_number())
        trial.deadlineMs = replyInt(json, "deadline_ms");
    if (json.contains("alternatives")) trial.alternatives = fabricsOf(replyText(json, "alternatives"));
    trial.sealedCode = protocols::SealedCode(replyText(json, "sealed_code"));
    return trial;
}

std::vector<PlaceSeen> placesIn(const Json& reply)
{
    std::vector<PlaceSeen> places;
    for (const Json& one : reply.at("places")) {
        PlaceSeen place{replyInt(one, "slot"),
                        stateNamed(one.at("state").get<std::string>()),
                        {},
                        ParticipantKind::Human,
                        replyInt(one, "answers")};
        if (place.state != SlotState::Free) {
            place.participant = one.at("participant").get<std::string>();
            place.kind = kindNamed(one.at("kind").get<std::string>());
        }
        places.push_back(std::move(place));
    }
    return places;
}

/// Returns its answers.
int countPlace(ServerProgress& progress, const PlaceSeen& place)
{
    switch (place.state) {
        case SlotState::Free:
            ++progress.free;
            break;
        case SlotState::Started:
            ++progress.started;
            break;
        case SlotState::Finished:
            ++progress.finished;
            break;
        case SlotState::Withdrawn:
            ++progress.withdrawn;
            break;
    }
    return place.answers;
}

}  // namespace

protocols::SealedCode familiarisationCode(int position)
{
    return protocols::SealedCode(std::string(familiarisationPrefix) + std::to_string(position));
}

std::optional<int> familiarisationPosition(const protocols::SealedCode& code)
{
    const std::string_view text = code.value;
    if (!text.starts_with(familiarisationPrefix)) return std::nullopt;
    int position = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + familiarisationPrefix.size(), end, position);
    return read.ec == std::errc() && read.ptr == end ? std::optional(position) : std::nullopt;
}

nlohmann::json replyFrom(std::string_view text, const std::string& where)
{
    try {
        return protocols::parseStrictJson(text, "the reply");
    } catch (const protocols::Error& fault) {
        throw unreadable(fault.what(), where);
    }
}

StudyReply studyReplyFrom(const Json& reply, const std::string& where)
{
    return reading(where, [&] {
        StudyReply joined;
        StudyFacts& facts = joined.facts;
        facts.name = reply.at("name").get<std::string>();
        facts.protocolJson = reply.at("protocol_json").get<std::string>();
        facts.protocolSha256 = reply.at("protocol_sha256").get<std::string>();
        facts.hasPassphrase = reply.at("has_passphrase").get<bool>();
        facts.datasetProcedural = reply.at("dataset_procedural").get<bool>();
        facts.stamps = replyTexts(reply, "stamps");
        facts.createdAt = reply.at("created_at").get<std::string>();
        facts.programVersion = reply.at("made_with_program").get<std::string>();
        for (const Json& fabric : reply.at("fabrics")) {
            facts.fabrics.emplace_back(fabric.at("id").get<std::string>());
            facts.fabricNames[facts.fabrics.back()] = fabric.at("name").get<std::string>();
        }
        for (const Json& item : reply.at("familiarisation"))
            facts.familiarisation.push_back(
                {item.at("name").get<std::string>(), familiarisationCode(replyInt(item, "position"))});
        joined.protocol = {replyInt(reply, "protocol_version"), facts.protocolJson, facts.protocolSha256, {}, {}, {}};
        joined.head = headIn(reply);
        joined.givesTickets = reply.at("images_to") == "display";
        return joined;
    });
}

ClaimReply claimReplyFrom(const Json& reply, const std::string& where, const std::string& participant)
{
    return reading(where, [&] {
        ClaimReply place;
        place.slot = replyInt(reply, "slot");
        if (place.slot < 1 || place.slot > mostSlots)
            throw protocols::workFailed({"the server gave slot " + std::to_string(place.slot), where, "a slot of the study",
                                         "ask the owner of the study to run vis2hap verify"});
        place.state = stateNamed(replyText(reply, "state"));
        place.protocolVersion = replyInt(reply, "protocol_version");
        place.olderProtocol = replyText(reply, "protocol_json");
        for (const auto& [fabric, code] : reply.at("swatches").get<std::map<std::string, std::string>>())
            place.swatches[protocols::FabricId(fabric)] = code;
        for (const Json& trial : reply.at("trials")) {
            place.trials.push_back(trialIn(trial));
            if (const int number = place.trials.back().number.value; number != static_cast<int>(place.trials.size()))
                throw unreadable("trial " + std::to_string(number) + " at place " + std::to_string(place.trials.size()), where);
        }
        for (const Json& event : reply.at("events"))
            place.events.push_back({replyInt64(event, "sequence"), protocols::ParticipantId(participant),
                                    replyInt(event, "sitting"), event.at("kind").get<std::string>(),
                                    event.at("payload").get<std::string>(), replyInt64(event, "at_ns"),
                                    event.at("wall_time").get<std::string>()});
        place.head = headIn(reply);
        return place;
    });
}

protocols::BlindedTrial trialFrom(const Json& reply, const std::string& where, protocols::TrialNumber asked)
{
    protocols::BlindedTrial trial = reading(where, [&] { return trialIn(reply); });
    if (trial.number == asked) return trial;
    throw unreadable("trial " + std::to_string(trial.number.value) + " in place of trial " + std::to_string(asked.value), where);
}

LogHead headFrom(const Json& reply, const std::string& where)
{
    return reading(where, [&] { return headIn(reply); });
}

std::int64_t entryNumberFrom(const Json& reply, const std::string& where)
{
    return reading(where, [&] { return replyInt64(reply, "event"); });
}

std::vector<PlaceSeen> placesFrom(const Json& reply, const std::string& where)
{
    return reading(where, [&] { return placesIn(reply); });
}

ServerProgress progressFrom(const Json& reply, const std::string& where)
{
    return reading(where, [&] {
        ServerProgress progress;
        progress.places = placesIn(reply);
        std::int64_t answers = 0;
        for (const PlaceSeen& place : progress.places) answers += countPlace(progress, place);
        if (answers < 0 || answers > std::numeric_limits<int>::max()) throw unreadable("impossible counts of answers", where);
        progress.answers = static_cast<int>(answers);
        for (const Json& one : reply.at("stations"))
            progress.stations.push_back({one.at("station").get<std::string>(), one.at("login").get<std::string>(),
                                         replyText(one, "participant"), one.at("live").get<bool>(), replyInt(one, "queue_length"),
                                         replyInt(one, "last_seen_seconds"), replyText(one, "program")});
        // A study that an earlier version moved there does not give it.
        if (const auto owed = reply.find("owed"); owed != reply.end())
            for (const Json& one : *owed)
                progress.owed.push_back(
                    {one.at("station").get<std::string>(), replyText(one, "participant"), replyInt(one, "queue_length")});
        progress.head = textOf(headIn(reply));
        return progress;
    });
}

std::chrono::seconds clockAheadOf(const Json& sign, std::chrono::system_clock::time_point asked,
                                  std::chrono::system_clock::time_point answered)
{
    const auto now = sign.find("now");
    if (now == sign.end() || !now->is_string()) return {};
    const QDateTime time = QDateTime::fromString(QString::fromStdString(now->get<std::string>()), Qt::ISODateWithMs);
    if (!time.isValid()) return {};
    // The year 2255: a later time does not fit into a 64-bit number of nanoseconds.
    constexpr qint64 latestMs = 9'000'000'000'000;
    const std::chrono::system_clock::time_point server{
        std::chrono::milliseconds(std::clamp<qint64>(time.toMSecsSinceEpoch(), 0, latestMs))};
    const auto ahead = server < asked ? asked - server : server > answered ? answered - server : answered - answered;
    return std::chrono::duration_cast<std::chrono::seconds>(ahead);
}

}  // namespace database
