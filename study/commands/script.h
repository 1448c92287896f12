// A scripted participant's file (schema vis2hap.script/1): what is answered to which rendering, and
// what happens on the way. Reading it finds every malformed or doubled answer before anything is stored.
#pragma once

#include "protocols/ids.h"
#include "protocols/protocol.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace study::commands {

/// "correct", "foil:1", a fabric id; or a rating.
using ScriptedResponse = std::variant<std::string, protocols::Tenths>;

struct ScriptedPlace {
    std::optional<protocols::TrialNumber> trial;  ///< by number, else by rendering
    protocols::ConditionId condition;
    protocols::FabricId fabric;
    auto operator<=>(const ScriptedPlace&) const = default;
};

struct ScriptedAnswer {
    protocols::QuestionId question;
    ScriptedPlace place;
    ScriptedResponse response;
    double seconds = 0;  ///< > 0
};

struct ScriptedEvent {
    enum class What { Pause, Resume, Correct, Void, Crash, Note };
    What what = What::Pause;
    int answersStoredBefore = 0;  ///< happens when so many answers are stored
    bool beforeAnswer = false;    ///< while the next answer is being given; else right after the last one
    protocols::QuestionId question;
    std::optional<ScriptedResponse> response;
    std::string text;             ///< why, or the note
};

struct Script {
    std::string where;  ///< the file, for errors
    protocols::ParticipantId participant;
    std::vector<ScriptedAnswer> answers;
    std::vector<ScriptedEvent> events;

    const ScriptedAnswer* answerTo(const protocols::QuestionId& question, const ScriptedPlace& place) const;
};

/// Throws badInput naming file and entry.
Script scriptFromJson(std::string_view json, const std::string& where, const protocols::Protocol& protocol);

}  // namespace study::commands
