// The texts of a new protocol: what participants and operators read, which studies store and documents print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace protocols {

/// "question_texts.Q1: the text holds the character U+000B, expected …" for each text of a protocol that faultOfWords() refuses.
/// The name and the fabrics have rules of their own, and nobody reads comments.
std::vector<std::string> faultsOfTexts(const nlohmann::json& protocol);

/// For an amendment. Throws badInput, naming `where`, for the first text with a fault that the protocol before does not have.
/// Both are protocols that were read.
void requireGoodNewTexts(std::string_view amended, std::string_view before, const std::string& where);

}  // namespace protocols
