// What simulated participants cost, for curves of time over their number. Images are not rendered: percepts are drawn, so the
// study has the paper's size and no folder but one for the store.
#pragma once

namespace study::simulation {

/// Seconds for this many participants in memory, with tables' tests but without files; on all processors.
double secondsInMemory(int participants);

/// Seconds for this many participants through a store in a temporary folder, without the making of its study.
double secondsThroughStore(int participants);

}  // namespace study::simulation
