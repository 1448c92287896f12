// The answer of a participant as a variant, and everything that the session does with it: check it against the question, write it
// into the log and read it back, store it.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace database {
struct AnswerRecord;
}

namespace study::session {

/// The names of the fabric pieces on the console: their codes. A fabric without a code has its id as its name.
using PieceNames = std::map<protocols::FabricId, std::string>;
std::string nameIn(const PieceNames& names, const protocols::FabricId& fabric);

/// Whether the fabric on the tray is the fabric of the rendering.
struct Sameness {
    bool same = false;
    bool operator==(const Sameness&) const = default;
};
struct Words {
    std::string text;
    bool operator==(const Words&) const = default;
};
using GivenAnswer = std::variant<protocols::FabricId, protocols::Tenths, Sameness, Words>;

/// The answer in the view `answers` and in exports: a fabric id, "same", "different", words, or a rating like "5.5".
std::string textOf(const GivenAnswer& answer);

/// Why this answer cannot be stored for the question, as a sentence for the operator; empty where it can. `tray`: the fabrics
/// in slot order.
std::optional<std::string> faultOf(const GivenAnswer& answer, const protocols::Question& question,
                                   const std::vector<protocols::FabricId>& tray, const PieceNames& names);

/// The members of a logged event that hold the answer: {"fabric": …}, {"tenths": …}, {"same": …} or {"words": …}.
nlohmann::ordered_json payloadOf(const GivenAnswer& answer);
/// Reads them back. Throws nlohmann::json::exception where none is there.
GivenAnswer givenAnswerIn(const nlohmann::ordered_json& payload);

/// Puts the answer into its column: a rating into `rating`, anything else as text into `answer`.
void putInto(database::AnswerRecord& record, const GivenAnswer& answer);

}  // namespace study::session
