/* Numerical factors: fronts are assembled, their own columns eliminated, and what is left goes up to their parents. */
#include "base/clones.h"
#include "edcore.h"
#include "system/ldl_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH = 32, TILE_ROWS = 8, TILE_COLUMNS = 4 }; /* columns eliminated at a time; size of a product in registers */

typedef double vector __attribute__((vector_size(32), aligned(8), may_alias));

ed_ldl *ed_ldl_new(int n, int last, const int *column_start, const int *row)
{
  ed_ldl *ldl = calloc(1, sizeof *ldl);
  if (!ldl)
    return NULL;
  const size_t one = (size_t)n + 1;
  ldl->n = n;
  ldl->vanished = -1;
  ldl->order = malloc(one * sizeof *ldl->order);
  ldl->inverse = malloc(one * sizeof *ldl->inverse);
  ldl->block = malloc(one * sizeof *ldl->block);
  ldl->d = calloc(one, sizeof *ldl->d);
  ldl->scale = calloc(one, sizeof *ldl->scale);
  ldl->lanes = malloc(one * ED_LDL_LANES * sizeof *ldl->lanes);
  int made = ldl->order && ldl->inverse && ldl->block && ldl->d && ldl->scale && ldl->lanes &&
             ed_ldl_analyse(ldl, last, column_start, row);
  if (made) {
    const size_t packed = ((size_t)ldl->most_rows + TILE_ROWS) * DEPTH * sizeof(double);
    ldl->l = calloc(ldl->panel_size + 1, sizeof *ldl->l);
    ldl->stack = malloc((ldl->stack_size + 1) * sizeof *ldl->stack);
    ldl->left = malloc(packed);
    ldl->right = malloc(packed);
    ldl->gathered = malloc(((size_t)ldl->most_rows + 1) * ED_LDL_LANES * sizeof *ldl->gathered);
    made = ldl->l && ldl->stack && ldl->left && ldl->right && ldl->gathered;
  }
  if (!made) {
    ed_ldl_free(ldl);
    return NULL;
  }
  return ldl;
}

void ed_ldl_free(ed_ldl *ldl)
{
  if (!ldl)
    return;
  void *all[] = {ldl->order, ldl->inverse, ldl->block, ldl->row_of, ldl->place, ldl->from,  ldl->to,   ldl->l,
                 ldl->d,     ldl->scale,   ldl->stack, ldl->left,   ldl->right, ldl->lanes, ldl->gathered};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    free(all[i]);
  free(ldl);
}

/* A tile of the target -= left right^T, of which so many rows and columns are there, and what is on or below the diagonal: the first
 * column begins at row `diagonal`. */
static inline void subtract_tile(int depth, const double *restrict left, const double *restrict right, int rows, int columns, int diagonal,
                                 double *restrict target, size_t ld)
{
  vector sum[TILE_COLUMNS][2] = {{{0.0}}};
  for (int k = 0; k < depth; k++) {
    const vector low = *(const vector *)(left + TILE_ROWS * k), high = *(const vector *)(left + TILE_ROWS * k + 4);
    for (int j = 0; j < TILE_COLUMNS; j++) {
      sum[j][0] += low * right[TILE_COLUMNS * k + j];
      sum[j][1] += high * right[TILE_COLUMNS * k + j];
    }
  }
  if (rows == TILE_ROWS && columns == TILE_COLUMNS && diagonal + TILE_COLUMNS <= 1) {
    for (int j = 0; j < TILE_COLUMNS; j++) {
      *(vector *)(target + (size_t)j * ld) -= sum[j][0];
      *(vector *)(target + (size_t)j * ld + 4) -= sum[j][1];
    }
    return;
  }
  for (int j = 0; j < columns; j++)
    for (int i = j + diagonal > 0 ? j + diagonal : 0; i < rows; i++)
      target[(size_t)j * ld + (size_t)i] -= sum[j][i / 4][i % 4];
}

ED_CLONES static void subtract_product(int rows, int columns, int depth, const double *l, size_t ld, const double *d, double *target,
                                       size_t target_ld, double *restrict left, double *restrict right)
{
  for (int i = 0; i < rows; i += TILE_ROWS)
    for (int k = 0; k < depth; k++)
      for (int t = 0; t < TILE_ROWS; t++)
        left[(size_t)i * (size_t)depth + (size_t)(k * TILE_ROWS + t)] = i + t < rows ? l[(size_t)k * ld + (size_t)(i + t)] : 0.0;
  for (int j = 0; j < columns; j += TILE_COLUMNS)
    for (int k = 0; k < depth; k++)
      for (int t = 0; t < TILE_COLUMNS; t++)
        right[(size_t)j * (size_t)depth + (size_t)(k * TILE_COLUMNS + t)] = j + t < columns ? d[k] * l[(size_t)k * ld + (size_t)(j + t)] : 0.0;
  for (int j = 0; j < columns; j += TILE_COLUMNS) {
    const int wide = columns - j < TILE_COLUMNS ? columns - j : TILE_COLUMNS;
    for (int i = j / TILE_ROWS * TILE_ROWS; i < rows; i += TILE_ROWS) {
      const int high = rows - i < TILE_ROWS ? rows - i : TILE_ROWS;
      subtract_tile(depth, left + (size_t)i * (size_t)depth, right + (size_t)j * (size_t)depth, high, wide, j - i,
                    target + (size_t)j * target_ld + i, target_ld);
    }
  }
}

/* Updates of the children are added to the front of their parent: its own columns are in the panel, the rest in `update`. */
static void add_children(const ed_ldl *ldl, int b, double *panel, double *update, const double *waiting_end)
{
  const ed_ldl_block *own = &ldl->block[b];
  const size_t rows = (size_t)own->rows, width = (size_t)own->width, below = rows - width;
  const double *child_update = waiting_end;
  for (int c = b - 1, left = own->children; left > 0; c--) {
    const ed_ldl_block *child = &ldl->block[c];
    if (child->parent != b)
      continue;
    left--;
    const size_t size = (size_t)(child->rows - child->width);
    const int *place = ldl->place + child->index + (size_t)child->width;
    child_update -= size * size;
    for (size_t j = 0; j < size; j++) {
      const size_t column = (size_t)place[j];
      const double *value = child_update + j * size;
      double *target = column < width ? panel + column * rows : update + (column - width) * below - width;
      for (size_t i = j; i < size; i++)
        target[place[i]] += value[i];
    }
  }
}

/* Eliminates columns k0..k1 of the panel among themselves. */
static void eliminate(ed_ldl *ldl, const ed_ldl_block *own, double *panel, int k0, int k1, double vanishing)
{
  const size_t ld = (size_t)own->rows;
  for (int k = k0; k < k1; k++) {
    double *column = panel + (size_t)k * ld, pivot = column[k];
    const int at = own->first + k;
    column[k] = 1.0;
    if (!(fabs(pivot) > vanishing * ldl->scale[at])) {
      ldl->d[at] = 1.0;
      memset(column + k + 1, 0, (size_t)(own->rows - k - 1) * sizeof *column);
      ldl->n_vanished++;
      ldl->vanished = ldl->vanished < 0 ? at : ldl->vanished;
      continue;
    }
    ldl->d[at] = pivot;
    ldl->negative += pivot < 0.0;
    const double inverse = 1.0 / pivot;
    for (int i = k + 1; i < own->rows; i++)
      column[i] *= inverse;
    for (int j = k + 1; j < k1; j++) {
      double *restrict other = panel + (size_t)j * ld;
      const double factor = pivot * column[j];
      for (int i = j; i < own->rows; i++)
        other[i] -= factor * column[i];
    }
  }
}

int ed_ldl_factor(ed_ldl *ldl, const double *value, double vanishing)
{
  double *end = ldl->stack; /* of the updates that wait */
  ldl->vanished = -1;
  ldl->n_vanished = ldl->negative = 0;
  memset(ldl->l, 0, ldl->panel_size * sizeof *ldl->l);
  for (int b = 0; b < ldl->n_blocks; b++) {
    const ed_ldl_block *own = &ldl->block[b];
    const size_t ld = (size_t)own->rows, below = (size_t)(own->rows - own->width);
    double *panel = ldl->l + own->panel, *update = end;
    for (int k = own->entries; k < own->entries + own->n_entries; k++)
      ldl->l[ldl->to[k]] += value[ldl->from[k]];
    for (int k = 0; k < own->width; k++)
      ldl->scale[own->first + k] = fabs(panel[(size_t)k * ld + (size_t)k]);
    memset(update, 0, below * below * sizeof *update);
    add_children(ldl, b, panel, update, end);
    for (int k0 = 0; k0 < own->width; k0 += DEPTH) {
      const int k1 = own->width - k0 < DEPTH ? own->width : k0 + DEPTH;
      const double *l = panel + (size_t)k0 * ld, *d = ldl->d + own->first + k0;
      eliminate(ldl, own, panel, k0, k1, vanishing);
      if (k1 < own->width)
        subtract_product(own->rows - k1, own->width - k1, k1 - k0, l + k1, ld, d, panel + (size_t)k1 * ld + k1, ld, ldl->left, ldl->right);
      if (below)
        subtract_product((int)below, (int)below, k1 - k0, l + own->width, ld, d, update, below, ldl->left, ldl->right);
    }
    for (int c = b - 1, left = own->children; left > 0; c--)
      if (ldl->block[c].parent == b) {
        const size_t size = (size_t)(ldl->block[c].rows - ldl->block[c].width);
        end -= size * size;
        left--;
      }
    memmove(end, update, below * below * sizeof *update);
    end += below * below;
  }
  return ldl->n_vanished;
}

int ed_ldl_vanished(const ed_ldl *ldl)
{
  return ldl->vanished < 0 ? -1 : ldl->order[ldl->vanished];
}

int ed_ldl_negative(const ed_ldl *ldl)
{
  return ldl->negative;
}

double ed_ldl_nonzeros(const ed_ldl *ldl)
{
  double sum = 0.0;
  for (int b = 0; b < ldl->n_blocks; b++)
    sum += (double)ldl->block[b].width * (double)ldl->block[b].rows;
  return sum;
}
