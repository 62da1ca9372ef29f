// YARS_LANES before a function compiles it for SSE2, AVX2 and AVX-512 and picks at start-up what the machine has.
// Such functions hold simple loops without library calls, fused operations or sums across samples, so that all
// versions give the same bits. Sanitizers cannot run the resolver that picks: there the plain version serves.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define YARS_LANES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define YARS_LANES
#endif
