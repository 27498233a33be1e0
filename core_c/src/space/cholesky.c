#include "space/cholesky.h"

#include "edcore.h"
#include "space/block.h"
#include "space/elimination.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 16 }; /* right sides that are solved together */

/* pivot / its diagonal term is a measure that no choice of units changes; below this only rounding is left of the pivot. */
static const double SINGULAR = 1e-14;

/* A supernode of w columns with h rows below them is stored as two blocks, its diagonal and what is below. What its elimination takes from
 * the rest of the matrix, its update, h x h, waits for the parent. Supernodes of even and of odd depth have a stack each for updates: when
 * one is eliminated its children's are the top of the other stack. */
struct ed_cholesky {
  ed_elimination *elimination;
  int n, terms;
  int *source;             /* terms of the lower triangle in the matrix ... */
  double **target;         /* ... and in `value` */
  const int *diagonal;
  int *child, *sibling;    /* first of each supernode, next of its parent; -1: none */
  size_t *start;           /* supernodes + 1, in `value` */
  size_t *update;          /* supernodes, in `updates` */
  size_t room;             /* of updates */
  int highest;             /* rows below */
  double *value, *updates;
  double *own;             /* n: diagonal terms, in order of elimination */
  double *x, *side;        /* right sides side by side, and those of the rows below a supernode */
  double pivot_ratio;
  int factored;
};

typedef struct {
  int width, height, rows; /* rows: of `below`, whole vectors */
  size_t ld;               /* of `diagonal` */
  double *diagonal, *below;
} panel;

static panel panel_of(const ed_cholesky *c, int k)
{
  const int width = ed_width(c->elimination, k), height = ed_height(c->elimination, k), ld = ed_block_rows(width);
  double *diagonal = c->value + c->start[k];
  return (panel){width, height, ed_block_rows(height), (size_t)ld, diagonal, diagonal + (size_t)ld * (size_t)width};
}

static void place_panels(ed_cholesky *c)
{
  const ed_elimination *e = c->elimination;
  size_t total = 0;
  for (int k = 0; k < e->supernodes; k++) {
    const int rows = ed_block_rows(ed_height(e, k));
    c->start[k] = total;
    total += (size_t)(ed_block_rows(ed_width(e, k)) + rows) * (size_t)ed_width(e, k);
    c->highest = rows > c->highest ? rows : c->highest;
  }
  c->start[e->supernodes] = total;
}

static void place_updates(ed_cholesky *c, int *depth)
{
  const ed_elimination *e = c->elimination;
  size_t top[2] = {0, 0}, most[2] = {0, 0};
  for (int k = e->supernodes - 1; k >= 0; k--) {
    const int parent = e->parent[k];
    depth[k] = parent < 0 ? 0 : !depth[parent];
    c->child[k] = -1;
    c->sibling[k] = parent < 0 ? -1 : c->child[parent];
    if (parent >= 0)
      c->child[parent] = k;
  }
  for (int k = 0; k < e->supernodes; k++) {
    const size_t rows = (size_t)ed_block_rows(ed_height(e, k));
    const int own = depth[k];
    if (c->child[k] >= 0)
      top[!own] = c->update[c->child[k]];
    c->update[k] = top[own];
    top[own] += rows * rows;
    most[own] = top[own] > most[own] ? top[own] : most[own];
  }
  for (int k = 0; k < e->supernodes; k++)
    c->update[k] += depth[k] ? most[0] : 0;
  c->room = most[0] + most[1];
}

/* Place of a row below a supernode, which has it. */
static size_t find_row(const ed_elimination *e, int k, int row)
{
  const int *rows = e->row + e->row_start[k], *at = rows;
  for (int left = ed_height(e, k); left > 1;) {
    const int half = left / 2;
    at += at[half] <= row ? half : 0;
    left -= half;
  }
  return (size_t)(at - rows);
}

/* Where the lower triangle of the matrix goes in the panels. */
static void place_terms(ed_cholesky *c, const int *column_start, const int *row)
{
  const ed_elimination *e = c->elimination;
  for (int k = 0; k < e->supernodes; k++) {
    const panel p = panel_of(c, k);
    for (int j = 0; j < p.width; j++) {
      double *diagonal = p.diagonal + (size_t)j * p.ld, *below = p.below + (size_t)j * (size_t)p.rows;
      const int equation = e->order[e->first[k] + j];
      for (int term = column_start[equation]; term < column_start[equation + 1]; term++) {
        const int i = e->number[row[term]];
        if (i < e->first[k] + j)
          continue;
        c->source[c->terms] = term;
        c->target[c->terms++] = i < e->first[k + 1] ? diagonal + (i - e->first[k]) : below + find_row(e, k, i);
      }
    }
  }
}

ed_cholesky *ed_cholesky_new(int n, int n_last, const int *column_start, const int *row, const int *diagonal)
{
  ed_cholesky *c = calloc(1, sizeof *c);
  if (!c)
    return NULL;
  const size_t size = (size_t)n + 1, nonzeros = (size_t)column_start[n] + 1;
  int *room = malloc(size * sizeof *room);
  c->n = n;
  c->diagonal = diagonal;
  c->elimination = ed_elimination_new(n, n_last, column_start, row);
  c->source = malloc(nonzeros * sizeof *c->source);
  c->target = malloc(nonzeros * sizeof *c->target);
  c->child = malloc(size * sizeof *c->child);
  c->sibling = malloc(size * sizeof *c->sibling);
  c->start = malloc(size * sizeof *c->start);
  c->update = malloc(size * sizeof *c->update);
  c->own = malloc(size * sizeof *c->own);
  c->x = malloc(size * LANES * sizeof *c->x);
  int done = room && c->elimination && c->source && c->target && c->child && c->sibling && c->start && c->update && c->own && c->x;
  if (done) {
    place_panels(c);
    place_updates(c, room);
    c->value = malloc((c->start[c->elimination->supernodes] + 1) * sizeof *c->value);
    c->updates = malloc((c->room + 1) * sizeof *c->updates);
    c->side = malloc(((size_t)c->highest + 1) * LANES * sizeof *c->side);
    done = c->value && c->updates && c->side;
  }
  free(room);
  if (!done) {
    ed_cholesky_free(c);
    return NULL;
  }
  place_terms(c, column_start, row);
  return c;
}

void ed_cholesky_free(ed_cholesky *c)
{
  if (!c)
    return;
  void *all[] = {c->source, c->target, c->child, c->sibling, c->start, c->update, c->value, c->updates, c->own, c->x, c->side};
  ed_elimination_free(c->elimination);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    free(all[i]);
  free(c);
}

/* Adds a child's update to the panel and to the update (rows x rows) of its parent. */
static void add_update(const ed_cholesky *c, int child, const panel *p, double *update)
{
  const ed_elimination *e = c->elimination;
  const int height = ed_height(e, child), shared = e->shared[child], *to = e->in_parent + e->row_start[child];
  const double *from = c->updates + c->update[child];
  const size_t ld = (size_t)ed_block_rows(height), rows = (size_t)p->rows;
  for (int j = 0; j < shared; j++, from += ld) {
    double *diagonal = p->diagonal + (size_t)to[j] * p->ld, *below = p->below + (size_t)to[j] * rows;
    for (int i = j; i < shared; i++)
      diagonal[to[i]] += from[i];
    for (int i = shared; i < height; i++)
      below[to[i]] += from[i];
  }
  for (int j = shared; j < height; j++, from += ld) {
    double *column = update + (size_t)to[j] * rows;
    for (int i = j; i < height; i++)
      column[to[i]] += from[i];
  }
}

int ed_cholesky_factor(ed_cholesky *c, const double *matrix)
{
  const ed_elimination *e = c->elimination;
  c->factored = 0;
  c->pivot_ratio = HUGE_VAL;
  memset(c->value, 0, c->start[e->supernodes] * sizeof *c->value);
  for (int i = 0; i < c->terms; i++)
    *c->target[i] = matrix[c->source[i]];
  for (int i = 0; i < c->n; i++)
    c->own[i] = matrix[c->diagonal[e->order[i]]];
  for (int k = 0; k < e->supernodes; k++) {
    const panel p = panel_of(c, k);
    double *update = c->updates + c->update[k];
    memset(update, 0, (size_t)p.rows * (size_t)p.rows * sizeof *update);
    for (int child = c->child[k]; child >= 0; child = c->sibling[child])
      add_update(c, child, &p, update);
    const double ratio = ed_block_factor(p.width, p.diagonal, p.ld, c->own + e->first[k], SINGULAR);
    c->pivot_ratio = ratio < c->pivot_ratio ? ratio : c->pivot_ratio;
    if (!(ratio > SINGULAR))
      return ED_E_SINGULAR;
    ed_block_divide(p.rows, p.below, (size_t)p.rows, p.width, p.diagonal, p.ld);
    ed_block_subtract_square(p.rows, p.width, p.below, (size_t)p.rows, update);
  }
  c->factored = 1;
  return ED_OK;
}

double ed_cholesky_pivot_ratio(const ed_cholesky *c)
{
  return c->pivot_ratio;
}

/* Short copies of whole vectors, for which a call of memcpy takes longer than the copy. */
static inline void copy(size_t lanes, const double *from, double *to)
{
  for (size_t l = 0; l < lanes; l += ED_BLOCK_ROWS)
    for (size_t i = 0; i < ED_BLOCK_ROWS; i++)
      to[l + i] = from[l + i];
}

/* Right sides of the rows below a supernode, side by side, and 0 where its block is padded. */
static void gather(const ed_cholesky *c, int k, int rows, size_t lanes)
{
  const int height = ed_height(c->elimination, k), *row = c->elimination->row + c->elimination->row_start[k];
  for (int i = 0; i < height; i++)
    copy(lanes, c->x + (size_t)row[i] * lanes, c->side + (size_t)i * lanes);
  memset(c->side + (size_t)height * lanes, 0, (size_t)(rows - height) * lanes * sizeof *c->side);
}

static void scatter(const ed_cholesky *c, int k, size_t lanes)
{
  const int height = ed_height(c->elimination, k), *row = c->elimination->row + c->elimination->row_start[k];
  for (int i = 0; i < height; i++)
    copy(lanes, c->side + (size_t)i * lanes, c->x + (size_t)row[i] * lanes);
}

static int all_zero(size_t count, const double *x)
{
  for (size_t i = 0; i < count; i++)
    if (x[i] != 0.0)
      return 0;
  return 1;
}

/* Solves for what is in `x` from one supernode on: those before it have no load, and their displacements are not asked for. */
static void substitute(const ed_cholesky *c, int from, int lanes)
{
  const ed_elimination *e = c->elimination;
  const size_t ld = (size_t)lanes;
  for (int k = from; k < e->supernodes; k++) {
    const panel p = panel_of(c, k);
    double *x = c->x + (size_t)e->first[k] * ld;
    if (all_zero((size_t)p.width * ld, x)) /* nothing is loaded that far */
      continue;
    ed_block_divide(lanes, x, ld, p.width, p.diagonal, p.ld);
    gather(c, k, p.rows, ld);
    ed_block_subtract(lanes, p.rows, p.width, x, ld, p.below, (size_t)p.rows, 1, c->side, ld);
    scatter(c, k, ld);
  }
  for (int k = e->supernodes - 1; k >= from; k--) {
    const panel p = panel_of(c, k);
    double *x = c->x + (size_t)e->first[k] * ld;
    gather(c, k, p.rows, ld);
    ed_block_subtract(lanes, p.width, p.height, c->side, ld, p.below, 1, (size_t)p.rows, x, ld);
    ed_block_divide_back(lanes, x, ld, p.width, p.diagonal, p.ld);
  }
}

int ed_cholesky_solve(ed_cholesky *c, double *rhs, int n_rhs)
{
  const size_t n = (size_t)c->n;
  const int *order = c->elimination->order;
  if (!c->factored)
    return ED_E_STATE;
  for (int done = 0; done < n_rhs; done += LANES) {
    const int count = n_rhs - done < LANES ? n_rhs - done : LANES, lanes = ed_block_rows(count);
    double *own = rhs + (size_t)done * n;
    for (size_t k = 0; k < n; k++)
      for (int l = 0; l < lanes; l++)
        c->x[k * (size_t)lanes + (size_t)l] = l < count ? own[(size_t)l * n + (size_t)order[k]] : 0.0;
    substitute(c, 0, lanes);
    for (size_t k = 0; k < n; k++)
      for (int l = 0; l < count; l++)
        own[(size_t)l * n + (size_t)order[k]] = c->x[k * (size_t)lanes + (size_t)l];
  }
  return ED_OK;
}

int ed_cholesky_inverse(ed_cholesky *c, int count, const int *equation, double *inverse)
{
  const ed_elimination *e = c->elimination;
  int least = c->n, from = 0;
  if (!c->factored)
    return ED_E_STATE;
  for (int i = 0; i < count; i++)
    least = e->number[equation[i]] < least ? e->number[equation[i]] : least;
  while (from < e->supernodes && e->first[from + 1] <= least)
    from++;
  for (int done = 0; done < count; done += LANES) {
    const int own = count - done < LANES ? count - done : LANES, lanes = ed_block_rows(own);
    memset(c->x + (size_t)e->first[from] * (size_t)lanes, 0, (size_t)(c->n - e->first[from]) * (size_t)lanes * sizeof *c->x);
    for (int l = 0; l < own; l++)
      c->x[(size_t)e->number[equation[done + l]] * (size_t)lanes + (size_t)l] = 1.0;
    substitute(c, from, lanes);
    for (int l = 0; l < own; l++)
      for (int i = 0; i < count; i++)
        inverse[(size_t)(done + l) * (size_t)count + (size_t)i] = c->x[(size_t)e->number[equation[i]] * (size_t)lanes + (size_t)l];
  }
  return ED_OK;
}
