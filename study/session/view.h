// What a window or another front end may show of a session: a value without any key.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/session/session.h"

namespace study::session {

struct View {
    State state;
    std::string participant;
    std::string phaseName;             ///< "Q1", "Q2-Q4"
    protocols::PresentationCode code;  ///< code of the presentation; empty between presentations
    std::vector<std::string> tray;     ///< the codes on the fabric pieces in slots A, B, C
    std::vector<protocols::FabricId> trayIds;
    std::vector<std::string> nextTray;            ///< while a presentation runs: the pieces of the next one; empty at the end
    std::optional<protocols::Question> question;  ///< the one now asked, or asked next in PlacingTray
    std::optional<protocols::BlockInstruction> instruction;  ///< of the present presentation; in a break, of the next
    bool phaseBegins = false;                 ///< the next presentation is the first of a later phase, and has no answer yet
    bool instructionBegins = false;           ///< the operator says it now: a block or a stretch after a break begins
    int presentation = 0, presentations = 0;  ///< progress, from 1; a voided presentation adds to the total
    int answersStored = 0, answersInAll = 0;
    double minutesLeft = 0;     ///< by the protocol's seconds; after five presentations of a phase by medians of this session
                                ///< and by the pieces that the trays still need
    double sittingMinutes = 0;  ///< since this sitting began, at the last event
    int presentationsToBreak = 0;
    bool sittingIsPrepared = true;                 ///< false: the refresher and the checklist of this sitting are due
    std::vector<std::string> familiarisation;      ///< names of the fabrics for getting to know the display
    std::optional<protocols::Tenths> placeToName;  ///< in scale training, until enough places were right in a row
    double breakSeconds = 0;                       ///< since the present break began, or since this sitting did
    std::optional<std::string> lastAnswer;         ///< to read back: "Q3: 5.5"
    std::optional<protocols::QuestionId> lastQuestion;
    std::string logHead;  ///< of the study, short, where a sitting may end here; set by Driver
};

/// `nowNs`: the session's monotonic clock.
View viewOf(const Plan& plan, const State& state, const protocols::ParticipantId& participant, std::int64_t nowNs);

}  // namespace study::session
