#include "tests/fuzz/coverage.h"

#include <cstdint>

namespace {

// Edges fall into 2^16 cells by a hash of both ends; two edges in one cell only hide a new input.
bool seen[1 << 16];
bool isNew = false;
std::uintptr_t before = 0;

}  // namespace

// Declared by GCC's option -fsanitize-coverage=trace-pc; it must not be instrumented itself.
// It runs at every branch, so it is the one function that is optimised.
extern "C" __attribute__((no_sanitize_coverage, no_sanitize_address, no_sanitize_undefined, optimize("O2"))) void
__sanitizer_cov_trace_pc()
{
    const auto place = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
    const std::uintptr_t hash = place ^ (place >> 16);
    bool& cell = seen[(hash ^ before) & 0xFFFF];
    if (!cell) isNew = cell = true;
    before = hash >> 1;
}

namespace fuzz {

bool hasNewCoverage()
{
    const bool was = isNew;
    isNew = false;
    return was;
}

}  // namespace fuzz
