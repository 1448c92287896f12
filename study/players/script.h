// A scripted participant's file (schema vis2hap.script/1): what is answered to which rendering, and
// what happens on the way. Reading it finds every malformed or doubled answer before anything is stored.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace study::players {

/// "correct", "foil:1", a fabric id, "same", "different", or words, as the question asks; or a rating.
using ScriptedResponse = std::variant<std::string, protocols::Tenths>;

struct ScriptedPlace {
    std::optional<protocols::TrialNumber> trial;  ///< by number, else by rendering
    protocols::ConditionId condition;             ///< "catch" for the blank glass of a catch trial
    protocols::FabricId fabric;
    std::optional<int> attempt = std::nullopt;  ///< of presentations that were voided and given again; from 1
    auto operator<=>(const ScriptedPlace&) const = default;
};

struct ScriptedAnswer {
    protocols::QuestionId question;
    ScriptedPlace place;
    ScriptedResponse response;
    double seconds = 0;                  ///< > 0; from the touch, where one is scripted, else from the question
    std::optional<double> touchSeconds;  ///< from the question to the first touch
    bool touchedByDisplay = false;
};

/// What must be true when its turn comes; what is not set is not looked at.
struct ScriptedExpectation {
    std::optional<std::string> stage;     ///< as session::nameOf() names it: "Presenting", "OnBreak", "PlacingTray (paused)"
    std::optional<std::string> question;  ///< the one that is asked
    std::optional<int> presentation;      ///< how far in the order, from 1
    std::optional<int> trial;
};

struct ScriptedEvent {
    enum class What { Pause, Resume, Correct, Void, Crash, Note, Withdraw, Answer, Touch, Expect };
    What what = What::Pause;
    int answersStoredBefore = 0;  ///< happens when so many answers are stored
    bool beforeAnswer = false;    ///< while the next answer is being given; else right after the last one
    protocols::QuestionId question;
    std::optional<ScriptedResponse> response;
    std::string text;       ///< why, or the note
    bool isFlag = false;    ///< of a note
    bool mustFail = false;  ///< the session must refuse it ...
    std::string refusal;    ///< ... with a reason that holds this text
    ScriptedExpectation expectation;
};

struct Script {
    std::string where;  ///< the file, for errors
    protocols::ParticipantId participant;
    std::vector<ScriptedAnswer> answers;
    std::vector<ScriptedEvent> events;

    /// The answer for this attempt, or else the one that is for any; null without either.
    const ScriptedAnswer* answerTo(const protocols::QuestionId& question, const ScriptedPlace& place) const;
};

/// Throws badInput naming file and entry.
Script scriptFromJson(std::string_view json, const std::string& where, const protocols::Protocol& protocol);

}  // namespace study::players
