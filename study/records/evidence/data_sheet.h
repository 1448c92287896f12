// What a study stores about people, where, how long and who reads it: `vis2hap study data-sheet`, for an ethics board. It is made
// from the study itself: its tables, files, modes, participants, erasures and acts. It holds no data about people, no condition
// and no label.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "database/study_store.h"

namespace study::records {

/// The sheet as JSON (schema vis2hap.data-sheet/1).
nlohmann::ordered_json dataSheetOf(const database::StudyStore& store);

}  // namespace study::records
