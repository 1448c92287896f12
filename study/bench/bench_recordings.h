// The signal stages on real recordings, against what is known of each: the figures by which the measured conditions can be
// trusted. The folder's layout is that of the recordings this project was built on (README, "Bench on recordings"); any part may
// be missing and is then named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rendering/signals/press_folder.h"
#include "study/bench/bench.h"

namespace study::bench {

struct RecordingsBench {
    std::vector<BenchRow> rows;
    std::vector<std::string> skipped;  ///< what the folder lacks, a line each
};

/// truemap_heightmaps/*.tmd       integration from central differences, without and with 2 % noise
/// gsmatlab_groove/               heightmap.tmd and imageNN.png: groove integrated; slopes from the lamps, learned on the top
/// half and read on
///                                the bottom half; shape from shading of each photograph, its light not told
/// taxim_gelsight/                background.png and press_NN.png: ball of 2.0 mm, 0.1245 mm per pixel; cross-validated
/// gelsight_wear_surfaces/*S<grit>*normalmap.*   grain order: the coarser paper (lower grit) has the longer autocorrelation
RecordingsBench benchRecordings(const std::filesystem::path& folder, const rendering::Decode& decodeOther);

}  // namespace study::bench
