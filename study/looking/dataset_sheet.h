// Inspection of a data set before a study: number of samples of each fabric, and the signals of one fabric for a sheet.
#pragma once

#include <filesystem>

#include "study/looking/seen_signal.h"

namespace study::looking {

struct FabricCounts {
    std::string id, name, structure;
    int photographs = 0, frames = 0, knownHeights = 0, strokes = 0;
    int most() const;  ///< number of samples of the signal that has most
    bool operator==(const FabricCounts&) const = default;
};

struct DatasetOverview {
    std::string name;
    std::string about;  ///< one line: pairing, pitches, rate and speed of strokes, licence
    std::vector<FabricCounts> fabrics;
};

/// Reads dataset.json and the names of the files. Throws badInput if the folder is not a data set, or if it is part of a study
/// that is not unblinded.
DatasetOverview overviewOf(const std::filesystem::path& folder);

struct FabricSheet {
    std::vector<SeenSignal> signals;
    std::vector<std::string> faults;  ///< one sentence for each signal that could not be read
};

/// Signals of sample number `sample` (from 0) of a fabric: photograph, tactile frame, height (known, or computed with the
/// calibration of the data set) and stroke. Missing signals are left out. Throws badInput as overviewOf() does, and for an
/// unknown fabric.
FabricSheet sheetOf(const std::filesystem::path& folder, const std::string& fabric, int sample);

}  // namespace study::looking
