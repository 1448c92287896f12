// One participant's session as a state machine of values: state + event -> next state and effects, or
// a refusal with its reason. It does no I/O and reads no clock; the driver (driver.h) does both.
//
//   Enrolled -> Familiarising -> ScaleTraining -> PlacingTray -> Presenting -> ... -> Finished
//                                                     ^  (answers; last question)  |
//                                                     +-----------<----------------+
//                                                     +--- OnBreak (by count, or between phases) 
//   Pause keeps where it was; Resume presents the interrupted trial again from PlacingTray.
//   Withdraw ends from any state. Quit is a pause at which the window closes.
#pragma once

#include "protocols/allocation.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace study::session {

/// What is fixed for one participant's session.
struct Plan {
    protocols::Protocol protocol;
    std::vector<protocols::BlindedTrial> trials;
    std::map<protocols::FabricId, std::string> fabricNames;
};

using Response = std::variant<protocols::FabricId, protocols::Tenths>;

// ---- states; each holds only what is true in it. `index` counts trials from 0.
struct Enrolled { bool operator==(const Enrolled&) const = default; };
struct Familiarising { bool operator==(const Familiarising&) const = default; };
struct ScaleTraining { bool operator==(const ScaleTraining&) const = default; };
/// The operator puts the fabrics of the trial into the tray; the display is clear.
struct PlacingTray { int index = 0; bool operator==(const PlacingTray&) const = default; };
/// The friction image is on the display and question `question` is asked.
struct Presenting {
    int index = 0;
    int question = 0;
    std::int64_t readyAtNs = 0;                  ///< this question was shown
    std::optional<std::int64_t> touchedAtNs;
    bool operator==(const Presenting&) const = default;
};
struct OnBreak { int nextIndex = 0; bool operator==(const OnBreak&) const = default; };
struct Finished { bool operator==(const Finished&) const = default; };
struct Withdrawn { std::string why; bool operator==(const Withdrawn&) const = default; };
using Stage = std::variant<Enrolled, Familiarising, ScaleTraining, PlacingTray, Presenting, OnBreak, Finished, Withdrawn>;

/// An answer that is stored and may still be corrected.
struct StoredAnswer {
    int index = 0;
    int question = 0;
    Response response;
    bool operator==(const StoredAnswer&) const = default;
};

struct State {
    Stage stage = Enrolled{};
    bool paused = false;
    std::vector<StoredAnswer> answers;   ///< current ones, in order of storing; voided presentations' removed
    int answersStored = 0;               ///< ever, corrections not counted
    /// Presentation order still to come after the list's own: voided trials, presented again at the end
    /// of their phase.
    std::vector<int> order;              ///< trial indices in the order of presentation, grows by voids
    int position = 0;                    ///< into order
    int sitting = 0;
    bool operator==(const State&) const = default;
};

// ---- events; time comes in with them.
struct SittingStarted {};               ///< the engine was opened (again) for this participant
struct Begun {};                        ///< Enrolled -> Familiarising
struct FamiliarisationDone {};
struct ScaleTrainingDone {};
struct TrayReady {};                    ///< the tray is confirmed: show the stimulus, ask the first question
struct Touched {};                      ///< first touch of the display
struct Answered { Response response; };
struct Corrected {                      ///< changes the latest answer to `question`
    protocols::QuestionId question;
    Response response;
    std::string why;
};
struct Voided { std::string why; };     ///< the presentation was invalid: kept, not analysed, presented again
struct BreakEnded {};
struct Paused {};
struct Resumed {};
struct WithdrawnEvent { std::string why; };
struct Noted { std::string text; };
using EventBody = std::variant<SittingStarted, Begun, FamiliarisationDone, ScaleTrainingDone, TrayReady, Touched,
                               Answered, Corrected, Voided, BreakEnded, Paused, Resumed, WithdrawnEvent, Noted>;
struct Event {
    EventBody body;
    std::int64_t atNs = 0;
};

// ---- what the driver is asked to do, after the event is on the disk.
struct ShowStimulus { protocols::FileCode code; bool operator==(const ShowStimulus&) const = default; };
struct ClearDisplay { bool operator==(const ClearDisplay&) const = default; };
struct Prefetch { protocols::FileCode code; bool operator==(const Prefetch&) const = default; };
using Effect = std::variant<ShowStimulus, ClearDisplay, Prefetch>;

struct Step {
    State next;
    std::vector<Effect> effects;
};
struct Refusal {
    std::string reason;  ///< a sentence for the operator
};

std::variant<Step, Refusal> apply(const Plan& plan, const State& state, const Event& event);

/// Text and back, for the log. Throws workFailed on a record this version cannot read.
std::string kindOf(const EventBody& body);
std::string payloadJson(const EventBody& body);
EventBody eventFromRecord(const std::string& kind, const std::string& payloadJson);

/// The names for tests' printed grid: "PlacingTray", "PlacingTray (paused)".
std::string nameOf(const State& state);

}  // namespace study::session
