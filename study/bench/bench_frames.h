// Frames of a tactile sensor to friction images, memory to memory.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// A cloth under a sensor of 320 x 240 and of 640 x 480 pixels, by `fast` and by the functions of `vis2hap render`. One thread.
/// Error: root mean square of the levels against the accurate image with the same extension.
std::vector<BenchRow> benchFrames();

}  // namespace study::bench
