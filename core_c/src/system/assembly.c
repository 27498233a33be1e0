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
    *degree = a->elements[index].dof;
    return 6;
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
      const int column = a->equation[degree[j]], row = a->equation[degree[i]];
      *place = a->nnz;
      if (column >= 0 && row >= 0) {
        const int *first = a->row + a->column_start[column];
        const size_t length = (size_t)(a->column_start[column + 1] - a->column_start[column]);
        const int *found = bsearch(&row, first, length, sizeof *first, compare_ints);
        *place = (int)(found - a->row);
      }
      place++;
    }
}

/* Pattern of the matrix from the elements' and dampers' equations (every diagonal is in it), and where each element term goes. */
int ed_build_pattern(ed_analysis *a)
{
  const int n = a->n, members = a->model->n_members, all = members + a->model->n_devices;
  int *count = calloc((size_t)n + 1, sizeof *count);
  a->column_start = calloc((size_t)n + 1, sizeof *a->column_start);
  a->diagonal = calloc((size_t)n, sizeof *a->diagonal);
  a->scatter = malloc(36 * (size_t)(members + 1) * sizeof *a->scatter);
  size_t device_terms = 0;
  for (int i = 0; i < a->model->n_devices; i++)
    device_terms += (size_t)a->model->devices[i].n_terms * (size_t)a->model->devices[i].n_terms;
  a->device_scatter = malloc((device_terms + 1) * sizeof *a->device_scatter);
  if (!count || !a->column_start || !a->diagonal || !a->scatter || !a->device_scatter) {
    free(count);
    return ED_E_MEMORY;
  }
  for (int i = 0; i < n; i++)
    count[i] = 1;
  for (int m = 0; m < all; m++) {
    const int *degree, terms = coupled(a, m, &degree);
    for (int j = 0; j < terms; j++)
      if (a->equation[degree[j]] >= 0)
        count[a->equation[degree[j]]] += terms;
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
      const int column = a->equation[degree[j]];
      for (int i = 0; column >= 0 && i < terms; i++)
        if (a->equation[degree[i]] >= 0)
          rows[fill[column]++] = a->equation[degree[i]];
    }
  }
  int nnz = 0;
  for (int i = 0; i < n; i++) {
    qsort(rows + start[i], (size_t)(fill[i] - start[i]), sizeof *rows, compare_ints);
    a->column_start[i] = nnz;
    for (int k = start[i]; k < fill[i]; k++)
      if (k == start[i] || rows[k] != rows[k - 1])
        rows[nnz++] = rows[k]; /* nnz never runs ahead of k */
  }
  a->column_start[n] = nnz;
  a->nnz = nnz;
  a->row = rows;
  free(start);
  free(fill);
  for (int i = 0; i < n; i++)
    for (int k = a->column_start[i]; k < a->column_start[i + 1]; k++)
      if (a->row[k] == i)
        a->diagonal[i] = k;
  for (int m = 0; m < members; m++)
    find_places(a, m, a->scatter + 36 * m);
  int *place = a->device_scatter;
  for (int i = 0; i < a->model->n_devices; i++) {
    find_places(a, members + i, place);
    place += a->model->devices[i].n_terms * a->model->devices[i].n_terms;
  }
  const size_t bytes = ((size_t)nnz + 1) * sizeof(double);
  a->tangent = malloc(bytes);
  a->initial = malloc(bytes);
  a->initial_damping = malloc(bytes);
  a->reference = malloc(bytes);
  a->effective = malloc(bytes);
  a->kept.matrix = malloc(bytes);
  a->backed.matrix = malloc(bytes);
  a->damped = a->n_struts || a->model->uneven_damping ? malloc(bytes) : NULL;
  if (!a->tangent || !a->initial || !a->initial_damping || !a->reference || !a->effective ||
      ((a->n_struts || a->model->uneven_damping) && !a->damped) ||
      !a->kept.matrix || !a->backed.matrix)
    return ED_E_MEMORY;
  a->solver = ed_solver_new(n, a->column_start, a->row, a->diagonal, a->solver_scale);
  return a->solver ? ED_OK : ED_E_MEMORY;
}

void ed_set_factors(ed_analysis *a)
{
  const ed_model *model = a->model;
  memset(a->external, 0, (size_t)a->n * sizeof *a->external);
  for (int i = 0; i < model->n_nodal_loads; i++) {
    const ed_nodal_load *load = &model->nodal_loads[i];
    for (int d = 0; d < 3; d++) {
      const int equation = a->equation[3 * load->node + d];
      if (equation >= 0)
        a->external[equation] += a->factors[load->pattern] * load->force[d];
    }
  }
  for (int m = 0; m < model->n_members; m++)
    if (model->members[m].loaded)
      ed_element_clear_loads(&a->elements[m]);
  for (int i = 0; i < model->n_member_loads; i++) {
    const ed_member_load *load = &model->member_loads[i];
    ed_element *e = &a->elements[load->element];
    (e->rigid ? ed_rigid_add_load : ed_element_add_load)(e, load, a->factors[load->pattern]);
  }
  for (int m = 0; m < model->n_members; m++)
    if (model->members[m].loaded)
      ed_element_finish_loads(&a->elements[m]);
}

/* Forces of one element at its present state, added to those at the degrees. */
static void add_forces(ed_analysis *a, int m, const double *d)
{
  const ed_element *e = &a->elements[m];
  double *force = a->member_force + 6 * m;
  ed_element_forces(e, d, a->trial.elements + e->state, force);
  for (int i = 0; i < 6; i++)
    a->resisting[e->dof[i]] += force[i];
}

static void gather(const ed_analysis *a, int member, double *d)
{
  for (int i = 0; i < 6; i++)
    d[i] = a->displacement[a->elements[member].dof[i]];
}

static void clear_forces(ed_analysis *a)
{
  for (int i = 0; i < 3 * a->model->n_nodes; i++)
    a->displacement[i] = ed_displacement(a, &a->trial, i);
  memset(a->resisting, 0, 3 * (size_t)a->model->n_nodes * sizeof *a->resisting);
}

static void sum_forces(ed_analysis *a)
{
  ed_add_device_forces(a);
  memset(a->trial.resisting, 0, (size_t)a->n * sizeof *a->trial.resisting);
  memset(a->trial.support_force, 0, (size_t)a->n_supports * sizeof *a->trial.support_force);
  for (int i = 0; i < 3 * a->model->n_nodes; i++)
    *(a->equation[i] >= 0 ? a->trial.resisting + a->equation[i] : a->trial.support_force + a->support[i]) += a->resisting[i];
  a->tangent_stamp++;
}

static int update_members(ed_analysis *a)
{
  clear_forces(a);
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->elements[m];
    if (ed_watch_step(&a->watch))
      return ED_E_STOPPED;
    double d[6];
    gather(a, m, d);
    const int status = ed_element_update(e, d, a->layers + e->layers, a->trial.elements + e->state, &a->control);
    if (status != ED_OK) {
      a->failed_member = m;
      return status;
    }
    add_forces(a, m, d);
  }
  return ED_OK;
}

int ed_update_members(ed_analysis *a)
{
  const int status = update_members(a);
  if (status == ED_OK)
    sum_forces(a);
  return status;
}

int ed_update_elements(ed_analysis *a)
{
  int status = update_members(a);
  if (status == ED_OK)
    status = ed_update_devices(a, 0);
  if (status == ED_OK)
    sum_forces(a);
  return status;
}

void ed_collect_forces(ed_analysis *a)
{
  clear_forces(a);
  for (int m = 0; m < a->model->n_members; m++) {
    double d[6];
    gather(a, m, d);
    add_forces(a, m, d);
  }
  sum_forces(a);
}

void ed_assemble_tangent(ed_analysis *a)
{
  if (a->assembled_stamp == a->tangent_stamp)
    return;
  memset(a->tangent, 0, ((size_t)a->nnz + 1) * sizeof *a->tangent);
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->elements[m];
    double d[6], t[36];
    const int *place = a->scatter + 36 * m;
    gather(a, m, d);
    ed_element_tangent(e, d, a->trial.elements + e->state, t);
    for (int i = 0; i < 36; i++)
      a->tangent[place[i]] += t[i];
  }
  a->tangent[a->nnz] = 0.0;
  a->assembled_stamp = a->tangent_stamp;
}

const double *ed_damping_tangent(ed_analysis *a)
{
  ed_assemble_tangent(a);
  if (!a->damped)
    return a->tangent;
  if (a->damped_stamp == a->tangent_stamp)
    return a->damped;
  memcpy(a->damped, a->tangent, ((size_t)a->nnz + 1) * sizeof *a->damped);
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->elements[m];
    const double *block = a->trial.elements + e->state;
    const int softens = e->kind == ED_STRUT && block[ED_BLOCK_K] < 0.0;
    const double factor = e->member->damping_factor;
    if (!softens && factor == 1.0)
      continue;
    double d[6], is[36], damped[36], head[ED_BLOCK_POINTS];
    gather(a, m, d);
    ed_element_tangent(e, d, block, is);
    memcpy(damped, is, sizeof damped);
    if (softens) { /* just before a snap the tangent falls without bound, and damping by it would drive the brace */
      memcpy(head, block, sizeof head);
      head[ED_BLOCK_K] = 0.0;
      ed_element_tangent(e, d, head, damped);
    }
    for (int i = 0; i < 36; i++)
      a->damped[a->scatter[36 * m + i]] += factor * damped[i] - is[i];
  }
  a->damped[a->nnz] = 0.0;
  a->damped_stamp = a->tangent_stamp;
  return a->damped;
}

void ed_multiply(const ed_analysis *a, const double *matrix, const double *x, double *y)
{
  for (int j = 0; j < a->n; j++) { /* symmetric: a column is a row */
    double sum = 0.0;
    for (int k = a->column_start[j]; k < a->column_start[j + 1]; k++)
      sum += matrix[k] * x[a->row[k]];
    y[j] = sum;
  }
}
