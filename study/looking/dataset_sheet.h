// A data set as it is gone through before a study: what there is of each fabric, and one fabric's signals on a sheet.
#pragma once

#include <filesystem>

#include "study/looking/seen_signal.h"

namespace study::looking {

struct FabricCounts {
    std::string id, name, structure;
    int photographs = 0, frames = 0, knownHeights = 0, strokes = 0;
    int most() const;  ///< of any signal
    bool operator==(const FabricCounts&) const = default;
};

struct DatasetOverview {
    std::string name;
    std::string about;  ///< a line: pairing, pitches, rate and speed of strokes, licence
    std::vector<FabricCounts> fabrics;
};

/// Reads dataset.json and the names of the files. Throws badInput where the folder is no data set, or belongs to a study
/// that is not unblinded.
DatasetOverview overviewOf(const std::filesystem::path& folder);

struct FabricSheet {
    std::vector<SeenSignal> signals;
    std::vector<std::string> faults;  ///< what could not be read, a sentence each
};

/// Photograph, tactile frame, height (known, or computed by the data set's calibration) and stroke number `sample` (from
/// 0) of a fabric, as far as there are so many. Throws badInput as `overviewOf` does, and for an unknown fabric.
FabricSheet sheetOf(const std::filesystem::path& folder, const std::string& fabric, int sample);

}  // namespace study::looking
