#include "study/session/driver.h"

#include <algorithm>
#include <map>

#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/records/trial_lists.h"
#include "study/session/session_entry.h"
#include "study/session/session_record.h"

namespace study::session {

namespace {

using database::SessionStore;

std::string protocolTextFor(const SessionStore& store, const database::Enrolment& enrolment)
{
    for (const database::ProtocolVersion& version : store.protocolVersions())
        if (version.version == enrolment.protocolVersion) return version.json;
    throw protocols::workFailed({"version " + std::to_string(enrolment.protocolVersion) + " of the protocol is missing",
                                 store.folder().database().string(), "", "run vis2hap verify on the study"});
}

std::string nameOfList(const SessionStore& store, const protocols::ParticipantId& participant)
{
    return store.folder().database().string() + ", list of " + participant.value;
}

/// Throws workFailed where the list is not one of the protocol.
Plan planOf(const SessionStore& store, const database::Enrolment& enrolment)
{
    const database::StudyFacts& facts = store.facts();
    Plan plan{protocols::keptProtocolFromJson(protocolTextFor(store, enrolment), store.folder().protocol().string(),
                                              facts.programVersion),
              store.trials(enrolment.slot),
              facts.fabricNames,
              {}};
    requireSoundList(plan.trials, plan.protocol, facts.fabrics, nameOfList(store, enrolment.participant));
    const std::size_t slot = static_cast<std::size_t>(enrolment.slot) - 1;
    if (slot < facts.swatches.size()) plan.fabricNames = facts.swatches[slot];
    for (const database::FamiliarisationItem& item : facts.familiarisation)
        plan.familiarisation.push_back({item.name, item.sealedCode});
    return plan;
}

/// Whether a text of JSON holds a NUL, which is written as \u0000; a backslash before it makes it a text of six characters.
bool holdsNul(const std::string& json)
{
    for (std::size_t at = json.find("\\u0000"); at != std::string::npos; at = json.find("\\u0000", at + 1)) {
        std::size_t backslashes = 0;
        while (backslashes < at && json[at - backslashes - 1] == '\\') ++backslashes;
        if (backslashes % 2 == 0) return true;
    }
    return false;
}

/// Whether the database keeps every text of the event as it is; `payload` is its JSON.
bool areKeptTexts(const EventBody& body, const std::string& payload)
{
    if (holdsNul(payload) || !protocols::isKeptText(payload)) return false;
    if (const auto* ended = std::get_if<Debriefed>(&body)) return protocols::isKeptText(ended->text);
    const auto* given = std::get_if<FactsGiven>(&body);
    return !given || std::ranges::all_of(given->facts, [](const auto& fact) { return protocols::isKeptText(fact.second); });
}

std::size_t lengthOfWords(const GivenAnswer& answer)
{
    const auto* words = std::get_if<Words>(&answer);
    return words ? words->text.size() : 0;
}

/// Bytes of the longest text that somebody typed.
std::size_t longestTyped(const EventBody& body)
{
    const auto longestOf = [](const std::map<std::string, std::string>& texts) {
        std::size_t longest = 0;
        for (const auto& [name, text] : texts) longest = std::max(longest, text.size());
        return longest;
    };
    return std::visit(
        protocols::Overloaded{
            [](const Answered& event) { return lengthOfWords(event.response); },
            [](const Corrected& event) { return std::max(lengthOfWords(event.response), event.why.size()); },
            [](const Voided& event) { return event.why.size(); }, [](const WithdrawnEvent& event) { return event.why.size(); },
            [](const Noted& event) { return event.text.size(); }, [](const Debriefed& event) { return event.text.size(); },
            [&](const FactsGiven& event) { return longestOf(event.facts); },
            [&](const ChecklistDone& event) { return longestOf(event.readings); }, [](const auto&) { return std::size_t{0}; }},
        body);
}

/// Bytes that the payload has at most once it holds the hashes of facts: each with its name, which the payload of FactsGiven
/// holds already, and 64 digits.
std::size_t lengthWithHashes(const EventBody& body, const std::string& payload)
{
    constexpr std::size_t key = 100, eachHash = 80;
    const auto* given = std::get_if<FactsGiven>(&body);
    if (!given) return payload.size() + key + eachHash;
    return 2 * payload.size() + key + eachHash * given->facts.size();
}

/// A server refuses longer texts and entries, also those that waited at a station, so that a folder takes none either. The
/// functions of a server are those of the program that moved the study there, until its owner runs `vis2hap server roles`: older
/// ones refuse shorter texts. `payload` is the event's JSON.
std::optional<Refusal> refusalOfLength(const EventBody& body, const std::string& payload)
{
    if (longestTyped(body) > database::longestText)
        return Refusal{"The text is longer than 100,000 bytes, so it is not stored. Shorten it."};
    if (lengthWithHashes(body, payload) > database::longestPayload)
        return Refusal{"The entry is too long, so it is not stored. Shorten its texts."};
    return std::nullopt;
}

/// A display that cannot fetch images would show the text of a ticket, and one that fetches would take an image for a ticket.
void requireFittingDisplay(const rendering::PresentedImages& images, const rendering::HapticDisplay& display)
{
    if (!display.isThere() || images.givesTickets() == display.fetchesImages()) return;
    if (images.givesTickets())
        throw protocols::badInput({"this study gives its images to the display's own login only", display.name(),
                                   "--display tcp:127.0.0.1:PORT of vis2hap display serve",
                                   "start vis2hap display serve under the display's account"});
    throw protocols::badInput({"this display fetches its images from a server, but this study gives them to the station",
                               display.name(), "vis2hap server roles ADDRESS --images display",
                               "ask the study's owner, or use the display's own driver"});
}

}  // namespace

Driver::Driver(SessionStore& store, const protocols::ParticipantId& participant, database::ParticipantKind kind,
               rendering::PresentedImages& images, rendering::HapticDisplay& display, Clock& clock, OperatedBy operatedBy)
    : m_store(store),
      m_participant(participant),
      m_images(images),
      m_display(display),
      m_clock(clock),
      m_operatedBy(std::move(operatedBy))
{
    m_operatedBy.display = display.isThere() ? display.name() : "none";
    requireFittingDisplay(images, display);
    requireKeptProtocol(store);
    const database::Slot slot = store.enrol(participant, kind);
    m_slot = slot.number;
    // Where the protocol never changed, the list of all participants need not be read for its version.
    const auto versions = store.protocolVersions();
    m_plan = versions.size() == 1 && versions.front().version == 1
                 ? planOf(store, {participant, slot.number, kind, slot.state, 1})
                 : readPlan(store, participant);
    replayLog();
    const auto deadTimeNs = static_cast<std::int64_t>(m_plan.protocol.deadTimeSeconds * 1e9);
    if (const auto refusal = send(SittingStarted{deadTimeNs}))
        throw protocols::workFailed(
            {"the session cannot be opened: " + refusal->reason, participant.value, "", "run vis2hap verify on the study"});
}

Plan readPlan(const SessionStore& store, const protocols::ParticipantId& participant)
{
    for (const database::Enrolment& enrolment : store.enrolments())
        if (enrolment.participant == participant) return planOf(store, enrolment);
    throw protocols::badInput(
        {"unknown participant " + participant.value, store.folder().folder.string(), "an enrolled participant", ""});
}

void requireKeptProtocol(const SessionStore& store)
{
    const std::filesystem::path file = store.folder().protocol();
    const std::string study = protocols::shellWord(store.folder().folder.string());
    const std::optional<std::string> text = protocols::readIfPossible(file);
    if (text && protocols::sha256(*text) == store.protocolVersions().back().sha256) return;
    throw protocols::badInput({text ? "the protocol was changed after the study was made" : "the protocol cannot be read",
                               file.string(), "the text in the database",
                               "accept the change with `vis2hap study amend " + study +
                                   " --who NAME --why TEXT`, or restore the text with `vis2hap study amend " + study +
                                   " --undo`"});
}

View Driver::viewWithoutHead() const { return viewOf(m_plan, m_state, m_participant, m_clock.monotonicNs()); }

View Driver::view() const
{
    View view = viewWithoutHead();
    const bool hasEnded = std::holds_alternative<Finished>(m_state.stage) || std::holds_alternative<Withdrawn>(m_state.stage);
    if (!hasEnded && !m_state.paused && !std::holds_alternative<OnBreak>(m_state.stage)) return view;
    if (const database::LogHead head = m_store.head(); !head.hash.empty()) view.logHead = shortTextOf(head);
    return view;
}

void Driver::replayLog()
{
    for (const database::EventRecord& record : m_store.events(m_participant)) {
        const EventBody body = eventFromRecord(record.kind, record.payloadJson);
        // A server that the study moved to does not know of a presentation that began in the folder.
        if (std::holds_alternative<TrayReady>(body)) takeDueTrial();
        auto outcome = apply(m_plan, m_state, {body, record.atNs, EventSource::Log});
        if (const auto* refusal = std::get_if<Refusal>(&outcome))
            throw protocols::workFailed(
                {"the stored log is inconsistent: " + refusal->reason,
                 m_store.folder().database().string() + ", event " + std::to_string(record.sequence) + " (" + record.kind + ")",
                 "", "run vis2hap verify on the study"});
        m_state = std::move(std::get<SessionStep>(outcome).next);
    }
}

std::optional<Refusal> Driver::send(const EventBody& body)
{
    const std::int64_t atNs = m_clock.monotonicNs();
    auto outcome = apply(m_plan, m_state, {body, atNs});
    if (auto* refusal = std::get_if<Refusal>(&outcome)) return std::move(*refusal);
    std::string payload = payloadJson(body, m_operatedBy);
    if (!areKeptTexts(body, payload))
        return Refusal{"The text holds a character that nobody sees and that is not stored as it is. Type the text again."};
    if (auto refusal = refusalOfLength(body, payload)) return refusal;
    const std::vector<Effect> effects = std::get<SessionStep>(outcome).effects;
    commit(body, std::move(payload), atNs, std::move(std::get<SessionStep>(outcome)));
    letOut(effects);
    return std::nullopt;
}

void Driver::commit(const EventBody& body, std::string payload, std::int64_t atNs, SessionStep step)
{
    SessionStore::Append entry = entryOf(m_plan, m_state, step.next, body, atNs);
    entry.event = {0, m_participant, step.next.sitting, kindOf(body), std::move(payload), atNs, m_clock.wallTime()};
    if (std::holds_alternative<Answered>(body)) entry.finger = m_finger.unstored(entry.answers.front().trial);
    if (entry.voids) entry.finger = m_finger.unstored(*entry.voids);
    entry.storedAtNs = m_clock.monotonicNs();
    m_store.append(entry);
    m_state = std::move(step.next);
    if (entry.finger) m_finger.markStored();
    if (!std::holds_alternative<Presenting>(m_state.stage)) m_finger.restart();
}

void Driver::addFinger(const rendering::FingerReport& report)
{
    if (m_state.paused || !std::holds_alternative<Presenting>(m_state.stage)) return;
    m_finger.add({m_clock.monotonicNs() - report.ago.count(), report.xMm, report.yMm, report.forceN});
}

/// Performs effects of events that are on the disk. If the display or the server fails, the session is paused, so that the
/// presentation begins again when it works.
void Driver::letOut(const std::vector<Effect>& effects)
{
    try {
        takeDueTrial();
        for (const Effect& effect : effects) perform(effect);
    } catch (...) {
        pauseAfterFault();
        throw;
    }
}

/// A server gives out each presentation when it is due, not before.
void Driver::takeDueTrial()
{
    const auto* tray = std::get_if<PlacingTray>(&m_state.stage);
    if (!tray || m_state.paused) return;
    protocols::BlindedTrial& trial = m_plan.trials[static_cast<std::size_t>(tray->index)];
    if (!trial.sealedCode.empty()) return;
    const protocols::BlindedTrial due = m_store.dueTrial(m_slot, trial.number);
    requireSoundTrial(due, m_plan.protocol, m_store.facts().fabrics, nameOfList(m_store, m_participant));
    trial = due;
    if (m_display.isThere()) prefetchIfPossible(trial.sealedCode);
}

void Driver::perform(const Effect& effect)
{
    const bool isFelt = m_display.isThere();  // without a display no image is decrypted
    if (const auto* show = std::get_if<ShowStimulus>(&effect)) {
        if (isFelt)
            m_display.show(m_images.image(show->code));
        else
            m_images.requireImage(show->code);
    } else if (const auto* prefetch = std::get_if<Prefetch>(&effect)) {
        if (isFelt) prefetchIfPossible(prefetch->code);
    } else {
        m_display.clear();
    }
}

void Driver::prefetchIfPossible(const protocols::SealedCode& code)
{
    try {
        m_images.prefetch(code);
    } catch (const protocols::Error&) {
        // Reading ahead only saves time. A missing or altered stimulus is reported when it is shown.
    }
}

void Driver::pauseAfterFault()
{
    if (m_state.paused) return;
    const std::int64_t atNs = m_clock.monotonicNs();
    auto outcome = apply(m_plan, m_state, {Paused{}, atNs});
    auto* step = std::get_if<SessionStep>(&outcome);
    if (!step) return;  // the session is over
    commit(Paused{}, payloadJson(Paused{}, m_operatedBy), atNs, std::move(*step));
    try {
        m_display.clear();
    } catch (const protocols::Error&) {
        // Report the first fault of the display; later ones are consequences.
    }
}

}  // namespace study::session
