// The session of one participant as a state machine of values: a state and an event give the next state with effects, or a
// refusal with its reason. The driver (driver.h) does all input, output and clock readings.
//
//   Enrolled -> Consenting -> AskingFacts -> Familiarising -> ScaleTraining -> CheckingList -.
//      (a stage that the protocol does not need is skipped)                                  |
//       .------------------------------------------------------------------------------------'
//       v
//   PlacingTray -> Presenting -> ... -> Debriefing -> Finished
//       ^  (answers; last question) |
//       +-----------<---------------+
//       +--- OnBreak (by count, by time, between phases, at the end of a sitting)
//   A pause keeps the place; after it the interrupted trial is presented again from PlacingTray. A later sitting may begin with a
//   refresher of the scale and the checklist (SittingPrepared). A participant can withdraw in any state. Quit is a pause that
//   closes the window.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocols/ids.h"
#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"
#include "study/session/given_answer.h"

namespace study::session {

/// A fabric outside the study with its friction image. It lets the participant get to know the display.
struct FamiliarisationImage {
    std::string name;
    protocols::SealedCode sealedCode;
};

/// The fixed parts of one participant's session.
struct Plan {
    protocols::Protocol protocol;
    std::vector<protocols::BlindedTrial> trials;
    PieceNames fabricNames;
    std::vector<FamiliarisationImage> familiarisation;
};

// ---- states; each holds only what is true in it. `index` is the number of a trial, from 0.
struct Enrolled {
    bool operator==(const Enrolled&) const = default;
};
struct Consenting {
    bool operator==(const Consenting&) const = default;
};
struct AskingFacts {
    bool operator==(const AskingFacts&) const = default;
};
/// `shown`: the number of the plan's familiarisation image on the display.
struct Familiarising {
    std::optional<int> shown;
    bool operator==(const Familiarising&) const = default;
};
/// A place on the line and the number that the participant gave it.
struct NamedPlace {
    protocols::Tenths shown, named;
    bool isRight = false;
    bool operator==(const NamedPlace&) const = default;
};
/// `placed`: number of places on the line for which the participant has said a number. The training goes on until
/// placesInARow() of them are right in a row.
struct ScaleTraining {
    bool isRefresher = false;
    int placed = 0;
    int rightInARow = 0;
    std::optional<NamedPlace> last = {};
    bool operator==(const ScaleTraining&) const = default;
};
struct CheckingList {
    bool operator==(const CheckingList&) const = default;
};
/// The operator puts the fabrics of the trial on the tray; the display is clear.
struct PlacingTray {
    int index = 0;
    bool operator==(const PlacingTray&) const = default;
};
enum class TouchSource { Operator, Display };
/// The friction image is on the display, and the operator asks question number `question` (from 0).
struct Presenting {
    int index = 0;
    int question = 0;
    std::int64_t readyAtNs = 0;  ///< time when this question was shown
    std::optional<std::int64_t> touchedAtNs;
    TouchSource touchedBy = TouchSource::Operator;
    bool operator==(const Presenting&) const = default;
};
enum class BreakReason { Block, Phase, Time, SittingOver };
struct OnBreak {
    int nextIndex = 0;
    BreakReason reason = BreakReason::Block;
    bool operator==(const OnBreak&) const = default;
};
struct Debriefing {
    bool operator==(const Debriefing&) const = default;
};
struct Finished {
    bool operator==(const Finished&) const = default;
};
struct Withdrawn {
    std::string why;
    bool operator==(const Withdrawn&) const = default;
};
using Stage = std::variant<Enrolled, Consenting, AskingFacts, Familiarising, ScaleTraining, CheckingList, PlacingTray, Presenting,
                           OnBreak, Debriefing, Finished, Withdrawn>;

/// A stored answer that may still be corrected.
struct StoredAnswer {
    int index = 0;
    int question = 0;
    GivenAnswer response;
    bool operator==(const StoredAnswer&) const = default;
};

/// A presentation in the order of the session. A block is a stretch between two breaks, counted from 0 over all phases. A voided
/// trial is presented again at the end of a block.
struct PlaceInOrder {
    int index = 0;
    int block = 0;
    bool operator==(const PlaceInOrder&) const = default;
};

/// How long a finished presentation took.
struct Pace {
    int phase = 0;
    std::int64_t trayNs = 0;     ///< until its tray was confirmed
    std::int64_t answersNs = 0;  ///< from there to its end
    int pieces = 0;              ///< put on the tray or moved to another slot for it
    bool operator==(const Pace&) const = default;
};

struct State {
    Stage stage = Enrolled{};
    bool paused = false;
    std::vector<StoredAnswer> answers;  ///< the current ones in order of storing, without those of voided presentations
    int answersStored = 0;              ///< all ever stored, without corrections
    std::vector<PlaceInOrder> order;    ///< in the order of presentation; a void adds one
    int position = 0;                   ///< in `order`
    int sitting = 0;
    int preparedSitting = 0;  ///< the sitting whose checklist was completed last
    bool sittingOverTold = false;
    std::int64_t sittingBeganAtNs = 0;
    std::int64_t deadTimeNs = 0;      ///< in this sitting; a bounced key confirms no tray within it
    std::int64_t breakBeganAtNs = 0;  ///< in this sitting
    std::int64_t restedAtNs = 0;      ///< end of the last break or pause, or start of the sitting
    std::int64_t preparedAtNs = 0;    ///< end of the preparation of this sitting; before it, start of the sitting
    std::int64_t trayAskedAtNs = 0;   ///< start of the present presentation, with its tray
    std::int64_t trayTookNs = 0;      ///< until the present tray was confirmed; 0 before
    std::vector<Pace> pace;           ///< of the finished presentations
    bool operator==(const State&) const = default;
};

// ---- events; each brings its time.
/// The session was opened, or opened again. `deadTimeNs`: in this sitting, the least time between a new tray and its
/// confirmation.
struct SittingStarted {
    std::int64_t deadTimeNs = 0;
};
struct Begun {};  ///< leaves Enrolled
/// Who made an entry that the operator and the participant (on their own page) can both make.
enum class EnteredBy { Operator, Participant };
/// The participant has agreed to the protocol's consent text.
struct Consented {
    EnteredBy by = EnteredBy::Operator;
};
/// Facts that the participant gave, with their values. The log keeps the names of the facts, never the values.
struct FactsGiven {
    std::map<std::string, std::string> facts;
    EnteredBy by = EnteredBy::Operator;
};
struct FamiliarisationShown {
    int item = 0;
};
struct FamiliarisationDone {};
/// The place on the line and the number that the participant said; on the participant's page, the number that was asked for and
/// the place that was tapped.
struct ScalePlaced {
    protocols::Tenths shown, spoken;
    EnteredBy by = EnteredBy::Operator;
};
struct ScaleTrainingDone {};
/// The ticked lines and the readings by name, as in the protocol.
struct ChecklistDone {
    std::vector<std::string> ticked;
    std::map<std::string, std::string> readings;
};
struct SittingPrepared {};  ///< the operator begins the preparation of a later sitting
/// The tray is complete: show the stimulus, ask the first question. `pieces`: the codes that were read from the pieces in the
/// order of the slots; empty where the protocol does not ask for them.
struct TrayReady {
    std::vector<std::string> pieces = {};
};
/// First touch of the display. `agoNs`: its age at the event, if the display reports it.
struct Touched {
    TouchSource by = TouchSource::Operator;
    std::int64_t agoNs = 0;
};
/// What marked the beginning of an answer: the first key of its entry, a key or pedal at the spoken word, or a script.
enum class BegunBy { Entry, Spoken, Script };
/// Times of an answer before it was entered, as their ages at the event.
struct AnswerStamps {
    std::optional<std::int64_t> begunAgoNs = {};
    BegunBy begunBy = BegunBy::Entry;
    std::optional<std::int64_t> touchEndedAgoNs = {};  ///< the finger left the display for the last time before the answer
    std::optional<int> entries = {};                   ///< entries until two agreed; none where one is enough
    bool operator==(const AnswerStamps&) const = default;
};
struct Answered {
    GivenAnswer response;
    AnswerStamps stamps = {};
};
/// Changes the latest answer to `question`.
struct Corrected {
    protocols::QuestionId question;
    GivenAnswer response;
    std::string why;
};
/// The presentation was invalid. It is kept but not analysed, and the trial is presented again.
struct Voided {
    std::string why;
};
struct BreakEnded {};
struct Paused {};
struct Resumed {};
struct WithdrawnEvent {
    std::string why;
};
struct Noted {
    std::string text;
    bool isFlag = false;  ///< marks the presentation for a later check; the text may then be empty
};
/// The participant's comment at the end. It can be erased, so the log does not hold it.
struct Debriefed {
    std::string text;
};
using EventBody = std::variant<SittingStarted, Begun, Consented, FactsGiven, FamiliarisationShown, FamiliarisationDone,
                               ScalePlaced, ScaleTrainingDone, ChecklistDone, SittingPrepared, TrayReady, Touched, Answered,
                               Corrected, Voided, BreakEnded, Paused, Resumed, WithdrawnEvent, Noted, Debriefed>;
/// Older versions stored events that are refused now. Their studies still open.
enum class EventSource { Present, Log };
struct Event {
    EventBody body;
    std::int64_t atNs = 0;
    EventSource source = EventSource::Present;
};

// ---- effects; the driver performs them after the event is on the disk.
struct ShowStimulus {
    protocols::SealedCode code;
    bool operator==(const ShowStimulus&) const = default;
};
struct ClearDisplay {
    bool operator==(const ClearDisplay&) const = default;
};
struct Prefetch {
    protocols::SealedCode code;
    bool operator==(const Prefetch&) const = default;
};
using Effect = std::variant<ShowStimulus, ClearDisplay, Prefetch>;

struct SessionStep {
    State next;
    std::vector<Effect> effects;
};
struct Refusal {
    std::string reason;  ///< a sentence for the operator
};

std::variant<SessionStep, Refusal> apply(const Plan& plan, const State& state, const Event& event);

/// False for touches that the display reports and for entries on the participant's own page.
bool isEnteredByOperator(const EventBody& event);

/// "PlacingTray", "PlacingTray (paused)".
std::string nameOf(const State& state);

}  // namespace study::session
