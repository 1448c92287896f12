#include "study/bench/bench_fabrics.h"

#include <cstdio>

#include "rendering/fabrics/drawn/drawn_patch.h"
#include "stats/kernels/threads.h"
#include "study/bench/median_time.h"

namespace study::bench {

namespace {

constexpr int patches = 64;

/// Mean time of one new patch of `pixels` squared, drawn by `threads` threads.
BenchRow patchRow(int pixels, unsigned threads)
{
    const double milliseconds = medianMilliseconds(3, [&] {
        stats::onThreads(patches, threads, [&](std::size_t i) { rendering::fabrics::drawPatch(1, i, {pixels, 0.3}); });
    });
    char note[80];
    std::snprintf(note, sizeof note, "%.0f patches a second; every one another construction", 1000 * patches / milliseconds);
    const std::string side = std::to_string(pixels);
    return {"training patch of drawn fabric " + side + "x" + side,
            threads == 1 ? "1 thread" : std::to_string(threads) + " threads",
            milliseconds / patches,
            {},
            "",
            note};
}

}  // namespace

std::vector<BenchRow> benchFabrics() { return {patchRow(128, 1), patchRow(128, 2)}; }

}  // namespace study::bench
