// OpenBLAS, by which OpenCV solves and multiplies, gets one thread. Loops of this program are parallel themselves, and threads of
// OpenBLAS wait by spinning: beside two busy programs on two processors, `calibrate` took six times as long. The last bits no
// longer depend on the number of processors.
#pragma once

#include <dlfcn.h>

#include <cstdlib>

namespace protocols {

/// Call once, when the program starts. OPENBLAS_NUM_THREADS in the environment counts for more. Nothing happens where another
/// library takes the place of OpenBLAS.
inline void useOneBlasThread()
{
    if (std::getenv("OPENBLAS_NUM_THREADS") != nullptr) return;
    if (void* found = ::dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<void (*)(int)>(found)(1);
}

}  // namespace protocols
