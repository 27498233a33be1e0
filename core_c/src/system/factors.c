#include "system/factors.h"

#include "system/analysis.h"

#include <stdlib.h>
#include <string.h>

static int allocate_kept(ed_kept_factors *kept, size_t terms, size_t devices)
{
  kept->matrix = malloc(terms * sizeof(double));
  kept->device_slope = calloc(2 * devices, sizeof(double));
  return kept->matrix && kept->device_slope;
}

int ed_factors_allocate(ed_analysis *a)
{
  const size_t terms = (size_t)a->matrix.nnz + 1, devices = (size_t)a->model->n_devices + 1;
  ed_factors *factors = &a->factors;
  factors->stamp = -1;
  factors->effective = malloc(terms * sizeof(double));
  factors->device_slope = calloc(2 * devices, sizeof(double));
  if (!factors->effective || !factors->device_slope || !allocate_kept(&factors->kept, terms, devices) ||
      !allocate_kept(&factors->backed, terms, devices))
    return ED_E_MEMORY;
  factors->solver = ed_solver_new(a->numbering.n, a->matrix.column_start, a->matrix.row, a->matrix.diagonal, a->numbering.scale);
  return factors->solver ? ED_OK : ED_E_MEMORY;
}

void ed_factors_free(ed_factors *factors)
{
  ed_solver_free(factors->solver);
  free(factors->effective);
  free(factors->device_slope);
  free(factors->kept.matrix);
  free(factors->kept.device_slope);
  free(factors->backed.matrix);
  free(factors->backed.device_slope);
}

/* Factors `effective`, and what modal damping adds to it. */
static int factor(ed_analysis *a, double k, double m, double c)
{
  int repivoted;
  const int status = ed_solver_factor(a->factors.solver, a->factors.effective, &repivoted);
  a->statistics.factorisations += repivoted;
  a->statistics.refactorisations += !repivoted;
  a->factors.stamp = status == ED_OK ? a->matrix.stamp : -1;
  a->condensation.known = 0;
  a->factors.k = k;
  a->factors.m = m;
  a->factors.c = c;
  return status == ED_OK ? ed_factor_modal(a, c) : status;
}

/* Of the dampers, and of bearings to what they do across. */
static size_t slopes(const ed_analysis *a)
{
  return (a->devices.bearings ? 2 : 1) * (size_t)a->model->n_devices;
}

void ed_note_factors(const ed_analysis *a, ed_kept_factors *to)
{
  to->valid = a->factors.stamp >= 0;
  memcpy(to->matrix, a->factors.effective, (size_t)a->matrix.nnz * sizeof(double));
  memcpy(to->device_slope, a->factors.device_slope, slopes(a) * sizeof(double));
  to->k = a->factors.k;
  to->m = a->factors.m;
  to->c = a->factors.c;
}

/* The path of later steps depends on which factors are kept, so those of the last commit can be had again. */
void ed_keep_factors(ed_analysis *a)
{
  if (!a->factors.kept.valid)
    ed_note_factors(a, &a->factors.kept);
}

void ed_restore_factors(ed_analysis *a)
{
  if (!a->factors.kept.valid)
    return;
  memcpy(a->factors.effective, a->factors.kept.matrix, (size_t)a->matrix.nnz * sizeof(double));
  memcpy(a->factors.device_slope, a->factors.kept.device_slope, slopes(a) * sizeof(double));
  a->factors.kept.valid = 0;
  if (factor(a, a->factors.kept.k, a->factors.kept.m, a->factors.kept.c) == ED_OK)
    a->factors.stamp = 0; /* of an earlier tangent */
}

/* Factors A = k K + c C + m M. */
int ed_factor_effective(ed_analysis *a, double k, double m, double c)
{
  ed_keep_factors(a);
  ed_assemble_tangent(a);
  const double damping = c * a->damping.rayleigh_stiffness;
  if (damping == 0.0) {
    for (int i = 0; i < a->matrix.nnz; i++)
      a->factors.effective[i] = k * a->matrix.tangent[i];
  } else {
    const double *D = ed_damping_stiffness(a);
    for (int i = 0; i < a->matrix.nnz; i++)
      a->factors.effective[i] = k * a->matrix.tangent[i] + damping * D[i];
  }
  ed_add_device_tangent(a, k, a->factors.effective);
  for (int i = 0; i < a->model->n_devices; i++)
    a->factors.device_slope[i] = ed_device_slope(&a->devices, &a->trial, i);
  for (int i = 0; a->devices.bearings && i < a->model->n_devices; i++)
    a->factors.device_slope[a->model->n_devices + i] = ed_device_cross_slope(&a->devices, &a->trial, i);
  const double inertia = m + c * a->damping.rayleigh_mass;
  if (inertia != 0.0)
    for (int i = 0; i < a->numbering.n; i++)
      a->factors.effective[a->matrix.diagonal[i]] += inertia * a->numbering.mass[i];
  return factor(a, k, m, c);
}

int ed_solve_effective(ed_analysis *a, int count, double *x)
{
  const int status = ed_solver_solve(a->factors.solver, x, count);
  if (status != ED_OK || a->damping.n_modal == 0 || a->factors.c == 0.0)
    return status;
  for (int i = 0; i < count; i++)
    ed_damp_solution(&a->damping, a->numbering.n, x + (size_t)i * (size_t)a->numbering.n, a->iteration.work2);
  return ED_OK;
}
