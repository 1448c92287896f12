// How a study stands: who is where, balance planned and reached, flags on the data. Blinded.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "database/study_store.h"

namespace study::records {

/// The object of `study status --json`, schema vis2hap.status/1.
nlohmann::ordered_json statusOf(const database::StudyStore& store);

/// The same in lines for people.
std::string textOf(const nlohmann::ordered_json& status);

}  // namespace study::records
