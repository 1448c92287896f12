// kill -9 at random moments of sessions in processes of their own.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise afterKills(const Effort& effort);

}  // namespace tests::promises
