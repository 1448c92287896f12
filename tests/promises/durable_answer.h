// The time of an answer that is on the disk, beside a bare SQLite transaction of the same rows.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise ofDurableAnswers(const Effort& effort);

}  // namespace tests::promises
