#include "database/server/station_store.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "database/server/entry_json.h"
#include "database/server/presented_trial.h"
#include "database/server/server_connection.h"
#include "database/server/server_replies.h"
#include "database/server/station_note.h"
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
constexpr const char* goneOn = "VH204";     ///< the participant has other entries than this station knows
constexpr const char* joinAgain = "VH205";  ///< this connection has no claim on the participant: the server began anew

/// Whether the server may take the same entry later: it is busy, the study is being moved, or this connection must join again.
bool passes(const ServerRefusal& refusal)
{
    return refusal.rule() == joinAgain || refusal.rule() == "VH206" || refusal.rule().starts_with("VH3");
}

bool meansAway(const protocols::Error& fault) { return dynamic_cast<const ServerAway*>(&fault) != nullptr; }

/// Whether the server may answer the same question later. What a login may not do, and a study that is gone, must be seen.
bool isOfThisMoment(const protocols::Error& fault)
{
    const auto* refusal = dynamic_cast<const ServerRefusal*>(&fault);
    return fault.exitCode() == protocols::ExitCode::Environment || (refusal && passes(*refusal));
}

bool meansJoinAgain(const protocols::Error& fault)
{
    const auto* refusal = dynamic_cast<const ServerRefusal*>(&fault);
    return refusal && refusal->rule() == joinAgain;
}

}  // namespace

StationStore::StationStore(const StudyFolder& folder, ServerPatience patience)
    : m_folder(folder), m_patience(patience), m_lock(folder), m_note(noteOfStation(folder)), m_queue(folder), m_watch(m_queue)
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

/// Waits for an attempt that has begun: a second join under way would take the place of the first.
void StationStore::connectNow()
{
    if (!m_attempt) {
        m_attempt = std::make_unique<ServerLink>(serverAddressFrom(m_note.address));
        m_joining = m_attempt->start("join_study", joining());
    }
    auto attempt = std::move(m_attempt);  // given up where it does not answer in time
    if (m_joining.wait_for(m_patience.presentation) != std::future_status::ready)
        throw ServerAway({"the server does not answer", m_note.address, "", "check the network and the server"});
    const ServerReply joined = m_joining.get();
    takeLink(std::move(attempt), joined.json);
}

void StationStore::takeLink(std::unique_ptr<ServerLink> link, const Json& joined)
{
    m_link = std::move(link);
    m_alive = {};
    m_fault.clear();
    m_isRefused = false;
    takeStudy(joined);
}

void StationStore::takeStudy(const Json& reply)
{
    StudyReply joined = studyReplyFrom(reply, m_note.address);
    const bool isFirst = m_versions.empty();
    noteStudy(m_folder, m_note, joined.facts, isFirst && m_queue.size() == 0);
    if (isFirst) m_watch.begin(m_note.study);
    m_watch.see(joined.head);
    joined.facts.swatches = std::move(m_facts.swatches);  // of the participant at work here
    m_facts = std::move(joined.facts);
    m_versions = {joined.protocol};
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
    } catch (const protocols::Error& fault) {
        noteFault(fault);
        throw;
    }
}

ServerAway StationStore::away() const
{
    if (m_isRefused)
        return ServerAway({"the server takes nothing from this station now (" + m_fault + ")", m_note.address, "",
                           "remove the cause, then go on"});
    return ServerAway({"the server cannot be reached", m_note.address, "", "wait until it can be reached again, then go on"});
}

void StationStore::loseLink(const protocols::Error& why) const
{
    m_fault = why.what();
    m_isRefused = !meansAway(why);
    m_link.reset();
    m_lostAt = std::chrono::steady_clock::now();
}

void StationStore::noteFault(const protocols::Error& fault) const
{
    if (meansAway(fault) || meansJoinAgain(fault)) loseLink(fault);
}

void StationStore::requireLink()
{
    if (m_link) return;
    // Nobody waits twice for the same cut. refresh() goes on trying.
    if (std::chrono::steady_clock::now() - m_lostAt < rest) throw away();
    try {
        connectNow();
        sendWaiting();
        if (m_isOpen && !m_isClaimed) claim(m_participant, m_kind);
    } catch (const protocols::Error& fault) {
        loseLink(fault);
        throw;
    }
}

Json StationStore::overview() const
{
    if (m_link) try {
            m_overview = asked("overview");
        } catch (const protocols::Error& fault) {
            if (m_overview.is_null() || !isOfThisMoment(fault)) throw;  // else what was known last
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
    auto taken = m_queue.enrolledHere();  // the server may have lost them
    for (const Enrolment& one : enrolments()) taken.insert(one.participant.value);
    for (int number = 1;; ++number)
        if (std::string id = (number < 10 ? "P0" : "P") + std::to_string(number); !taken.contains(id))
            return protocols::ParticipantId(std::move(id));
}

void StationStore::claim(const std::string& participant, const std::string& kind)
{
    const Json claimed = asked("claim", {toQt(participant), toQt(kind)});
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
    m_isClaimed = true;
    m_watch.see(place.head);
    if (!m_isOpen) {
        m_events = std::move(place.events);
        return;
    }
    // The session that is open here knows this log only. What another station or an older copy of the server made of it is not
    // its own.
    if (const auto difference = differenceOf(m_participant, m_events, place.events))
        endSession(*difference);
    else
        std::ranges::copy(place.events, m_events.begin());
}

void StationStore::endSession(const std::string& how)
{
    if (m_stale) return;
    const std::filesystem::path kept = keepHeldLog(m_folder, m_participant, m_events);
    m_stale = protocols::workFailed({"the server " + how + ", so this session cannot go on", kept.string(),
                                     "the log that this station holds, kept in this file", "open the participant again"});
}

Slot StationStore::enrol(const protocols::ParticipantId& participant, ParticipantKind kind)
{
    m_isOpen = false;
    m_stale.reset();
    m_lock.requireInPlace();
    requireLink();
    sendWaiting();
    claim(participant.value, nameOf(kind));
    m_queue.keepEnrolled(participant.value);
    m_isOpen = true;
    return {m_slot, m_slotState, participant, kind};
}

void StationStore::enrolNew(const protocols::ParticipantId& participant, ParticipantKind kind)
{
    requireLink();
    m_watch.requireAgreement(participant, m_note.address);
    (void)enrol(participant, kind);
    if (m_events.empty()) return;
    const bool hasWithdrawn = m_slotState == SlotState::Withdrawn;
    leaveParticipant();
    if (hasWithdrawn)
        throw protocols::badInput({"participant " + participant.value + " has withdrawn", m_note.address,
                                   "a code that nobody has", "type the next free code"});
    throw protocols::badInput({participant.value + " was enrolled at another station in the meantime", m_note.address,
                               "a code that nobody has", "type the next free code, or choose the participant in the list"});
}

void StationStore::leaveParticipant()
{
    m_isOpen = false;
    m_stale.reset();
    m_participant.clear();
    m_events.clear();
    if (!m_link || !m_isClaimed) return;
    try {
        // Who joins again has no participant.
        takeStudy(m_link->call("join_study", joining(), m_patience.answer).json);
    } catch (const protocols::Error& fault) {
        loseLink(fault);
    }
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
    if (m_stale) throw *m_stale;
    try {
        const ServerReply reply = presentedTrial(*m_link, number, m_givesTickets, m_patience.presentation);
        protocols::BlindedTrial trial = trialFrom(reply.json, m_note.address, number);
        if (m_givesTickets || m_images.size() >= keptImages) m_images.clear();  // only the last ticket holds
        m_images[trial.sealedCode] = {reply.image, reply.key};
        m_trials.at(static_cast<std::size_t>(number.value) - 1) = trial;
        return trial;
    } catch (const protocols::Error& fault) {
        noteFault(fault);
        throw;
    }
}

ReleasedImage StationStore::image(const protocols::SealedCode& code)
{
    if (const auto known = m_images.find(code); known != m_images.end()) return known->second;
    if (const auto position = familiarisationPosition(code)) {
        requireLink();
        try {
            const ServerReply reply = m_link->callForImage("familiarisation_image", {*position}, m_patience.presentation);
            return m_images[code] = {reply.image, reply.key};
        } catch (const protocols::Error& fault) {
            noteFault(fault);
            throw;
        }
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
    m_watch.see(headFrom(reply.json, m_note.address));
    return entryNumberFrom(reply.json, m_note.address);
}

void StationStore::append(const Append& entry)
{
    if (m_stale) throw *m_stale;
    m_lock.requireInPlace();
    EntryToSend sent = entryToSend(entry, static_cast<int>(m_events.size()));
    const AnswerQueue::Entry waiting{0, entry.event.participant.value, m_kind, std::move(sent.json)};
    EventRecord event = entry.event;
    event.sequence = 0;
    event.payloadJson = std::move(sent.payload);  // the next claim compares it with the server's
    if (m_link && m_queue.size() == 0) {
        try {
            event.sequence = send(waiting);
            m_events.push_back(std::move(event));
            return;
        } catch (const protocols::Error& fault) {
            const auto* refusal = dynamic_cast<const ServerRefusal*>(&fault);
            if (refusal && refusal->rule() == goneOn) {
                endSession("has other entries of " + m_participant);
                throw *m_stale;
            }
            if (!meansAway(fault) && !meansJoinAgain(fault)) throw;
            loseLink(fault);
        }
    }
    m_queue.put(waiting);
    m_events.push_back(std::move(event));
}

/// Before entries are sent and after it: where the connection ends between them, the monitors and the way back know of them.
void StationStore::tellWaiting()
{
    try {
        (void)m_link->call("sign_of_life", {static_cast<int>(m_queue.size())}, m_patience.answer);
    } catch (const protocols::Error& fault) {
        loseLink(fault);
        throw;
    }
}

/// Every entry is sent under a claim on its participant. An entry that the server refuses must not keep back those of others.
/// After any other fault the link is lost, so that nothing seems to be on the server while it waits here.
void StationStore::sendWaiting()
{
    if (m_queue.size() == 0) return;
    tellWaiting();
    bool hasClaimed = false;
    while (const auto entry = m_queue.first()) {
        try {
            if (!m_isClaimed || m_participant != entry->participant) {
                claim(entry->participant, entry->kind);
                hasClaimed = true;
            }
            if (m_stale) {
                setAside(*entry, m_stale->what());
                continue;
            }
            confirmFirst(m_events, send(*entry));
            m_queue.remove(entry->number);
        } catch (const protocols::Error& fault) {
            const auto* refusal = dynamic_cast<const ServerRefusal*>(&fault);
            if (!refusal || passes(*refusal)) {
                loseLink(fault);
                throw;
            }
            setAside(*entry, fault.what());
        }
    }
    tellWaiting();
    if (hasClaimed && !m_isOpen) leaveParticipant();
}

void StationStore::setAside(const AnswerQueue::Entry& first, const std::string& why)
{
    const std::filesystem::path file = keepNotSent(m_folder, m_queue, first);
    m_setAside += (m_setAside.empty() ? "" : "\n") + ("The server refused answers of " + first.participant +
                                                      " that waited here (" + why + "). They are kept in " + file.string() + ".");
    if (m_isOpen && first.participant == m_participant) endSession("refused entries of " + m_participant);
}

void StationStore::storeLatency(const OperatorLatency& run)
{
    requireOperator(run, m_folder.folder.string());
    requireLink();
    (void)asked("record_latency", {toQt(latencyPayload(run).dump()), toQt(wallTimeNow())});
}

StationStore::Link StationStore::link() const
{
    return {m_link != nullptr,
            m_isRefused && !m_link,
            m_queue.size(),
            m_note.station,
            m_fault,
            m_setAside,
            m_stale ? m_stale->what() : std::string(),
            m_watch.lostAfter(),
            m_clockAhead};
}

void StationStore::refresh()
{
    const auto isReady = [](const std::future<ServerReply>& reply) {
        return reply.valid() && reply.wait_for(nearlyNothing) == std::future_status::ready;
    };
    try {
        if (m_link) {
            const auto now = std::chrono::steady_clock::now();
            if (isReady(m_alive))
                m_clockAhead = clockAheadOf(m_alive.get().json, m_signWallTime, std::chrono::system_clock::now());
            if (m_alive.valid() && now - m_signAt > m_patience.answer)
                throw ServerAway({"the server does not answer", m_note.address, "", "check the network and the server"});
            if (m_alive.valid()) return;
            m_signAt = now;
            m_signWallTime = std::chrono::system_clock::now();
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
        takeLink(std::move(m_attempt), joined.json);
        sendWaiting();
        if (m_isOpen && !m_isClaimed) claim(m_participant, m_kind);
    } catch (const protocols::Error& fault) {
        m_attempt.reset();
        loseLink(fault);
    }
}

}  // namespace database
