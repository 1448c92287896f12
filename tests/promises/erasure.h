// Erased answers: whether somebody can guess them from what is left.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise afterErasure(const Effort& effort);

}  // namespace tests::promises
