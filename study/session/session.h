// One participant's session as a state machine of values: state + event -> next state and effects, or
// a refusal with its reason. It does no I/O and reads no clock; the driver (driver.h) does both.
//
//   Enrolled -> Consenting -> AskingFacts -> Familiarising -> ScaleTraining -> CheckingList -.
//      (a stage of which the protocol asks nothing is passed over)                           |
//       .------------------------------------------------------------------------------------'
//       v
//   PlacingTray -> Presenting -> ... -> Debriefing -> Finished
//       ^  (answers; last question) |
//       +-----------<---------------+
//       +--- OnBreak (by count, by time, between phases, at the end of a sitting)
//   Pause keeps where it was; Resume presents the interrupted trial again from PlacingTray. A later
//   sitting may begin with the scale's refresher and the checklist (SittingPrepared).
//   Withdraw ends from any state. Quit is a pause at which the window closes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "protocols/allocation.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"
#include "study/session/given_answer.h"

namespace study::session {

/// A fabric outside the study's with its friction image, for getting to know the display.
struct FamiliarisationImage {
    std::string name;
    protocols::FileCode fileCode;
};

/// What is fixed for one participant's session.
struct Plan {
    protocols::Protocol protocol;
    std::vector<protocols::BlindedTrial> trials;
    PieceNames fabricNames;
    std::vector<FamiliarisationImage> familiarisation;
};

// ---- states; each holds only what is true in it. `index` counts trials from 0.
struct Enrolled {
    bool operator==(const Enrolled&) const = default;
};
struct Consenting {
    bool operator==(const Consenting&) const = default;
};
struct AskingFacts {
    bool operator==(const AskingFacts&) const = default;
};
/// `shown`: the item of the plan's familiarisation that is on the display.
struct Familiarising {
    std::optional<int> shown;
    bool operator==(const Familiarising&) const = default;
};
/// `placed`: values shown on the line and spoken back so far.
struct ScaleTraining {
    bool isRefresher = false;
    int placed = 0;
    bool operator==(const ScaleTraining&) const = default;
};
struct CheckingList {
    bool operator==(const CheckingList&) const = default;
};
/// The operator puts the fabrics of the trial into the tray; the display is clear.
struct PlacingTray {
    int index = 0;
    bool operator==(const PlacingTray&) const = default;
};
enum class TouchSource { Operator, Display };
/// The friction image is on the display and question `question` is asked.
struct Presenting {
    int index = 0;
    int question = 0;
    std::int64_t readyAtNs = 0;  ///< this question was shown
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

/// An answer that is stored and may still be corrected.
struct StoredAnswer {
    int index = 0;
    int question = 0;
    GivenAnswer response;
    bool operator==(const StoredAnswer&) const = default;
};

/// A presentation in the order that is followed. Blocks are the stretches between breaks, counted from 0
/// over all phases; a voided trial comes again at the end of a block.
struct PlaceInOrder {
    int index = 0;
    int block = 0;
    bool operator==(const PlaceInOrder&) const = default;
};

struct State {
    Stage stage = Enrolled{};
    bool paused = false;
    std::vector<StoredAnswer> answers;  ///< current ones, in order of storing; voided presentations' removed
    int answersStored = 0;              ///< ever, corrections not counted
    std::vector<PlaceInOrder> order;    ///< in the order of presentation; grows by voids
    int position = 0;                   ///< into order
    int sitting = 0;
    int preparedSitting = 0;  ///< the one whose checklist was gone through last
    bool sittingOverTold = false;
    std::int64_t sittingBeganAtNs = 0;
    std::int64_t restedAtNs = 0;                       ///< the last break, pause or start of a sitting ended
    std::int64_t trayAskedAtNs = 0;                    ///< the present presentation began with its tray
    std::vector<std::pair<int, std::int64_t>> paceNs;  ///< phase and duration of each presentation done
    bool operator==(const State&) const = default;
};

// ---- events; time comes in with them.
struct SittingStarted {};  ///< the engine was opened (again) for this participant
struct Begun {};           ///< leaves Enrolled
struct Consented {};       ///< the participant has agreed, as the protocol words it
/// Fact and value; what was not told is left out. Values never reach the log, only which were given.
struct FactsGiven {
    std::map<std::string, std::string> facts;
};
struct FamiliarisationShown {
    int item = 0;
};
struct FamiliarisationDone {};
struct ScalePlaced {
    protocols::Tenths shown, spoken;
};  ///< a place pointed at, and the number said for it
struct ScaleTrainingDone {};
/// Lines that were ticked and readings by name, as the protocol lists them.
struct ChecklistDone {
    std::vector<std::string> ticked;
    std::map<std::string, std::string> readings;
};
struct SittingPrepared {};  ///< paused in a later sitting -> the scale's refresher
struct TrayReady {};        ///< the tray is confirmed: show the stimulus, ask the first question
/// First touch of the display; it came `agoNs` before the event, where a device tells so.
struct Touched {
    TouchSource by = TouchSource::Operator;
    std::int64_t agoNs = 0;
};
struct Answered {
    GivenAnswer response;
};
struct Corrected {  ///< changes the latest answer to `question`
    protocols::QuestionId question;
    GivenAnswer response;
    std::string why;
};
struct Voided {
    std::string why;
};  ///< the presentation was invalid: kept, not analysed, presented again
struct BreakEnded {};
struct Paused {};
struct Resumed {};
struct WithdrawnEvent {
    std::string why;
};
struct Noted {
    std::string text;
    bool isFlag = false;  ///< the presentation is to be looked at; the text may be empty then
};
struct Debriefed {
    std::string text;
};  ///< what the participant says at the end; erasable, so not in the log
using EventBody = std::variant<SittingStarted, Begun, Consented, FactsGiven, FamiliarisationShown, FamiliarisationDone,
                               ScalePlaced, ScaleTrainingDone, ChecklistDone, SittingPrepared, TrayReady, Touched, Answered,
                               Corrected, Voided, BreakEnded, Paused, Resumed, WithdrawnEvent, Noted, Debriefed>;
struct Event {
    EventBody body;
    std::int64_t atNs = 0;
};

// ---- what the driver is asked to do, after the event is on the disk.
struct ShowStimulus {
    protocols::FileCode code;
    bool operator==(const ShowStimulus&) const = default;
};
struct ClearDisplay {
    bool operator==(const ClearDisplay&) const = default;
};
struct Prefetch {
    protocols::FileCode code;
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

/// The names for tests' printed grid: "PlacingTray", "PlacingTray (paused)".
std::string nameOf(const State& state);

}  // namespace study::session
