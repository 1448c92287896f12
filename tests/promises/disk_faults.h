// Writes and syncs that fail, at every position of one session.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise afterDiskFaults(const Effort& effort);

}  // namespace tests::promises
