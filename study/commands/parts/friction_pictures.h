// The middles of a study's friction images for the figure of its report.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "database/study_store.h"
#include "reports/data/study_data.h"

namespace study::commands {

/// One picture for each condition and fabric, in the order of `data`. Empty while the study is blinded, for more than 20 fabrics
/// or 12 conditions, and, with one line to `note`, where the images or their key are missing or altered.
std::vector<reports::FrictionPicture> frictionPictures(const database::StudyStore& store, const reports::StudyData& data,
                                                       const std::function<void(const std::string& line)>& note);

}  // namespace study::commands
