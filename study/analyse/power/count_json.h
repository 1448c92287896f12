// Counts of simulated studies as JSON: in files that --resume keeps and in files of shards.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/files/errors.h"
#include "stats/power/planted_claims.h"

namespace study::analyse {

/// The fault of counts that this program did not write so. `truth`: what was counted. `nextStep`: what the user can do.
protocols::Error damagedCounts(const std::string& truth, const std::string& nextStep);

/// [[studies, rejected, undefined], ...], one for each test.
nlohmann::ordered_json jsonOf(const std::vector<stats::Rejections>& counts);
/// Throws damagedCounts() where they are not as jsonOf() writes them.
std::vector<stats::Rejections> rejectionsFrom(const nlohmann::ordered_json& json, const std::string& truth,
                                              const std::string& nextStep);

/// Throws badInput, naming `truth`, where a test or a mean is not over `studies` studies.
void requireStudies(const std::vector<stats::Rejections>& counts, std::size_t studies, const std::string& truth,
                    const std::string& nextStep);
void requireStudies(const std::vector<stats::PlantedRow>& rows, std::size_t studies, const std::string& truth,
                    const std::string& nextStep);

/// [{"name", "coverage", "these", "alike", "reference", "difference"}, ...]; a mean is [studies, sum, sum of squares, each].
nlohmann::ordered_json jsonOf(const std::vector<stats::PlantedRow>& rows);
/// Earlier versions wrote no "each". Throws damagedCounts().
std::vector<stats::PlantedRow> plantedRowsFrom(const nlohmann::ordered_json& json, const std::string& truth,
                                               const std::string& nextStep);

}  // namespace study::analyse
