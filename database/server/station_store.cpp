#include "database/server/station_store.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "database/server/entry_json.h"
#include "database/server/server_connection.h"
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
constexpr int mostSlots = 100'000;  ///< more than any protocol has participants
constexpr const char* familiarisationPrefix = "familiarisation:";
constexpr const char* joinAgain = "VH205";  ///< this connection has no claim on the participant: the server began anew

/// Whether the server may take the same entry later: it is busy, or the study is being moved.
bool passes(const ServerRefusal& refusal) { return refusal.rule() == "VH206" || refusal.rule().starts_with("VH3"); }

ServerNote noteOf(const StudyFolder& folder)
{
    if (auto note = readServerNote(folder.folder)) return *note;
    throw protocols::badInput({"this folder belongs to no study on a server", folder.folder.string(), "a folder with server.json",
                               "join the study with vis2hap study join ADDRESS"});
}

std::string textIn(const Json& object, const char* field)
{
    const auto found = object.find(field);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::vector<std::string> textsIn(const Json& object, const char* field)
{
    const Json& list = object.at(field);
    return list.is_string() ? textsOf(list.get<std::string>()) : list.get<std::vector<std::string>>();
}

LogHead headIn(const Json& reply)
{
    const Json& head = reply.at("head");
    return {head.at("sequence").get<std::int64_t>(), head.at("hash").get<std::string>()};
}

protocols::BlindedTrial trialIn(const Json& json)
{
    protocols::BlindedTrial trial;
    trial.number = {json.at("number").get<int>()};
    trial.phase = json.at("phase").get<int>();
    trial.presentationCode = protocols::PresentationCode(json.at("presentation_code").get<std::string>());
    trial.instruction = protocols::InstructionId(textIn(json, "instruction"));
    trial.aim = protocols::speedAimNamed(textIn(json, "aim"));
    if (const auto deadline = json.find("deadline_ms"); deadline != json.end() && deadline->is_number())
        trial.deadlineMs = deadline->get<int>();
    if (json.contains("alternatives")) trial.alternatives = fabricsOf(textIn(json, "alternatives"));
    trial.sealedCode = protocols::SealedCode(textIn(json, "sealed_code"));
    return trial;
}

/// Runs what reads a reply of the server; a reply of another form comes from another version of this program.
template <class Read>
auto reading(const std::string& address, const Read& read)
{
    try {
        return read();
    } catch (const Json::exception& fault) {
        throw protocols::workFailed({"the server's reply cannot be read: " + std::string(fault.what()), address, "",
                                     "use the version of this program that moved the study there"});
    }
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

void StationStore::takeStudy(const Json& joined)
{
    reading(m_note.address, [&] {
        m_facts.name = joined.at("name").get<std::string>();
        m_facts.protocolJson = joined.at("protocol_json").get<std::string>();
        m_facts.protocolSha256 = joined.at("protocol_sha256").get<std::string>();
        m_facts.hasPassphrase = joined.at("has_passphrase").get<bool>();
        m_facts.datasetProcedural = joined.at("dataset_procedural").get<bool>();
        m_facts.stamps = textsIn(joined, "stamps");
        m_facts.createdAt = joined.at("created_at").get<std::string>();
        m_facts.programVersion = joined.at("made_with_program").get<std::string>();
        m_facts.fabrics.clear();
        for (const Json& fabric : joined.at("fabrics")) {
            m_facts.fabrics.emplace_back(fabric.at("id").get<std::string>());
            m_facts.fabricNames[m_facts.fabrics.back()] = fabric.at("name").get<std::string>();
        }
        m_facts.familiarisation.clear();
        for (const Json& item : joined.at("familiarisation"))
            m_facts.familiarisation.push_back(
                {item.at("name").get<std::string>(),
                 protocols::SealedCode(familiarisationPrefix + std::to_string(item.at("position").get<int>()))});
        m_versions = {{joined.at("protocol_version").get<int>(), m_facts.protocolJson, m_facts.protocolSha256, {}, {}, {}}};
        m_head = headIn(joined);
        m_givesTickets = joined.at("images_to") == "display";
    });
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
    const Json known = overview();
    return reading(m_note.address, [&] {
        std::vector<Slot> slots;
        for (const Json& place : known.at("places")) {
            if (textIn(place, "state") == "withdrawn") continue;
            Slot slot{place.at("slot").get<int>(), stateNamed(textIn(place, "state")), {}, ParticipantKind::Human};
            if (slot.state != SlotState::Free) {
                slot.participant = protocols::ParticipantId(textIn(place, "participant"));
                slot.kind = kindNamed(textIn(place, "kind"));
            }
            slots.push_back(slot);
        }
        return slots;
    });
}

std::vector<Enrolment> StationStore::enrolments() const
{
    const Json known = overview();
    return reading(m_note.address, [&] {
        std::vector<Enrolment> enrolments;
        for (const Json& place : known.at("places")) {
            if (textIn(place, "state") == "free") continue;
            const std::string participant = textIn(place, "participant");
            enrolments.push_back({protocols::ParticipantId(participant), place.at("slot").get<int>(),
                                  kindNamed(textIn(place, "kind")), stateNamed(textIn(place, "state")),
                                  participant == m_participant ? m_protocolVersion : m_versions.back().version});
        }
        return enrolments;
    });
}

std::map<protocols::ParticipantId, int> StationStore::answerCounts() const
{
    const Json known = overview();
    return reading(m_note.address, [&] {
        std::map<protocols::ParticipantId, int> counts;
        for (const Json& place : known.at("places"))
            if (textIn(place, "state") != "free")
                counts[protocols::ParticipantId(textIn(place, "participant"))] = place.at("answers").get<int>();
        return counts;
    });
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

void StationStore::takeClaim(const Json& claimed)
{
    reading(m_note.address, [&] {
        m_slot = claimed.at("slot").get<int>();
        if (m_slot < 1 || m_slot > mostSlots)
            throw protocols::workFailed({"the server gave slot " + std::to_string(m_slot), m_note.address, "a slot of the study",
                                         "ask the owner of the study to run vis2hap verify"});
        m_slotState = stateNamed(textIn(claimed, "state"));
        m_protocolVersion = claimed.at("protocol_version").get<int>();
        if (m_protocolVersion != m_versions.back().version && m_versions.front().version != m_protocolVersion)
            m_versions.insert(m_versions.begin(),
                              {m_protocolVersion, claimed.at("protocol_json").get<std::string>(), {}, {}, {}, {}});
        const Json& swatches = claimed.at("swatches");
        m_facts.swatches.clear();
        if (!swatches.empty()) m_facts.swatches.resize(static_cast<std::size_t>(m_slot));
        for (const auto& [fabric, code] : swatches.items())
            m_facts.swatches.back()[protocols::FabricId(fabric)] = code.get<std::string>();
        m_trials.clear();
        for (const Json& trial : claimed.at("trials")) m_trials.push_back(trialIn(trial));
        std::vector<EventRecord> events;
        for (const Json& event : claimed.at("events"))
            events.push_back({event.at("sequence").get<std::int64_t>(), protocols::ParticipantId(m_participant),
                              event.at("sitting").get<int>(), event.at("kind").get<std::string>(),
                              event.at("payload").get<std::string>(), event.at("at_ns").get<std::int64_t>(),
                              event.at("wall_time").get<std::string>()});
        // Entries that wait belong to the log, though the server does not know them yet.
        if (m_queue.size() == 0 || m_events.size() < events.size()) m_events = std::move(events);
        m_isClaimed = true;
        m_head = headIn(claimed);
    });
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
        return reading(m_note.address, [&] {
            protocols::BlindedTrial trial = trialIn(reply.json);
            if (m_givesTickets || m_images.size() >= keptImages) m_images.clear();  // only the last ticket holds
            m_images[trial.sealedCode] = {reply.image, reply.key};
            m_trials.at(static_cast<std::size_t>(number.value) - 1) = trial;
            return trial;
        });
    } catch (const ServerAway& fault) {
        loseLink(fault.what());
        throw;
    }
}

ReleasedImage StationStore::image(const protocols::SealedCode& code)
{
    if (const auto known = m_images.find(code); known != m_images.end()) return known->second;
    if (code.value.starts_with(familiarisationPrefix)) {
        requireLink();
        const int position = std::stoi(code.value.substr(std::string(familiarisationPrefix).size()));
        const ServerReply reply = m_link->callForImage("familiarisation_image", {position}, m_patience.presentation);
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
    m_head = reading(m_note.address, [&] { return headIn(reply.json); });
    return reading(m_note.address, [&] { return reply.json.at("event").get<std::int64_t>(); });
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
