// Power cuts: the states that a disk can be in when it may drop, tear and reorder every write since the last sync of its file.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise afterPowerCuts(const Effort& effort);

}  // namespace tests::promises
