// Speed and error of the steps from signals to friction images and of friction records, on textures and traces whose true
// values are known.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// One row each: nine conditions at both scales and with either extension, resampling at import, complex spectrogram and back,
/// the mean recovered from a magnitude. Takes one thread and a second or two.
std::vector<BenchRow> benchComposition();

}  // namespace study::bench
