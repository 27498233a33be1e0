#include "space/block.h"

#include "base/clones.h"

#include <math.h>

/* Columns of a tile, whose sums stay in registers. */
enum { TILE = 4 };

typedef double lanes __attribute__((vector_size(ED_BLOCK_ROWS * sizeof(double))));
typedef double loose __attribute__((vector_size(ED_BLOCK_ROWS * sizeof(double)), aligned(sizeof(double)), may_alias));

/* `vectors` and `columns` are constant where this is inlined. */
static inline __attribute__((always_inline)) void tile(const int vectors, const int columns, int depth, const double *a, size_t lda,
                                                       const double *b, size_t step, size_t next, double *c, size_t ldc)
{
  lanes sum[2][TILE];
  for (int j = 0; j < columns; j++)
    for (int v = 0; v < vectors; v++)
      sum[v][j] = *(const loose *)(c + (size_t)j * ldc + v * ED_BLOCK_ROWS);
  for (int k = 0; k < depth; k++, a += lda, b += step)
    for (int j = 0; j < columns; j++)
      for (int v = 0; v < vectors; v++)
        sum[v][j] -= *(const loose *)(a + v * ED_BLOCK_ROWS) * b[(size_t)j * next];
  for (int j = 0; j < columns; j++)
    for (int v = 0; v < vectors; v++)
      *(loose *)(c + (size_t)j * ldc + v * ED_BLOCK_ROWS) = sum[v][j];
}

static inline __attribute__((always_inline)) void strip(const int columns, int rows, int depth, const double *a, size_t lda, const double *b,
                                                        size_t step, size_t next, double *c, size_t ldc)
{
  int i = 0;
  for (; i + 2 * ED_BLOCK_ROWS <= rows; i += 2 * ED_BLOCK_ROWS)
    tile(2, columns, depth, a + i, lda, b, step, next, c + i, ldc);
  if (i < rows)
    tile(1, columns, depth, a + i, lda, b, step, next, c + i, ldc);
}

ED_CLONES void ed_block_subtract(int rows, int columns, int depth, const double *a, size_t lda, const double *b, size_t step, size_t next,
                                 double *c, size_t ldc)
{
  int j = 0;
  for (; j + TILE <= columns; j += TILE)
    strip(TILE, rows, depth, a, lda, b + (size_t)j * next, step, next, c + (size_t)j * ldc, ldc);
  for (; j < columns; j++)
    strip(1, rows, depth, a, lda, b + (size_t)j * next, step, next, c + (size_t)j * ldc, ldc);
}

ED_CLONES void ed_block_subtract_square(int rows, int depth, const double *a, size_t lda, double *c)
{
  for (int j = 0; j < rows; j += TILE)
    strip(TILE, rows - j, depth, a + j, lda, a + j, lda, 1, c + (size_t)j * (size_t)rows + j, (size_t)rows);
}

static int least_of(int a, int b)
{
  return a < b ? a : b;
}

double ed_block_factor(int width, double *matrix, size_t ld, const double *own, double least)
{
  double smallest = HUGE_VAL;
  for (int j = 0; j < width; j += TILE) {
    double *block = matrix + (size_t)j * ld + j;
    const int columns = least_of(TILE, width - j), rows = ed_block_rows(width) - j;
    ed_block_subtract(rows, columns, j, matrix + j, ld, matrix + j, ld, 1, block, ld);
    for (int k = 0; k < columns; k++) {
      double *column = block + (size_t)k * ld;
      const double ratio = column[k] / own[j + k];
      if (!(ratio > least && column[k] > 0.0))
        return 0.0;
      smallest = ratio < smallest ? ratio : smallest;
      column[k] = 1.0 / sqrt(column[k]);
      for (int i = k + 1; i < rows; i++)
        column[i] *= column[k];
      for (int l = k + 1; l < columns; l++)
        for (int i = l; i < rows; i++)
          block[(size_t)l * ld + (size_t)i] -= column[l] * column[i];
    }
  }
  return smallest;
}

ED_CLONES static void scale_column(int rows, double factor, double *x)
{
  for (int i = 0; i < rows; i++)
    x[i] *= factor;
}

ED_CLONES static void subtract_column(int rows, double factor, const double *restrict a, double *restrict x)
{
  for (int i = 0; i < rows; i++)
    x[i] -= factor * a[i];
}

void ed_block_divide(int rows, double *x, size_t ldx, int width, const double *L, size_t ld)
{
  for (int j = 0; j < width; j += TILE) {
    const int columns = least_of(TILE, width - j);
    double *own = x + (size_t)j * ldx;
    ed_block_subtract(rows, columns, j, x, ldx, L + j, ld, 1, own, ldx);
    for (int k = 0; k < columns; k++) {
      const double *column = L + (size_t)(j + k) * ld + j;
      scale_column(rows, column[k], own + (size_t)k * ldx);
      for (int l = k + 1; l < columns; l++)
        subtract_column(rows, column[l], own + (size_t)k * ldx, own + (size_t)l * ldx);
    }
  }
}

void ed_block_divide_back(int rows, double *x, size_t ldx, int width, const double *L, size_t ld)
{
  for (int j = (width - 1) / TILE * TILE; j >= 0; j -= TILE) {
    const int columns = least_of(TILE, width - j), after = j + columns;
    double *own = x + (size_t)j * ldx;
    ed_block_subtract(rows, columns, width - after, x + (size_t)after * ldx, ldx, L + (size_t)j * ld + after, 1, ld, own, ldx);
    for (int k = columns - 1; k >= 0; k--) {
      const double *column = L + (size_t)(j + k) * ld + j;
      for (int l = k + 1; l < columns; l++)
        subtract_column(rows, column[l], own + (size_t)l * ldx, own + (size_t)k * ldx);
      scale_column(rows, column[k], own + (size_t)k * ldx);
    }
  }
}
