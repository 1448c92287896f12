// The state of a study: progress of each participant, planned and reached balance, flags on the data. Blinded.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "database/keys.h"
#include "database/study_store.h"

namespace study::records {

/// The object of `study status --json`, schema vis2hap.status/1. The balance of the presentations needs the key.
nlohmann::ordered_json statusOf(const database::StudyStore& store, const database::Passphrase& passphrase);

/// The same object as lines of text.
std::string textOf(const nlohmann::ordered_json& status);

}  // namespace study::records
