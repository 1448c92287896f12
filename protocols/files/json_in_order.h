// Reads JSON with the keys in the order of the text. The library's own reader of such texts compares each key with all before it,
// so that its time grows with the square of their number. Size and depth are checked before (strict_json.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace protocols {

/// Throws the library's parse_error or out_of_range for a malformed text. An object may then hold a key twice.
nlohmann::ordered_json jsonInOrder(std::string_view text);

/// Discarded for a malformed text. A key that occurs twice has its last value, in the place of the first one.
nlohmann::ordered_json storedJsonInOrder(std::string_view text);

}  // namespace protocols
