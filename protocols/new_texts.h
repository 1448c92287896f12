// The texts of a new protocol: what participants and operators read, which studies store and documents print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace protocols {

/// The name under which a study stores the participant's comment at the end, beside the facts.
inline constexpr const char* debriefingFact = "debriefing";

/// "question_texts.Q1: the text holds the character U+000B, expected …" for each text of a protocol that faultOfWords() refuses.
/// The name and the fabrics have rules of their own, and nobody reads comments. A fact called
/// as the comment at the end is a fault, too: the comment would take its place. So is a fact whose name has more than 2,000
/// bytes.
std::vector<std::string> faultsOfTexts(const nlohmann::json& protocol);

/// For an amendment. Throws badInput, naming `where`, for the first text with a fault that the protocol before does not have.
/// Both are protocols that were read.
void requireGoodNewTexts(std::string_view amended, std::string_view before, const std::string& where);

}  // namespace protocols
