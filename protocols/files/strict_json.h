// JSON read strictly: malformed text, bytes that are not UTF-8 and keys that occur twice in an object
// are refused with their place, where the parser alone would be vague or keep only the last value.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace protocols {

/// `where` names the source in errors. Throws badInput.
nlohmann::json parseStrictJson(std::string_view text, const std::string& where);

/// The whole file as bytes. Throws badInput where it cannot be read.
std::string readTextFile(const std::filesystem::path& file);

}  // namespace protocols
