// The data of one participant as a page that this person can read and print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace study::records {

/// HTML in one file. `data`: as participantData() gives it.
std::string participantPage(const nlohmann::ordered_json& data);

}  // namespace study::records
