// The signal stages on real recordings, compared with known values. README, "Bench on recordings", describes the layout of
// the folder. Every part may be missing.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rendering/signals/tactile/press_folder.h"
#include "study/bench/bench_row.h"

namespace study::bench {

struct RecordingsBench {
    std::vector<BenchRow> rows;
    std::vector<std::string> skipped;  ///< missing parts of the folder, one line each
};

/// truemap_heightmaps/*.tmd       integration from central differences, without and with 2 % noise
/// gsmatlab_groove/               heightmap.tmd and imageNN.png: groove integrated; slopes from the lamps, fitted on the top
///                                half and tested on the bottom half; shape from shading with an unknown direction of light
/// taxim_gelsight/                background.png and press_NN.png: ball of 2.0 mm, 0.1245 mm per pixel; cross-validated
/// gelsight_wear_surfaces/*S<grit>*normalmap.*   grain order: the coarser paper (lower grit) has the longer autocorrelation
/// `begins` gets the name of each part before its work; may be empty.
RecordingsBench benchRecordings(const std::filesystem::path& folder, const rendering::Decode& decodeOther,
                                const std::function<void(const std::string& part)>& begins = {});

}  // namespace study::bench
