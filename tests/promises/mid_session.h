// A database that is deleted, replaced, renamed or moved in mid-session, and a file system that is full, read-only or slow.
#pragma once

#include "tests/promises/promise.h"

namespace tests::promises {

Promise afterMidSessionHarm(const Effort& effort);

}  // namespace tests::promises
