// The file of a scripted participant (schema vis2hap.script/1): the answer to each rendering, and the events of the session.
// Reading finds every malformed or doubled answer before anything is stored.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace study::players {

/// "correct", "foil:1", a fabric id, "same", "different" or words, by the question; or a rating.
using ScriptedResponse = std::variant<std::string, protocols::Tenths>;

struct ScriptedPlace {
    std::optional<protocols::TrialNumber> trial;  ///< empty: the place is given by condition and fabric
    protocols::ConditionId condition;             ///< "catch" for the blank glass of a catch trial
    protocols::FabricId fabric;
    std::optional<int> attempt = std::nullopt;  ///< counts presentations of the same trial from 1; later ones follow a void
    protocols::InstructionId instruction = {};  ///< of the block; empty: the answer holds under every instruction
    protocols::AnchorKind anchor = protocols::AnchorKind::None;
    std::optional<int> occurrence = std::nullopt;  ///< counts the trials of the list with this place from 1; empty: all
    auto operator<=>(const ScriptedPlace&) const = default;
};

/// The occurrences of the places of a list, and whether a place occurs again.
struct Occurrence {
    int number = 1;
    bool isShared = false;
};
/// [trial]: `places` holds phase and place of each.
std::vector<Occurrence> occurrencesIn(const std::vector<std::pair<int, ScriptedPlace>>& places);

struct ScriptedAnswer {
    protocols::QuestionId question;
    ScriptedPlace place;
    ScriptedResponse response;
    double seconds = 0;                  ///< more than 0; from the touch, or from the question if no touch is scripted
    std::optional<double> touchSeconds;  ///< from the question to the first touch
    bool touchedByDisplay = false;
    std::optional<double> begunSeconds;       ///< from the question to the beginning of the answer; none: with the answer
    bool begunBySpokenKey = false;            ///< a key or pedal marked the spoken word
    std::optional<double> touchEndedSeconds;  ///< from the question to the last end of touching
    std::optional<int> entries;               ///< until two agreed
};

/// The state that the session must have when the event happens. Fields without a value are not checked.
struct ScriptedExpectation {
    std::optional<std::string> stage;     ///< a name of session::nameOf(): "Presenting", "PlacingTray (paused)"
    std::optional<std::string> question;  ///< id of the question that is asked
    std::optional<int> presentation;      ///< place in the order, from 1
    std::optional<int> trial;
};

struct ScriptedEvent {
    enum class What { Pause, Resume, Correct, Void, Crash, Note, Withdraw, Answer, Touch, Expect };
    What what = What::Pause;
    int answersStoredBefore = 0;  ///< number of stored answers at which the event happens
    bool beforeAnswer = false;    ///< while the next question is asked; else right after the last answer
    protocols::QuestionId question;
    std::optional<ScriptedResponse> response;
    std::string text;       ///< the reason, or the note
    bool isFlag = false;    ///< notes only
    bool mustFail = false;  ///< the session must refuse it
    std::string refusal;    ///< ... with a reason that contains this text
    ScriptedExpectation expectation;
};

struct Script {
    std::string where;  ///< the file, for errors
    protocols::ParticipantId participant;
    std::optional<int> slot = {};  ///< running order that the answers were given in, from 1; none: any
    std::vector<ScriptedAnswer> answers;
    std::vector<ScriptedEvent> events;

    bool withdraws() const;

    /// The answer for this attempt, occurrence and instruction, else for any attempt, any occurrence, any instruction. A
    /// repetition that has none gets the answer to the first presentation. Else null.
    const ScriptedAnswer* answerTo(const protocols::QuestionId& question, const ScriptedPlace& place) const;
};

/// Throws badInput, naming the file and the entry.
Script scriptFromJson(std::string_view json, const std::string& where, const protocols::Protocol& protocol);

}  // namespace study::players
