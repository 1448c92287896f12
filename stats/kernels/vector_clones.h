// Compiles one function for several instruction sets; the program chooses the best one when it starts. Without
// fused products (-ffp-contract=off) all of them give the same bits.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define STATS_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define STATS_VECTOR_CLONES
#endif
