// The file of a response, response.json. README, "The display's response", describes its fields.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "rendering/response/display_response.h"

namespace rendering {

inline constexpr const char* responseSchema = "vis2hap.display-response/1";
inline constexpr std::uint64_t largestResponseFile = 1 << 20;  ///< bytes

/// The text of the file. Its field sha256 is the hash of everything else, so that an edit by hand is noticed.
std::string responseJson(const DisplayResponse& response);

/// `where` names the text in errors. Throws badInput for another schema, an altered text, and values that are no response.
DisplayResponse responseFromJson(std::string_view text, const std::string& where);

DisplayResponse readResponse(const std::filesystem::path& file);

/// "measured on 2026-05-04 on Our display at 0.5 N and 20 mm/s with index finger, dry".
std::string measuredText(const ResponseSetting& setting);

}  // namespace rendering
