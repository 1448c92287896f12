// The speed and the error of what leads from ready signals to friction images, and of friction records: on
// textures and traces whose true values are known.
#pragma once

#include <vector>

#include "study/bench/bench.h"

namespace study::bench {

/// One row each: nine conditions at both scales and with either extension, resampling at import, complex
/// spectrogram and back, the mean through a magnitude alone. One thread; a second or two.
std::vector<BenchRow> benchComposition();

}  // namespace study::bench
