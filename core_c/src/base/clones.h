/* Hot kernels are compiled for several instruction sets and the loader picks one. Results of bilinear and elastic layers are
 * the same bit for bit: sums run over eight fixed lanes and contraction to fused multiply-add is off (-ffp-contract=off).
 * The Menegotto-Pinto law takes its exponentials from the C library, whose last bit may differ between processors. */
#ifndef ED_CLONES_H
#define ED_CLONES_H

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(ED_NO_CLONES)
#define ED_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ED_CLONES
#endif

#endif
