/* Hot kernels are compiled for several instruction sets and the loader picks one. Results are the same bit for bit: sums run over
 * fixed lanes, exponentials and logarithms are our own, and contraction to fused multiply-add is off (-ffp-contract=off). */
#ifndef ED_CLONES_H
#define ED_CLONES_H

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(ED_NO_CLONES)
#define ED_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define ED_CLONES
#endif

#endif
