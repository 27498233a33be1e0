#include "base/lanes.h"
#include "system/analysis.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

static int compare_ints(const void *a, const void *b)
{
  return *(const int *)a - *(const int *)b;
}

/* The degrees that a member, or after the members a damper, couples. */
static int coupled(const ed_analysis *a, int index, const int **degree)
{
  const int members = a->model->n_members;
  if (index < members) {
    *degree = a->members.element[index].dof;
    return a->members.element[index].degrees;
  }
  *degree = a->model->devices[index - members].degree;
  return a->model->devices[index - members].n_terms;
}

/* Where the matrix of a member or damper goes. */
static void find_places(const ed_analysis *a, int index, int *place)
{
  const int *degree, n = coupled(a, index, &degree);
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const int column = a->numbering.equation[degree[j]], row = a->numbering.equation[degree[i]];
      *place = a->matrix.nnz;
      if (column >= 0 && row >= 0) {
        const int *first = a->matrix.row + a->matrix.column_start[column];
        const size_t length = (size_t)(a->matrix.column_start[column + 1] - a->matrix.column_start[column]);
        const int *found = bsearch(&row, first, length, sizeof *first, compare_ints);
        *place = (int)(found - a->matrix.row);
      }
      place++;
    }
}

/* Pattern of the matrix from the elements' and dampers' equations (every diagonal is in it), and where each element term goes. */
int ed_build_pattern(ed_analysis *a)
{
  const int n = a->numbering.n, members = a->model->n_members, all = members + a->model->n_devices;
  int *count = calloc((size_t)n + 1, sizeof *count);
  a->matrix.column_start = calloc((size_t)n + 1, sizeof *a->matrix.column_start);
  a->matrix.diagonal = calloc((size_t)n, sizeof *a->matrix.diagonal);
  a->matrix.scatter = malloc(ed_tangent_size(a->model) * (size_t)(members + 1) * sizeof *a->matrix.scatter);
  size_t device_terms = 0;
  for (int i = 0; i < a->model->n_devices; i++)
    device_terms += (size_t)a->model->devices[i].n_terms * (size_t)a->model->devices[i].n_terms;
  a->matrix.device_scatter = malloc((device_terms + 1) * sizeof *a->matrix.device_scatter);
  if (!count || !a->matrix.column_start || !a->matrix.diagonal || !a->matrix.scatter || !a->matrix.device_scatter) {
    free(count);
    return ED_E_MEMORY;
  }
  for (int i = 0; i < n; i++)
    count[i] = 1;
  for (int m = 0; m < all; m++) {
    const int *degree, terms = coupled(a, m, &degree);
    for (int j = 0; j < terms; j++)
      if (a->numbering.equation[degree[j]] >= 0)
        count[a->numbering.equation[degree[j]]] += terms;
  }
  int *start = malloc(((size_t)n + 1) * sizeof *start), *fill = malloc((size_t)n * sizeof *fill);
  long total = 0;
  for (int i = 0; start && i < n && total <= INT_MAX; i++) {
    start[i] = (int)total;
    total += count[i];
  }
  int *rows = total <= INT_MAX ? malloc((size_t)total * sizeof *rows) : NULL; /* else too many for their numbers */
  free(count);
  if (!start || !fill || !rows) {
    free(start);
    free(fill);
    free(rows);
    return ED_E_MEMORY;
  }
  start[n] = (int)total;
  for (int i = 0; i < n; i++) {
    rows[start[i]] = i;
    fill[i] = start[i] + 1;
  }
  for (int m = 0; m < all; m++) {
    const int *degree, terms = coupled(a, m, &degree);
    for (int j = 0; j < terms; j++) {
      const int column = a->numbering.equation[degree[j]];
      for (int i = 0; column >= 0 && i < terms; i++)
        if (a->numbering.equation[degree[i]] >= 0)
          rows[fill[column]++] = a->numbering.equation[degree[i]];
    }
  }
  int nnz = 0;
  for (int i = 0; i < n; i++) {
    qsort(rows + start[i], (size_t)(fill[i] - start[i]), sizeof *rows, compare_ints);
    a->matrix.column_start[i] = nnz;
    for (int k = start[i]; k < fill[i]; k++)
      if (k == start[i] || rows[k] != rows[k - 1])
        rows[nnz++] = rows[k]; /* nnz never runs ahead of k */
  }
  a->matrix.column_start[n] = nnz;
  a->matrix.n = n;
  a->matrix.nnz = nnz;
  a->matrix.row = rows;
  free(start);
  free(fill);
  for (int i = 0; i < n; i++)
    for (int k = a->matrix.column_start[i]; k < a->matrix.column_start[i + 1]; k++)
      if (a->matrix.row[k] == i)
        a->matrix.diagonal[i] = k;
  for (int m = 0; m < members; m++)
    find_places(a, m, a->matrix.scatter + ed_tangent_size(a->model) * (size_t)m);
  int *place = a->matrix.device_scatter;
  for (int i = 0; i < a->model->n_devices; i++) {
    find_places(a, members + i, place);
    place += a->model->devices[i].n_terms * a->model->devices[i].n_terms;
  }
  const size_t bytes = ((size_t)nnz + 1) * sizeof(double);
  const int uneven = a->members.n_struts || a->model->uneven_damping;
  a->matrix.tangent = malloc(bytes);
  a->matrix.initial = malloc(bytes);
  a->matrix.initial_damping = malloc(bytes);
  a->matrix.damped = uneven ? malloc(bytes) : NULL;
  return a->matrix.tangent && a->matrix.initial && a->matrix.initial_damping && (a->matrix.damped || !uneven) ? ED_OK : ED_E_MEMORY;
}

void ed_matrices_free(ed_matrices *matrix)
{
  void *blocks[] = {matrix->column_start, matrix->row,     matrix->diagonal,        matrix->scatter, matrix->device_scatter,
                    matrix->tangent,      matrix->initial, matrix->initial_damping, matrix->damped};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
    free(blocks[i]);
}

/* Of nodes of diaphragms: rows and columns of their turn take those of the displacements in plan, by their levers. */
static void put_on_masters(const ed_analysis *a, const ed_element *e, double *t)
{
  const int n = e->degrees;
  for (int i = 0; i < n; i++) {
    const ed_in_plan *of = &a->numbering.plan[e->dof[i]];
    const int turn = i - i % 6 + 5; /* of the node */
    if (of->turn < 0)
      continue;
    for (int k = 0; k < n; k++)
      t[n * turn + k] += of->lever * t[n * i + k];
  }
  for (int i = 0; i < n; i++) {
    const ed_in_plan *of = &a->numbering.plan[e->dof[i]];
    const int turn = i - i % 6 + 5;
    if (of->turn < 0)
      continue;
    for (int k = 0; k < n; k++)
      t[n * k + turn] += of->lever * t[n * k + i];
  }
}

ED_INLINE void member_tangent(const ed_analysis *a, int m, const double *block, double *t, const int degrees)
{
  const ed_element *e = &a->members.element[m];
  double d[ED_MAX_DEGREES];
  ed_gather_some(&a->members, m, d, degrees);
  ed_element_tangent(e, d, block, t);
  if (degrees == ED_MAX_DEGREES && a->numbering.plan)
    put_on_masters(a, e, t);
}

void ed_member_tangent(const ed_analysis *a, int m, const double *block, double *t)
{
  if (a->model->dimension == 2)
    member_tangent(a, m, block, t, 6);
  else
    member_tangent(a, m, block, t, ED_MAX_DEGREES);
}

/* Adds the tangents of all members, of so many degrees each. */
ED_INLINE void add_tangents(ed_analysis *a, const int degrees)
{
  const int *place = a->matrix.scatter;
  double *tangent = a->matrix.tangent;
  for (int m = 0; m < a->model->n_members; m++, place += degrees * degrees) {
    double t[ED_MAX_DEGREES * ED_MAX_DEGREES];
    member_tangent(a, m, a->trial.elements + a->members.element[m].state, t, degrees);
    for (int i = 0; i < degrees * degrees; i++)
      tangent[place[i]] += t[i];
  }
}

void ed_assemble_tangent(ed_analysis *a)
{
  if (a->matrix.assembled_stamp == a->matrix.stamp)
    return;
  memset(a->matrix.tangent, 0, ((size_t)a->matrix.nnz + 1) * sizeof *a->matrix.tangent);
  if (a->model->dimension == 2)
    add_tangents(a, 6);
  else
    add_tangents(a, ED_MAX_DEGREES);
  a->matrix.tangent[a->matrix.nnz] = 0.0;
  a->matrix.assembled_stamp = a->matrix.stamp;
}

const double *ed_damping_tangent(ed_analysis *a)
{
  ed_assemble_tangent(a);
  if (!a->matrix.damped)
    return a->matrix.tangent;
  if (a->matrix.damped_stamp == a->matrix.stamp)
    return a->matrix.damped;
  const size_t terms = ed_tangent_size(a->model);
  memcpy(a->matrix.damped, a->matrix.tangent, ((size_t)a->matrix.nnz + 1) * sizeof *a->matrix.damped);
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    const double *block = a->trial.elements + e->state;
    const int softens = e->kind == ED_STRUT && block[ED_BLOCK_K] < 0.0;
    const double factor = e->member->damping_factor;
    if (!softens && factor == 1.0)
      continue;
    double is[ED_MAX_DEGREES * ED_MAX_DEGREES], damped[ED_MAX_DEGREES * ED_MAX_DEGREES], head[ED_BLOCK_POINTS];
    ed_member_tangent(a, m, block, is);
    memcpy(damped, is, sizeof damped);
    if (softens) { /* just before a snap the tangent falls without bound, and damping by it would drive the brace */
      memcpy(head, block, sizeof head);
      head[ED_BLOCK_K] = 0.0;
      ed_member_tangent(a, m, head, damped);
    }
    for (size_t i = 0; i < terms; i++)
      a->matrix.damped[a->matrix.scatter[terms * (size_t)m + i]] += factor * damped[i] - is[i];
  }
  a->matrix.damped[a->matrix.nnz] = 0.0;
  a->matrix.damped_stamp = a->matrix.stamp;
  return a->matrix.damped;
}

void ed_multiply(const ed_matrices *matrix, const double *value, const double *x, double *y)
{
  for (int j = 0; j < matrix->n; j++) { /* symmetric: a column is a row */
    double sum = 0.0;
    for (int k = matrix->column_start[j]; k < matrix->column_start[j + 1]; k++)
      sum += value[k] * x[matrix->row[k]];
    y[j] = sum;
  }
}
