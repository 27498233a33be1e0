#include "space/elimination.h"

#include <amd.h>
#include <stdlib.h>
#include <string.h>

/* Zeros that a supernode may store to be wider: dense arithmetic on them costs less than the bookkeeping of many narrow ones. */
static const double NARROW_ZEROS = 0.4, WIDE_ZEROS = 0.1;
enum { NARROW = 16 };

/* What the analysis needs beside its result; n each. */
typedef struct {
  int *parent;   /* of each column: first row below it in the factor, -1: none */
  int *count;    /* rows of each column of the factor, with the diagonal */
  int *mark, *next, *stack;
  int *owner;    /* supernode of each column */
} scratch;

/* Minimum degree among all but the last equations. */
static int order_equations(ed_elimination *e, int n_last, const int *column_start, const int *row)
{
  const int n = e->n - n_last;
  int *start = malloc(((size_t)n + 1) * sizeof *start), *kept = malloc(((size_t)column_start[n] + 1) * sizeof *kept);
  int ordered = AMD_OUT_OF_MEMORY, count = 0;
  if (start && kept) {
    for (int j = 0; j < n; j++) {
      start[j] = count;
      for (int k = column_start[j]; k < column_start[j + 1]; k++)
        if (row[k] < n)
          kept[count++] = row[k];
    }
    start[n] = count;
    ordered = amd_order(n, start, kept, e->order, NULL, NULL);
  }
  free(start);
  free(kept);
  for (int j = n; j < e->n; j++)
    e->order[j] = j;
  return ordered == AMD_OK || ordered == AMD_OK_BUT_JUMBLED;
}

static void number_equations(ed_elimination *e)
{
  for (int k = 0; k < e->n; k++)
    e->number[e->order[k]] = k;
}

/* The elimination tree (Liu 1990); mark: last ancestor that is known. */
static void find_tree(const ed_elimination *e, scratch *s, const int *column_start, const int *row)
{
  for (int j = 0; j < e->n; j++) {
    const int equation = e->order[j];
    s->parent[j] = s->mark[j] = -1;
    for (int k = column_start[equation]; k < column_start[equation + 1]; k++)
      for (int i = e->number[row[k]], above; i >= 0 && i < j; i = above) {
        above = s->mark[i];
        s->mark[i] = j;
        if (above < 0)
          s->parent[i] = j;
      }
  }
}

/* Lets each column follow those that it depends on, so that columns of a supernode are neighbours. */
static void follow_tree(ed_elimination *e, scratch *s)
{
  int *child = s->mark, *old = s->count, top = 0, placed = 0;
  memcpy(old, e->order, (size_t)e->n * sizeof *old);
  for (int j = 0; j < e->n; j++)
    child[j] = -1;
  for (int j = e->n - 1; j >= 0; j--)
    if (s->parent[j] >= 0) {
      s->next[j] = child[s->parent[j]];
      child[s->parent[j]] = j;
    }
  for (int root = 0; root < e->n; root++) {
    if (s->parent[root] >= 0)
      continue;
    s->stack[top++] = root;
    while (top > 0) {
      const int j = s->stack[top - 1], below = child[j];
      if (below >= 0) {
        child[j] = s->next[below];
        s->stack[top++] = below;
      } else {
        e->order[placed++] = old[j];
        top--;
      }
    }
  }
}

/* Row i of the factor has the columns on the paths from those of row i of the matrix up to i (Gilbert, Ng & Peyton 1994). */
static void count_rows(const ed_elimination *e, scratch *s, const int *column_start, const int *row)
{
  for (int i = 0; i < e->n; i++) {
    const int equation = e->order[i];
    s->count[i] = 1;
    s->mark[i] = i;
    for (int k = column_start[equation]; k < column_start[equation + 1]; k++)
      for (int j = e->number[row[k]]; j < i && s->mark[j] != i; j = s->parent[j]) {
        s->mark[j] = i;
        s->count[j]++;
      }
  }
}

/* A column joins the supernode before it where that stores few zeros for it. */
static void find_supernodes(ed_elimination *e, scratch *s)
{
  double zeros = 0.0;
  int width = 0, rows = 0; /* rows: with those of its own columns */
  for (int j = 0; j < e->n; j++) {
    const int joined = width + s->count[j];
    const double more = zeros + (double)width * (joined - rows), whole = (width + 1.0) * (joined - 0.5 * width);
    if (width > 0 && s->parent[j - 1] == j && more <= (width < NARROW ? NARROW_ZEROS : WIDE_ZEROS) * whole) {
      zeros = more;
      rows = joined;
      width++;
    } else {
      e->first[e->supernodes++] = j;
      zeros = 0.0;
      rows = s->count[j];
      width = 1;
    }
    s->owner[j] = e->supernodes - 1;
  }
  e->first[e->supernodes] = e->n;
  for (int k = 0; k < e->supernodes; k++) {
    const int above = s->parent[e->first[k + 1] - 1];
    e->parent[k] = above < 0 ? -1 : s->owner[above];
  }
}

/* Rows of supernodes as `count_rows` finds those of columns: counts them (`rows` NULL), or writes them in rising order. */
static void find_rows(const ed_elimination *e, scratch *s, const int *column_start, const int *row, size_t *next, int *rows)
{
  for (int k = 0; k < e->supernodes; k++)
    s->mark[k] = -1;
  for (int i = 0; i < e->n; i++) {
    const int equation = e->order[i], own = s->owner[i];
    for (int k = column_start[equation]; k < column_start[equation + 1]; k++) {
      if (e->number[row[k]] >= i)
        continue;
      for (int j = s->owner[e->number[row[k]]]; j != own && s->mark[j] != i; j = e->parent[j]) {
        s->mark[j] = i;
        if (rows)
          rows[next[j]] = i;
        next[j]++;
      }
    }
  }
}

static void place_in_parents(ed_elimination *e)
{
  for (int k = 0; k < e->supernodes; k++) {
    const int parent = e->parent[k];
    size_t at = parent < 0 ? 0 : e->row_start[parent];
    for (size_t i = e->row_start[k]; i < e->row_start[k + 1]; i++) {
      const int own = e->row[i] < e->first[parent + 1];
      e->shared[k] += own;
      while (!own && e->row[at] != e->row[i]) /* all rows of a supernode are the parent's */
        at++;
      e->in_parent[i] = own ? e->row[i] - e->first[parent] : (int)(at - e->row_start[parent]);
    }
  }
}

static int list_rows(ed_elimination *e, scratch *s, const int *column_start, const int *row)
{
  size_t *next = calloc((size_t)e->supernodes + 1, sizeof *next), total = 0;
  if (!next)
    return 0;
  find_rows(e, s, column_start, row, next, NULL);
  for (int k = 0; k <= e->supernodes; k++) {
    e->row_start[k] = total;
    total += next[k];
    next[k] = e->row_start[k];
  }
  e->row = malloc((total + 1) * sizeof *e->row);
  e->in_parent = malloc((total + 1) * sizeof *e->in_parent);
  if (e->row && e->in_parent) {
    find_rows(e, s, column_start, row, next, e->row);
    place_in_parents(e);
  }
  free(next);
  return e->row && e->in_parent;
}

static int analyse(ed_elimination *e, scratch *s, int n_last, const int *column_start, const int *row)
{
  if (!order_equations(e, n_last, column_start, row))
    return 0;
  number_equations(e);
  find_tree(e, s, column_start, row);
  follow_tree(e, s);
  number_equations(e);
  find_tree(e, s, column_start, row);
  count_rows(e, s, column_start, row);
  find_supernodes(e, s);
  return list_rows(e, s, column_start, row);
}

ed_elimination *ed_elimination_new(int n, int n_last, const int *column_start, const int *row)
{
  const size_t size = (size_t)n;
  ed_elimination *e = calloc(1, sizeof *e);
  int *room = malloc((6 * size + 1) * sizeof *room);
  if (e) {
    e->n = n;
    e->order = malloc((size + 1) * sizeof *e->order);
    e->number = malloc((size + 1) * sizeof *e->number);
    e->first = malloc((size + 1) * sizeof *e->first);
    e->parent = malloc((size + 1) * sizeof *e->parent);
    e->row_start = malloc((size + 1) * sizeof *e->row_start);
    e->shared = calloc(size + 1, sizeof *e->shared);
  }
  int done = e && room && e->order && e->number && e->first && e->parent && e->row_start && e->shared;
  if (done) {
    scratch s = {.parent = room,          .count = room + size,      .mark = room + 2 * size,
                 .next = room + 3 * size, .stack = room + 4 * size, .owner = room + 5 * size};
    done = analyse(e, &s, n_last, column_start, row);
  }
  free(room);
  if (done)
    return e;
  ed_elimination_free(e);
  return NULL;
}

void ed_elimination_free(ed_elimination *e)
{
  if (!e)
    return;
  void *all[] = {e->order, e->number, e->first, e->parent, e->row_start, e->row, e->in_parent, e->shared};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    free(all[i]);
  free(e);
}
