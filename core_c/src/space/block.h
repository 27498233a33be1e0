/* Dense blocks of the factors. A block lies by columns `ld` apart, whose `rows` are a multiple of ED_BLOCK_ROWS: whole vectors. Sums run in
 * one order whatever the instruction set, so that results are the same on all machines. */
#ifndef ED_BLOCK_H
#define ED_BLOCK_H

#include <stddef.h>

enum { ED_BLOCK_ROWS = 4 };

static inline int ed_block_rows(int rows)
{
  return (rows + ED_BLOCK_ROWS - 1) / ED_BLOCK_ROWS * ED_BLOCK_ROWS;
}

/* c[i, j] -= sum over k < depth of a[i, k] b[k step + j next] */
void ed_block_subtract(int rows, int columns, int depth, const double *a, size_t lda, const double *b, size_t step, size_t next, double *c,
                       size_t ldc);
/* The lower triangle of c -= a a^T; what is above the diagonal becomes anything. */
void ed_block_subtract_square(int rows, int depth, const double *a, size_t lda, double *c);
/* Cholesky's factor L of the lower triangle, width x width, in place, with 1 / L_jj on the diagonal; what is above becomes anything.
 * own: terms of the diagonal before anything was eliminated. Returns the least pivot / own; 0 where one is not above `least`, at which it
 * stops. */
double ed_block_factor(int width, double *matrix, size_t ld, const double *own, double least);
/* x <- x L^-T and x <- x L^-1 */
void ed_block_divide(int rows, double *x, size_t ldx, int width, const double *L, size_t ld);
void ed_block_divide_back(int rows, double *x, size_t ldx, int width, const double *L, size_t ld);

#endif
