// Which prompts the participant hears when a session moves on: the read-back of the stored answer, and what comes now. Only
// what the participant has said, or may know, is read: no code, no fabric's name, no condition.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/session/view.h"

namespace study::participant {

/// Keys of prompts in their order, as protocols::isPromptKey() knows them; empty where nothing is said, also while no
/// blindfold is worn. `now` follows `before` by one event.
std::vector<std::string> promptsBetween(const session::View& before, const session::View& now);

/// The read-back of an answer: "answer_B"; "number_5", "point", "number_4"; "same". `tray`: the fabrics in slot order. Empty for
/// words.
std::vector<std::string> readBackOf(const session::GivenAnswer& answer, const std::vector<protocols::FabricId>& tray);

/// What an engine speaks for prompts without a recording, by key, in the language of the protocol: its questions, its
/// participant_texts, letters, and numbers to 100 or as far as its scales. A usual sentence is English, so it is there for
/// English only.
std::map<std::string, std::string> spokenTexts(const protocols::Protocol& protocol);

/// One sentence for each text that an amendment changes while its recording stays, and one for another language. A study keeps
/// the recordings that it was made with.
std::vector<std::string> notesOnRecordings(const protocols::Protocol& before, const protocols::Protocol& amended);

}  // namespace study::participant
