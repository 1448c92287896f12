// What the analysis leaves out or takes for granted, because the design is another than the paper's or the reader asked for less.
#pragma once

#include <string>
#include <vector>

#include "reports/data/analysis_options.h"
#include "reports/data/study_data.h"

namespace reports {

/// Pairs of conditions that are compared without being asked for: all of up to 45 conditions.
inline constexpr std::size_t mostUsualPairs = 1000;

/// Number of pairs of the study's conditions.
std::size_t pairCount(const StudyData& data);

/// Whether all pairs of conditions are compared.
bool comparesAllPairs(const StudyData& data);

/// Fewer of either say too little of how differences vary: without any, claims for fabrics like these are then made far more
/// often than their level. `report --resimulate` counts them.
inline constexpr std::size_t fewestParticipants = 5, fewestFabrics = 5;

/// Whether both are enough for claims for fabrics like these.
bool canSpeakForOtherFabrics(const StudyData& data);

/// Sentences for the page and for statistics.json; none for a complete study of the paper's design.
std::vector<std::string> designLimits(const StudyData& data, Depth depth);

}  // namespace reports
