// The state of a study: progress of each participant, planned and reached balance, flags on the data. Blinded.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "database/study_store.h"

namespace study::records {

/// The object of `study status --json`, schema vis2hap.status/1.
nlohmann::ordered_json statusOf(const database::StudyStore& store);

/// The same object as lines of text.
std::string textOf(const nlohmann::ordered_json& status);

}  // namespace study::records
