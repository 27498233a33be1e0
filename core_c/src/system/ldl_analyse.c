/* Order of elimination, blocks of columns with one pattern, and their fronts. */
#include "system/ldl_parts.h"

#include <amd.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* The pattern in the order of elimination: of each column the later rows, of each row the earlier columns. */
typedef struct {
  int *column_start, *row, *entry; /* entry: number in the caller's matrix */
  int *row_start, *column;
  int *parent, *count;             /* elimination tree; rows of each column of L */
  int *work, *next;
} pattern;

static void free_pattern(pattern *p)
{
  int *all[] = {p->column_start, p->row, p->entry, p->row_start, p->column, p->parent, p->count, p->work, p->next};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    free(all[i]);
}

static int make_pattern(pattern *p, int n, int entries)
{
  const size_t one = ((size_t)n + 1) * sizeof(int), all = ((size_t)entries + 1) * sizeof(int);
  int **by_column[] = {&p->column_start, &p->row_start, &p->parent, &p->count, &p->work, &p->next};
  int **by_entry[] = {&p->row, &p->entry, &p->column};
  int made = 1;
  for (size_t i = 0; i < sizeof by_column / sizeof *by_column; i++)
    made &= (*by_column[i] = malloc(one)) != NULL;
  for (size_t i = 0; i < sizeof by_entry / sizeof *by_entry; i++)
    made &= (*by_entry[i] = malloc(all)) != NULL;
  return made;
}

static int order_columns(ed_ldl *ldl, int last, const int *column_start, const int *row)
{
  const int inner = ldl->n - last;
  int *start = malloc(((size_t)inner + 1) * sizeof *start);
  int *rows = malloc(((size_t)column_start[ldl->n] + 1) * sizeof *rows);
  int made = start && rows, count = 0;
  for (int j = 0; made && j < inner; j++) {
    start[j] = count;
    for (int k = column_start[j]; k < column_start[j + 1]; k++)
      if (row[k] < inner)
        rows[count++] = row[k];
  }
  if (made && inner > 0) {
    start[inner] = count;
    made = amd_order(inner, start, rows, ldl->order, NULL, NULL) >= AMD_OK;
  }
  free(start);
  free(rows);
  for (int k = inner; k < ldl->n; k++)
    ldl->order[k] = k;
  return made;
}

static void arrange(ed_ldl *ldl, pattern *p, const int *column_start, const int *row)
{
  const int n = ldl->n;
  for (int k = 0; k < n; k++)
    ldl->inverse[ldl->order[k]] = k;
  memset(p->column_start, 0, ((size_t)n + 1) * sizeof(int));
  memset(p->row_start, 0, ((size_t)n + 1) * sizeof(int));
  for (int pass = 0; pass < 2; pass++) {
    for (int j = 0; j < n; j++)
      for (int k = column_start[j]; k < column_start[j + 1]; k++) {
        const int a = ldl->inverse[j], b = ldl->inverse[row[k]], early = a < b ? a : b, late = a < b ? b : a;
        if (pass == 0) {
          p->column_start[early + 1]++;
          p->row_start[late + 1]++;
        } else {
          p->entry[p->work[early]] = k;
          p->row[p->work[early]++] = late;
          p->column[p->next[late]++] = early;
        }
      }
    for (int j = 0; pass == 0 && j < n; j++) {
      p->column_start[j + 1] += p->column_start[j];
      p->row_start[j + 1] += p->row_start[j];
      p->work[j] = p->column_start[j];
      p->next[j] = p->row_start[j];
    }
  }
}

/* Liu (1990): the elimination tree by paths that are shortened as they are walked. */
static void find_tree(const ed_ldl *ldl, pattern *p)
{
  int *ancestor = p->work;
  for (int i = 0; i < ldl->n; i++) {
    p->parent[i] = ancestor[i] = -1;
    for (int k = p->row_start[i]; k < p->row_start[i + 1]; k++)
      for (int j = p->column[k], up; j >= 0 && j < i; j = up) {
        up = ancestor[j];
        ancestor[j] = i;
        if (up < 0)
          p->parent[j] = i;
      }
  }
}

/* Renumbers so that each subtree is consecutive. */
static int order_by_tree(ed_ldl *ldl, pattern *p)
{
  const int n = ldl->n;
  int *child = p->work, *sibling = p->next, *path = malloc(((size_t)n + 1) * sizeof *path), *sorted = malloc(((size_t)n + 1) * sizeof *sorted);
  int done = 0;
  for (int j = 0; j < n; j++)
    child[j] = -1;
  for (int j = n - 1; path && sorted && j >= 0; j--)
    if (p->parent[j] >= 0) {
      sibling[j] = child[p->parent[j]];
      child[p->parent[j]] = j;
    }
  for (int root = 0; path && sorted && root < n; root++) {
    int depth = 0;
    if (p->parent[root] >= 0)
      continue;
    for (path[depth++] = root; depth > 0;) {
      const int j = path[depth - 1], down = child[j];
      if (down >= 0) {
        child[j] = sibling[down];
        path[depth++] = down;
      } else {
        sorted[done++] = ldl->order[j];
        depth--;
      }
    }
  }
  const int made = path && sorted;
  if (made)
    memcpy(ldl->order, sorted, (size_t)n * sizeof *sorted);
  free(path);
  free(sorted);
  return made;
}

static void count_rows(const ed_ldl *ldl, pattern *p)
{
  int *seen = p->work;
  for (int i = 0; i < ldl->n; i++) {
    p->count[i] = 1;
    seen[i] = i;
    for (int k = p->row_start[i]; k < p->row_start[i + 1]; k++)
      for (int j = p->column[k]; seen[j] != i; j = p->parent[j]) {
        p->count[j]++;
        seen[j] = i;
      }
  }
}

/* A block may take in its last child where that fills few places with zeros: long products are worth more than what the zeros
 * cost. The shares are those of CHOLMOD (Chen, Davis, Hager & Rajamanickam 2008); they change the speed alone. */
static int worth_merging(int width, double zeros, double places)
{
  return zeros == 0.0 || (width <= 4 && zeros < 0.8 * places) || (width <= 16 && zeros < 0.1 * places) ||
         (width <= 48 && zeros < 0.05 * places);
}

static double lower_places(double width, double rows)
{
  return width * rows - 0.5 * width * (width - 1.0);
}

static void find_blocks(ed_ldl *ldl, const pattern *p, double *zeros)
{
  int count = 0;
  for (int j = 0; j < ldl->n; j++) {
    ed_ldl_block *b = &ldl->block[count];
    if (count > 0 && p->parent[j - 1] == j && p->count[j - 1] == p->count[j] + 1) {
      b[-1].width++;
      continue;
    }
    *b = (ed_ldl_block){.first = j, .width = 1, .rows = p->count[j]};
    zeros[count++] = 0.0;
  }
  int kept = 0;
  for (int i = 0; i < count; i++) {
    ed_ldl_block b = ldl->block[i];
    double filled = zeros[i];
    while (kept > 0 && p->parent[b.first - 1] == b.first) {
      const ed_ldl_block *before = &ldl->block[kept - 1];
      const int rows = before->width + b.rows, width = before->width + b.width;
      const double more = zeros[kept - 1] + filled + (double)before->width * (double)(rows - before->rows);
      if (!worth_merging(width, more, lower_places(width, rows)))
        break;
      b.first = before->first;
      b.width = width;
      b.rows = rows;
      filled = more;
      kept--;
    }
    ldl->block[kept] = b;
    zeros[kept++] = filled;
  }
  ldl->n_blocks = kept;
}

static int compare_ints(const void *a, const void *b)
{
  return *(const int *)a - *(const int *)b;
}

/* Rows of the fronts, what goes where, and how much room that takes. */
static void fill_fronts(ed_ldl *ldl, pattern *p)
{
  int *position = p->work, *mark = p->next, *block_of = p->count;
  size_t waiting = 0;
  int entries = 0;
  for (int i = 0; i < ldl->n; i++)
    mark[i] = -1;
  for (int b = 0; b < ldl->n_blocks; b++)
    for (int j = 0; j < ldl->block[b].width; j++)
      block_of[ldl->block[b].first + j] = b;
  for (int b = 0, index = 0; b < ldl->n_blocks; b++) {
    ed_ldl_block *own = &ldl->block[b];
    int *rows = ldl->row_of + index, count = own->width;
    own->index = (size_t)index;
    own->panel = ldl->panel_size;
    for (int j = 0; j < own->width; j++)
      mark[rows[j] = own->first + j] = b;
    for (int k = p->column_start[own->first]; k < p->column_start[own->first + own->width]; k++)
      if (mark[p->row[k]] != b)
        mark[rows[count++] = p->row[k]] = b;
    for (int c = b - 1, left = own->children; left > 0; c--) {
      if (ldl->block[c].parent != b)
        continue;
      left--;
      for (int i = ldl->block[c].width; i < ldl->block[c].rows; i++) {
        const int row = ldl->row_of[ldl->block[c].index + (size_t)i];
        if (mark[row] != b)
          mark[rows[count++] = row] = b;
      }
    }
    own->rows = count;
    qsort(rows + own->width, (size_t)(count - own->width), sizeof *rows, compare_ints);
    for (int i = 0; i < count; i++)
      position[rows[i]] = i;
    size_t freed = 0;
    for (int c = b - 1, left = own->children; left > 0; c--) {
      const ed_ldl_block *child = &ldl->block[c];
      if (child->parent != b)
        continue;
      left--;
      const size_t below = (size_t)(child->rows - child->width);
      freed += below * below;
      for (int i = child->width; i < child->rows; i++)
        ldl->place[child->index + (size_t)i] = position[ldl->row_of[child->index + (size_t)i]];
    }
    own->entries = entries;
    for (int j = 0; j < own->width; j++)
      for (int k = p->column_start[own->first + j]; k < p->column_start[own->first + j + 1]; k++, entries++) {
        ldl->from[entries] = p->entry[k];
        ldl->to[entries] = own->panel + (size_t)j * (size_t)count + (size_t)position[p->row[k]];
      }
    own->n_entries = entries - own->entries;
    const size_t below = (size_t)(count - own->width);
    own->parent = below ? block_of[rows[own->width]] : -1;
    if (below)
      ldl->block[own->parent].children++;
    if (waiting + below * below > ldl->stack_size)
      ldl->stack_size = waiting + below * below;
    waiting = waiting + below * below - freed;
    ldl->panel_size += (size_t)count * (size_t)own->width;
    ldl->most_rows = count > ldl->most_rows ? count : ldl->most_rows;
    index += count;
  }
}

int ed_ldl_analyse(ed_ldl *ldl, int last, const int *column_start, const int *row)
{
  const int n = ldl->n, entries = column_start[n];
  pattern p = {0};
  double *zeros = malloc(((size_t)n + 1) * sizeof *zeros);
  int made = make_pattern(&p, n, entries) && zeros && order_columns(ldl, last, column_start, row);
  if (made) {
    arrange(ldl, &p, column_start, row);
    find_tree(ldl, &p);
    made = order_by_tree(ldl, &p);
  }
  if (made) {
    arrange(ldl, &p, column_start, row);
    find_tree(ldl, &p);
    count_rows(ldl, &p);
    find_blocks(ldl, &p, zeros);
    size_t rows = 0;
    for (int b = 0; b < ldl->n_blocks; b++)
      rows += (size_t)ldl->block[b].rows;
    made = rows < INT_MAX;
    ldl->row_of = made ? malloc((rows + 1) * sizeof *ldl->row_of) : NULL;
    ldl->place = made ? malloc((rows + 1) * sizeof *ldl->place) : NULL;
    ldl->from = malloc(((size_t)entries + 1) * sizeof *ldl->from);
    ldl->to = malloc(((size_t)entries + 1) * sizeof *ldl->to);
    made = ldl->row_of && ldl->place && ldl->from && ldl->to;
  }
  if (made)
    fill_fronts(ldl, &p);
  free_pattern(&p);
  free(zeros);
  return made;
}
