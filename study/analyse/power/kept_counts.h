// A file of finished counts, so that a long count of simulated studies continues after an interruption.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "stats/power/calibration.h"
#include "stats/power/planted_claims.h"

namespace study::analyse {

/// JSON: for each kind of count ("calibrate", "planted") its settings and the finished truths. The file is written as a whole
/// after each truth.
class KeptCounts {
public:
    /// Reads the file if it exists. Throws badInput where it is no such file.
    explicit KeptCounts(std::filesystem::path file);

    /// Names the settings of a kind. Throws badInput where the file holds counts of other settings.
    void require(const std::string& kind, const nlohmann::ordered_json& settings);
    /// The counts of a truth; null where they are not finished.
    nlohmann::ordered_json of(const std::string& kind, const std::string& truth) const;
    void add(const std::string& kind, const std::string& truth, const nlohmann::ordered_json& counts);

private:
    std::filesystem::path m_file;
    std::shared_ptr<nlohmann::ordered_json> m_root;
};

/// Takes finished counts from `kept` and stores new ones there. `kept` must outlive the count, which throws badInput for finished
/// counts of another number of studies.
void resumeFrom(KeptCounts& kept, stats::CalibrationOptions& options);
void resumeFrom(KeptCounts& kept, stats::PlantedOptions& options);

}  // namespace study::analyse
