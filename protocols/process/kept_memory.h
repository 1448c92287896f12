// Memory that a program frees is kept for its next image. Otherwise the system takes it back, and every page of the next one is
// faulted in again: a training step took 1.4 times as long, a friction image of a large frame seven times.
#pragma once

#include <malloc.h>

namespace protocols {

/// Call once, when the program starts.
inline void keepFreedMemory()
{
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest that glibc takes
    ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

}  // namespace protocols
