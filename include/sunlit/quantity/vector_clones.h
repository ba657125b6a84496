// Run-time dispatch of hot loops: a function marked SUNLIT_VECTOR_CLONES is compiled once for the plain
// instruction set and once for AVX2, and the loader picks. Both run the same operations in the same order (no
// fused multiply-add, no reassociation), so they give the same bits; elsewhere the mark means nothing and the
// plain path is all there is.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__) && !defined(SUNLIT_PLAIN_LOOPS)
#define SUNLIT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SUNLIT_VECTOR_CLONES
#endif
