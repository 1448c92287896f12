// The data of one participant as a page that this person can read and print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace study::records {

/// How the data name a piece whose place has no letter, and a choice that lay in no place.
inline constexpr std::string_view pieceNumbered = "piece ";
inline constexpr std::string_view pieceElsewhere = "a piece that was not on the tray";

/// HTML in one file, in the language of the protocol where that has usual texts, else in English. `data`: as participantData()
/// gives it.
std::string participantPage(const nlohmann::ordered_json& data);

}  // namespace study::records
