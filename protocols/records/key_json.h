// The two keys of a study as the texts of allocation-key.json and masked-key.json.
#pragma once

#include <string>
#include <string_view>

#include "protocols/allocation.h"

namespace protocols {

std::string toJson(const AllocationKey& key);
std::string toJson(const MaskedKey& key);

/// `where` names the source in errors. Throws badInput on malformed text.
AllocationKey allocationKeyFromJson(std::string_view json, const std::string& where);
MaskedKey maskedKeyFromJson(std::string_view json, const std::string& where);

}  // namespace protocols
