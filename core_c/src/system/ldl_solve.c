/* Solutions with the factors of ldl_factor.c, right sides side by side in lanes. */
#include "base/clones.h"
#include "system/ldl_parts.h"

#include <string.h>

enum { ROWS = 4 }; /* done at a time */

typedef double vector __attribute__((vector_size(32), aligned(8), may_alias));
typedef struct __attribute__((may_alias)) {
  vector low, high; /* the lanes of one number */
} lanes;

/* sum[t] = over k of l[t stride + k step] x[k], for `rows` rows of a tile. */
static inline void row_sums(int rows, int count, const double *restrict l, size_t stride, size_t step, const lanes *restrict x, lanes *sum)
{
  if (rows == ROWS) {
    vector a[ROWS][2] = {{{0.0}}};
    for (int k = 0; k < count; k++)
      for (int t = 0; t < ROWS; t++) {
        const double factor = l[(size_t)t * stride + (size_t)k * step];
        a[t][0] += factor * x[k].low;
        a[t][1] += factor * x[k].high;
      }
    for (int t = 0; t < ROWS; t++)
      sum[t] = (lanes){a[t][0], a[t][1]};
    return;
  }
  for (int t = 0; t < rows; t++) {
    vector low = {0.0}, high = {0.0};
    for (int k = 0; k < count; k++) {
      const double factor = l[(size_t)t * stride + (size_t)k * step];
      low += factor * x[k].low;
      high += factor * x[k].high;
    }
    sum[t] = (lanes){low, high};
  }
}

static inline void subtract(lanes *a, const lanes *b)
{
  a->low -= b->low;
  a->high -= b->high;
}

ED_CLONES static void forward(const ed_ldl *ldl, int from, lanes *x)
{
  lanes sum[ROWS];
  for (int b = 0; b < ldl->n_blocks; b++) {
    const ed_ldl_block *own = &ldl->block[b];
    if (own->first + own->width <= from)
      continue;
    const size_t ld = (size_t)own->rows;
    const double *l = ldl->l + own->panel;
    const int *row = ldl->row_of + own->index;
    lanes *own_x = x + own->first;
    for (int i = 0; i < own->width; i += ROWS) {
      const int rows = own->width - i < ROWS ? own->width - i : ROWS;
      row_sums(rows, i, l + i, 1, ld, own_x, sum);
      for (int t = 0; t < rows; t++) {
        subtract(&own_x[i + t], &sum[t]);
        for (int k = 0; k < t; k++) {
          const double factor = l[(size_t)(i + k) * ld + (size_t)(i + t)];
          own_x[i + t].low -= factor * own_x[i + k].low;
          own_x[i + t].high -= factor * own_x[i + k].high;
        }
      }
    }
    for (int i = own->width; i < own->rows; i += ROWS) {
      const int rows = own->rows - i < ROWS ? own->rows - i : ROWS;
      row_sums(rows, own->width, l + i, 1, ld, own_x, sum);
      for (int t = 0; t < rows; t++)
        subtract(&x[row[i + t]], &sum[t]);
    }
  }
}

/* Divides by D unless it is asked for the motion alone, and goes back through L^T. */
ED_CLONES static void backward(const ed_ldl *ldl, int divide, lanes *x, lanes *restrict y)
{
  lanes sum[ROWS];
  for (int b = ldl->n_blocks - 1; b >= 0; b--) {
    const ed_ldl_block *own = &ldl->block[b];
    const size_t ld = (size_t)own->rows;
    const double *l = ldl->l + own->panel;
    const int *row = ldl->row_of + own->index;
    for (int i = 0; i < own->rows; i++)
      y[i] = x[row[i]];
    for (int i = 0; divide && i < own->width; i++) {
      const double inverse = 1.0 / ldl->d[own->first + i];
      y[i].low *= inverse;
      y[i].high *= inverse;
    }
    for (int end = own->width; end > 0;) {
      const int rows = end % ROWS ? end % ROWS : ROWS, i = end - rows;
      row_sums(rows, own->rows - end, l + (size_t)i * ld + end, ld, 1, y + end, sum);
      for (int t = rows - 1; t >= 0; t--) {
        subtract(&y[i + t], &sum[t]);
        for (int k = t + 1; k < rows; k++) {
          const double factor = l[(size_t)(i + t) * ld + (size_t)(i + k)];
          y[i + t].low -= factor * y[i + k].low;
          y[i + t].high -= factor * y[i + k].high;
        }
      }
      end = i;
    }
    memcpy(x + own->first, y, (size_t)own->width * sizeof *y);
  }
}

void ed_ldl_solve(ed_ldl *ldl, int n_rhs, double *rhs)
{
  const int n = ldl->n;
  double *x = ldl->lanes;
  for (int first = 0; first < n_rhs; first += ED_LDL_LANES) {
    const int count = n_rhs - first < ED_LDL_LANES ? n_rhs - first : ED_LDL_LANES;
    int from = n; /* nothing but zeros before it */
    memset(x, 0, (size_t)n * ED_LDL_LANES * sizeof *x);
    for (int c = 0; c < count; c++) {
      const double *b = rhs + (size_t)(first + c) * (size_t)n;
      for (int k = 0; k < n; k++) {
        const double value = b[ldl->order[k]];
        x[(size_t)k * ED_LDL_LANES + (size_t)c] = value;
        from = value != 0.0 && k < from ? k : from;
      }
    }
    forward(ldl, from, (lanes *)x);
    backward(ldl, 1, (lanes *)x, (lanes *)ldl->gathered);
    for (int c = 0; c < count; c++)
      for (int k = 0; k < n; k++)
        rhs[(size_t)(first + c) * (size_t)n + (size_t)ldl->order[k]] = x[(size_t)k * ED_LDL_LANES + (size_t)c];
  }
}

void ed_ldl_free_motion(ed_ldl *ldl, int column, double *x)
{
  double *side = ldl->lanes;
  memset(side, 0, (size_t)ldl->n * ED_LDL_LANES * sizeof *side);
  side[(size_t)ldl->inverse[column] * ED_LDL_LANES] = 1.0;
  backward(ldl, 0, (lanes *)side, (lanes *)ldl->gathered);
  for (int k = 0; k < ldl->n; k++)
    x[ldl->order[k]] = side[(size_t)k * ED_LDL_LANES];
}
