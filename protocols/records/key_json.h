// The allocation key of a study as text.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "protocols/orders/allocation.h"

namespace protocols {

std::string toJson(const AllocationKey& key);

/// `where` names the source in errors. Throws badInput on malformed text.
AllocationKey allocationKeyFromJson(std::string_view json, const std::string& where);

/// The entries of a key of the versions up to 0.6.0, which holds no secret.
std::map<FileCode, AllocationKey::Entry> olderKeyEntriesFromJson(std::string_view json, const std::string& where);

}  // namespace protocols
