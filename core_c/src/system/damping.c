/* Viscous damping: Rayleigh on the initial, committed or current stiffness, and modal damping as a low-rank matrix. */
#include "base/dense.h"
#include "system/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int ed_rayleigh(ed_analysis *a, double mass_factor, double stiffness_factor, int stiffness)
{
  if (!(mass_factor >= 0.0 && stiffness_factor >= 0.0) || !isfinite(mass_factor + stiffness_factor))
    return ed_fail(a, ED_E_ARGUMENT, "Rayleigh factors %g and %g must not be negative", mass_factor, stiffness_factor);
  if (stiffness < ED_STIFFNESS_INITIAL || stiffness > ED_STIFFNESS_CURRENT)
    return ed_fail(a, ED_E_ARGUMENT, "unknown kind of damping stiffness %d", stiffness);
  a->rayleigh_mass = mass_factor;
  a->rayleigh_stiffness = stiffness_factor;
  a->rayleigh_kind = stiffness;
  memcpy(a->reference, a->initial_damping, ((size_t)a->nnz + 1) * sizeof(double));
  a->factored_stamp = -1;
  return ED_OK;
}

/* Their squares are counted by whole numbers of 32 bits; a matrix of them takes 17 GB. */
enum { MOST_MODES = 46340 };

static double modal_mass(const ed_analysis *a, const double *phi)
{
  double sum = 0.0;
  for (int i = 0; i < a->n; i++)
    sum += a->mass[i] * phi[i] * phi[i];
  return sum;
}

int ed_modal_damping(ed_analysis *a, int n, const double *shape, const double *omega, const double *ratio)
{
  if (n < 0 || n > a->n)
    return ed_fail(a, ED_E_ARGUMENT, "modal damping: %d modes of %d equations", n, a->n);
  if (n > MOST_MODES)
    return ed_fail(a, ED_E_MEMORY, "modal damping: %d modes, at most %d are possible", n, MOST_MODES);
  for (int k = 0; k < n; k++) {
    if (!(ratio[k] >= 0.0) || !(omega[k] > 0.0) || !isfinite(ratio[k] + omega[k]))
      return ed_fail(a, ED_E_ARGUMENT, "modal damping: mode %d has no frequency or a negative ratio", k + 1);
    const double generalised = modal_mass(a, shape + (size_t)k * (size_t)a->n);
    if (!(generalised > 0.0) || !isfinite(2.0 * ratio[k] * omega[k] / generalised))
      return ed_fail(a, ED_E_ARGUMENT, "modal damping: mode %d has no mass", k + 1);
  }
  free(a->modal);
  free(a->modal_solved);
  free(a->modal_small);
  free(a->modal_pivot);
  a->modal = calloc((size_t)n * (size_t)a->n + 1, sizeof(double));
  a->modal_solved = calloc((size_t)n * (size_t)a->n + 1, sizeof(double));
  a->modal_small = calloc((size_t)n * (size_t)n + 1, sizeof(double));
  a->modal_pivot = calloc((size_t)n + 1, sizeof(int));
  a->n_modal = 0;
  if (!a->modal || !a->modal_solved || !a->modal_small || !a->modal_pivot)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  for (int k = 0; k < n; k++) {
    const double *phi = shape + (size_t)k * (size_t)a->n;
    double *m = a->modal + (size_t)k * (size_t)a->n;
    const double generalised = modal_mass(a, phi);
    /* Chopra 2012, Eq. 11.4.5: C = M (sum 2 zeta omega / M_n phi phi') M */
    const double scale = sqrt(2.0 * ratio[k] * omega[k] / generalised);
    for (int i = 0; i < a->n; i++)
      m[i] = scale * a->mass[i] * phi[i];
  }
  a->n_modal = n;
  a->factored_stamp = -1;
  return ED_OK;
}

/* The stiffness that damping is proportional to in this attempt. */
static const double *damping_stiffness(ed_analysis *a)
{
  if (a->rayleigh_kind != ED_STIFFNESS_CURRENT || a->frozen)
    return a->reference;
  return ed_damping_tangent(a);
}

/* Of the trial state. Damping acts on what moves beyond the structure that follows moving supports slowly. */
void ed_damping_force(ed_analysis *a, const double *v, double *force)
{
  const int n = a->n;
  if (a->run.n_motions > 0) {
    memcpy(a->work2, v, (size_t)n * sizeof *v);
    ed_subtract_slow_motion(a, a->trial.support_v, a->work2);
    v = a->work2;
  }
  if (a->rayleigh_stiffness != 0.0) {
    ed_multiply(a, damping_stiffness(a), v, force);
    for (int i = 0; i < n; i++)
      force[i] = a->rayleigh_stiffness * force[i] + a->rayleigh_mass * a->mass[i] * v[i];
  } else {
    for (int i = 0; i < n; i++)
      force[i] = a->rayleigh_mass * a->mass[i] * v[i];
  }
  for (int k = 0; k < a->n_modal; k++) {
    const double *m = a->modal + (size_t)k * (size_t)n;
    double speed = 0.0;
    for (int i = 0; i < n; i++)
      speed += m[i] * v[i];
    for (int i = 0; i < n; i++)
      force[i] += m[i] * speed;
  }
}

/* Factors `effective`, and what modal damping adds to it. */
static int factor(ed_analysis *a, double k, double m, double c)
{
  int repivoted;
  const int status = ed_solver_factor(a->solver, a->effective, &repivoted);
  a->statistics.factorisations += repivoted;
  a->statistics.refactorisations += !repivoted;
  a->factored_stamp = status == ED_OK ? a->tangent_stamp : -1;
  a->flexibility_known = 0;
  a->factored_k = k;
  a->factored_m = m;
  a->factored_c = c;
  if (status != ED_OK || a->n_modal == 0 || c == 0.0)
    return status;
  /* Woodbury: (A + c U U')^-1 with the small matrix I / c + U' A^-1 U */
  const size_t r = (size_t)a->n_modal, n = (size_t)a->n;
  memcpy(a->modal_solved, a->modal, r * n * sizeof(double));
  if (ed_solver_solve(a->solver, a->modal_solved, a->n_modal) != ED_OK)
    return ED_E_SINGULAR;
  for (size_t i = 0; i < r; i++)
    for (size_t j = 0; j < r; j++) {
      double sum = i == j ? 1.0 / c : 0.0;
      for (size_t q = 0; q < n; q++)
        sum += a->modal[i * n + q] * a->modal_solved[j * n + q];
      a->modal_small[i * r + j] = sum;
    }
  return ed_dense_factor(a->n_modal, a->modal_small, a->modal_pivot) ? ED_OK : ED_E_SINGULAR;
}

void ed_note_factors(const ed_analysis *a, ed_factored *to)
{
  to->valid = a->factored_stamp >= 0;
  memcpy(to->matrix, a->effective, (size_t)a->nnz * sizeof(double));
  for (int i = 0; i < a->model->n_devices; i++)
    to->device_slope[i] = a->device_factored[i];
  to->k = a->factored_k;
  to->m = a->factored_m;
  to->c = a->factored_c;
}

/* The path of later steps depends on which factors are kept, so those of the last commit can be had again. */
void ed_keep_factors(ed_analysis *a)
{
  if (!a->kept.valid)
    ed_note_factors(a, &a->kept);
}

void ed_restore_factors(ed_analysis *a)
{
  if (!a->kept.valid)
    return;
  memcpy(a->effective, a->kept.matrix, (size_t)a->nnz * sizeof(double));
  for (int i = 0; i < a->model->n_devices; i++)
    a->device_factored[i] = a->kept.device_slope[i];
  a->kept.valid = 0;
  if (factor(a, a->kept.k, a->kept.m, a->kept.c) == ED_OK)
    a->factored_stamp = 0; /* of an earlier tangent */
}

/* Factors A = k K + c C + m M. */
int ed_factor_effective(ed_analysis *a, double k, double m, double c)
{
  ed_keep_factors(a);
  ed_assemble_tangent(a);
  const double damping = c * a->rayleigh_stiffness;
  if (damping == 0.0) {
    for (int i = 0; i < a->nnz; i++)
      a->effective[i] = k * a->tangent[i];
  } else {
    const double *D = damping_stiffness(a);
    for (int i = 0; i < a->nnz; i++)
      a->effective[i] = k * a->tangent[i] + damping * D[i];
  }
  ed_add_device_tangent(a, k, a->effective);
  for (int i = 0; i < a->model->n_devices; i++)
    a->device_factored[i] = ed_device_slope(a, i);
  const double inertia = m + c * a->rayleigh_mass;
  if (inertia != 0.0)
    for (int i = 0; i < a->n; i++)
      a->effective[a->diagonal[i]] += inertia * a->mass[i];
  return factor(a, k, m, c);
}

/* What modal damping changes in a solution without it. */
static void damp_solution(ed_analysis *a, double *x)
{
  const size_t r = (size_t)a->n_modal, n = (size_t)a->n;
  double *y = a->work2; /* n >= r */
  for (size_t i = 0; i < r; i++) {
    y[i] = 0.0;
    for (size_t q = 0; q < n; q++)
      y[i] += a->modal[i * n + q] * x[q];
  }
  ed_dense_solve(a->n_modal, a->modal_small, a->modal_pivot, y);
  for (size_t i = 0; i < r; i++)
    for (size_t q = 0; q < n; q++)
      x[q] -= a->modal_solved[i * n + q] * y[i];
}

int ed_solve_effective(ed_analysis *a, int count, double *x)
{
  const int status = ed_solver_solve(a->solver, x, count);
  if (status != ED_OK || a->n_modal == 0 || a->factored_c == 0.0)
    return status;
  for (int i = 0; i < count; i++)
    damp_solution(a, x + (size_t)i * (size_t)a->n);
  return ED_OK;
}
