#include "database/server/station_store.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "database/server/entry_json.h"
#include "database/server/server_connection.h"
#include "database/server/server_replies.h"
#include "database/stored_texts.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

constexpr auto rest = 2000ms;  ///< after a lost connection, until an operator's step tries again
constexpr auto nearlyNothing = 0ms;
constexpr std::size_t keptImages = 4;
constexpr const char* joinAgain = "VH205";  ///< this connection has no claim on the participant: the server began anew

/// Whether the server may take the same entry later: it is busy, or the study is being moved.
bool passes(const ServerRefusal& refusal) { return refusal.rule() == "VH206" || refusal.rule().starts_with("VH3"); }

ServerNote noteOf(const StudyFolder& folder)
{
    if (auto note = readServerNote(folder.folder)) return *note;
    throw protocols::badInput({"this folder belongs to no study on a server", folder.folder.string(), "a folder with server.json",
                               "join the study with vis2hap study join ADDRESS"});
}

}  // namespace

StationStore::StationStore(const StudyFolder& folder, ServerPatience patience)
    : m_folder(folder), m_patience(patience), m_lock(folder), m_note(noteOf(folder)), m_queue(folder)
{
    connectNow();
    sendWaiting();
}

StationStore::~StationStore()
{
    if (!m_link) return;
    try {
        m_link->call("leave", {}, m_patience.answer);
    } catch (const std::exception&) {
        // The server frees the participant when it has heard nothing for a while.
    }
}

QVariantList StationStore::joining() const
{
    return {toQt(m_note.station), toQt(m_note.token), QStringLiteral("vis2hap " VIS2HAP_VERSION)};
}

void StationStore::connectNow()
{
    m_attempt.reset();
    auto link = std::make_unique<ServerLink>(serverAddressFrom(m_note.address));
    const ServerReply joined = link->call("join_study", joining(), m_patience.presentation);
    m_link = std::move(link);
    m_fault.clear();
    takeStudy(joined.json);
}

void StationStore::takeStudy(const Json& reply)
{
    StudyReply joined = studyReplyFrom(reply, m_note.address);
    joined.facts.swatches = std::move(m_facts.swatches);  // of the participant at work here
    m_facts = std::move(joined.facts);
    m_versions = {joined.protocol};
    m_head = joined.head;
    m_givesTickets = joined.givesTickets;
    m_isClaimed = false;
    // A station's own folder follows the study; that of the owner is compared with it before each session.
    if (!m_note.isOwner && protocols::readIfPossible(m_folder.protocol()) != m_facts.protocolJson)
        protocols::writeWholeFile(m_folder.protocol(), m_facts.protocolJson);
}

Json StationStore::asked(const char* function, const QVariantList& arguments) const
{
    if (!m_link) throw away();
    try {
        return m_link->call(function, arguments, m_patience.presentation).json;
    } catch (const ServerAway& fault) {
        loseLink(fault.what());
        throw;
    }
}

ServerAway StationStore::away() const
{
    return ServerAway({"the server cannot be reached", m_note.address, "", "wait until it can be reached again, then go on"});
}

void StationStore::loseLink(const std::string& why) const
{
    m_link.reset();
    m_fault = why;
    m_lostAt = std::chrono::steady_clock::now();
}

void StationStore::requireLink()
{
    if (m_link) return;
    // Nobody waits twice for the same cut. refresh() goes on trying.
    if (std::chrono::steady_clock::now() - m_lostAt < rest) throw away();
    connectNow();
    sendWaiting();
    if (!m_participant.empty()) claim(m_participant, m_kind);
}

Json StationStore::overview() const
{
    if (m_link) try {
            m_overview = asked("overview");
        } catch (const ServerAway&) {
            if (m_overview.is_null()) throw;  // else what was known last
        }
    return m_overview;
}

std::vector<Slot> StationStore::slots() const
{
    std::vector<Slot> slots;
    for (const PlaceSeen& place : placesFrom(overview(), m_note.address))
        if (place.state != SlotState::Withdrawn)
            slots.push_back({place.slot, place.state, protocols::ParticipantId(place.participant), place.kind});
    return slots;
}

std::vector<Enrolment> StationStore::enrolments() const
{
    std::vector<Enrolment> enrolments;
    for (const PlaceSeen& place : placesFrom(overview(), m_note.address))
        if (place.state != SlotState::Free)
            enrolments.push_back({protocols::ParticipantId(place.participant), place.slot, place.kind, place.state,
                                  place.participant == m_participant ? m_protocolVersion : m_versions.back().version});
    return enrolments;
}

std::map<protocols::ParticipantId, int> StationStore::answerCounts() const
{
    std::map<protocols::ParticipantId, int> counts;
    for (const PlaceSeen& place : placesFrom(overview(), m_note.address))
        if (place.state != SlotState::Free) counts[protocols::ParticipantId(place.participant)] = place.answers;
    return counts;
}

protocols::ParticipantId StationStore::nextParticipantId() const
{
    const auto taken = enrolments();
    for (int number = 1;; ++number) {
        const protocols::ParticipantId id((number < 10 ? "P0" : "P") + std::to_string(number));
        if (std::ranges::none_of(taken, [&](const Enrolment& one) { return one.participant == id; })) return id;
    }
}

void StationStore::claim(const std::string& participant, const std::string& kind)
{
    const Json claimed = asked("claim", {toQt(participant), toQt(kind)});
    if (m_participant != participant) m_events.clear();
    m_participant = participant;
    m_kind = kind;
    takeClaim(claimed);
}

void StationStore::takeClaim(const Json& reply)
{
    ClaimReply place = claimReplyFrom(reply, m_note.address, m_participant);
    m_slot = place.slot;
    m_slotState = place.state;
    m_protocolVersion = place.protocolVersion;
    if (m_protocolVersion != m_versions.back().version && m_versions.front().version != m_protocolVersion)
        m_versions.insert(m_versions.begin(), {m_protocolVersion, place.olderProtocol, {}, {}, {}, {}});
    m_facts.swatches.clear();
    if (!place.swatches.empty()) {
        m_facts.swatches.resize(static_cast<std::size_t>(m_slot));
        m_facts.swatches.back() = std::move(place.swatches);
    }
    m_trials = std::move(place.trials);
    // Entries that wait belong to the log, though the server does not know them yet.
    if (m_queue.size() == 0 || m_events.size() < place.events.size()) m_events = std::move(place.events);
    m_isClaimed = true;
    m_head = place.head;
}

Slot StationStore::enrol(const protocols::ParticipantId& participant, ParticipantKind kind)
{
    requireLink();
    sendWaiting();
    claim(participant.value, nameOf(kind));
    return {m_slot, m_slotState, participant, kind};
}

std::vector<protocols::BlindedTrial> StationStore::trials(int slot) const
{
    return slot == m_slot ? m_trials : std::vector<protocols::BlindedTrial>();
}

std::vector<EventRecord> StationStore::events(const protocols::ParticipantId& participant) const
{
    return participant.value == m_participant ? m_events : std::vector<EventRecord>();
}

protocols::BlindedTrial StationStore::dueTrial(int, protocols::TrialNumber number)
{
    requireLink();
    try {
        const ServerReply reply = m_link->callForImage("presentation", {number.value}, m_patience.presentation);
        protocols::BlindedTrial trial = trialFrom(reply.json, m_note.address, number);
        if (m_givesTickets || m_images.size() >= keptImages) m_images.clear();  // only the last ticket holds
        m_images[trial.sealedCode] = {reply.image, reply.key};
        m_trials.at(static_cast<std::size_t>(number.value) - 1) = trial;
        return trial;
    } catch (const ServerAway& fault) {
        loseLink(fault.what());
        throw;
    }
}

ReleasedImage StationStore::image(const protocols::SealedCode& code)
{
    if (const auto known = m_images.find(code); known != m_images.end()) return known->second;
    if (const auto position = familiarisationPosition(code)) {
        requireLink();
        const ServerReply reply = m_link->callForImage("familiarisation_image", {*position}, m_patience.presentation);
        return m_images[code] = {reply.image, reply.key};
    }
    const auto trial = std::ranges::find(m_trials, code, &protocols::BlindedTrial::sealedCode);
    if (code.empty() || trial == m_trials.end())
        throw protocols::workFailed({"the server has not given out this presentation", m_note.address, "", ""});
    (void)dueTrial(m_slot, trial->number);
    return m_images.at(code);
}

std::int64_t StationStore::send(const AnswerQueue::Entry& entry)
{
    const ServerReply reply = m_link->call("store", {toQt(entry.json)}, m_patience.answer);
    m_head = headFrom(reply.json, m_note.address);
    return entryNumberFrom(reply.json, m_note.address);
}

void StationStore::append(const Append& entry)
{
    const AnswerQueue::Entry waiting{0, entry.event.participant.value, m_kind,
                                     entryJson(entry, static_cast<int>(m_events.size()))};
    EventRecord event = entry.event;
    event.sequence = 0;
    if (m_link && m_queue.size() == 0) {
        try {
            event.sequence = send(waiting);
            m_events.push_back(std::move(event));
            return;
        } catch (const ServerAway& fault) {
            loseLink(fault.what());
        } catch (const ServerRefusal& refusal) {
            if (refusal.rule() != joinAgain) throw;
            loseLink(refusal.what());
        }
    }
    m_queue.put(waiting);
    m_events.push_back(std::move(event));
}

/// Every entry is sent under a claim on its participant. An entry that the server refuses must not keep back those of others.
void StationStore::sendWaiting()
{
    while (const auto entry = m_queue.first()) {
        try {
            if (!m_isClaimed || m_participant != entry->participant) claim(entry->participant, entry->kind);
            send(*entry);
            m_queue.remove(entry->number);
        } catch (const ServerAway& fault) {
            loseLink(fault.what());
            throw;
        } catch (const ServerRefusal& refusal) {
            if (passes(refusal)) {
                loseLink(refusal.what());
                throw;
            }
            setAside(*entry, refusal.what());
        }
    }
}

void StationStore::setAside(const AnswerQueue::Entry& first, const std::string& why)
{
    const std::filesystem::path file =
        m_folder.folder / ("not-sent-" + first.participant + "-" + std::to_string(first.number) + ".json");
    std::string lines;
    for (auto entry = std::optional(first); entry && entry->participant == first.participant; entry = m_queue.first()) {
        lines += entry->json + "\n";
        protocols::writeWholeFile(file, lines, protocols::Sync::Now, protocols::Readers::OwnerOnly);
        m_queue.remove(entry->number);
    }
    m_fault = "The server refused answers of " + first.participant + " that waited here (" + why + "). They are kept in " +
              file.string() + ".";
}

void StationStore::storeLatency(const OperatorLatency& run)
{
    requireOperator(run, m_folder.folder.string());
    requireLink();
    (void)asked("record_latency", {toQt(latencyPayload(run).dump()), toQt(wallTimeNow())});
}

StationStore::Link StationStore::link() const { return {m_link != nullptr, m_queue.size(), m_note.station, m_fault}; }

void StationStore::refresh()
{
    const auto isReady = [](const std::future<ServerReply>& reply) {
        return reply.valid() && reply.wait_for(nearlyNothing) == std::future_status::ready;
    };
    try {
        if (m_link) {
            const auto now = std::chrono::steady_clock::now();
            if (isReady(m_alive)) (void)m_alive.get();
            if (m_alive.valid() && now - m_signAt > m_patience.answer)
                throw ServerAway({"the server does not answer", m_note.address, "", "check the network and the server"});
            if (m_alive.valid()) return;
            m_signAt = now;
            m_alive = m_link->start("sign_of_life", {static_cast<int>(m_queue.size())});
            return;
        }
        m_alive = {};
        if (!m_attempt) {
            m_attempt = std::make_unique<ServerLink>(serverAddressFrom(m_note.address));
            m_joining = m_attempt->start("join_study", joining());
        }
        if (!isReady(m_joining)) return;
        const ServerReply joined = m_joining.get();
        m_link = std::move(m_attempt);
        m_fault.clear();
        takeStudy(joined.json);
        sendWaiting();
        if (!m_participant.empty()) claim(m_participant, m_kind);
    } catch (const protocols::Error& fault) {
        m_attempt.reset();
        loseLink(fault.what());
    }
}

}  // namespace database
