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
  a->damping.rayleigh_mass = mass_factor;
  a->damping.rayleigh_stiffness = stiffness_factor;
  a->damping.rayleigh_kind = stiffness;
  memcpy(a->damping.reference, a->matrix.initial_damping, ((size_t)a->matrix.nnz + 1) * sizeof(double));
  a->factors.stamp = -1;
  return ED_OK;
}

/* Their squares are counted by whole numbers of 32 bits; a matrix of them takes 17 GB. */
enum { MOST_MODES = 46340 };

static double modal_mass(const ed_numbering *numbering, const double *phi)
{
  double sum = 0.0;
  for (int i = 0; i < numbering->n; i++)
    sum += numbering->mass[i] * phi[i] * phi[i];
  return sum;
}

int ed_modal_damping(ed_analysis *a, int n, const double *shape, const double *omega, const double *ratio)
{
  if (n < 0 || n > a->numbering.n)
    return ed_fail(a, ED_E_ARGUMENT, "modal damping: %d modes of %d equations", n, a->numbering.n);
  if (n > MOST_MODES)
    return ed_fail(a, ED_E_MEMORY, "modal damping: %d modes, at most %d are possible", n, MOST_MODES);
  for (int k = 0; k < n; k++) {
    if (!(ratio[k] >= 0.0) || !(omega[k] > 0.0) || !isfinite(ratio[k] + omega[k]))
      return ed_fail(a, ED_E_ARGUMENT, "modal damping: mode %d has no frequency or a negative ratio", k + 1);
    const double generalised = modal_mass(&a->numbering, shape + (size_t)k * (size_t)a->numbering.n);
    if (!(generalised > 0.0) || !isfinite(2.0 * ratio[k] * omega[k] / generalised))
      return ed_fail(a, ED_E_ARGUMENT, "modal damping: mode %d has no mass", k + 1);
  }
  free(a->damping.modal);
  free(a->damping.modal_solved);
  free(a->damping.modal_small);
  free(a->damping.modal_pivot);
  a->damping.modal = calloc((size_t)n * (size_t)a->numbering.n + 1, sizeof(double));
  a->damping.modal_solved = calloc((size_t)n * (size_t)a->numbering.n + 1, sizeof(double));
  a->damping.modal_small = calloc((size_t)n * (size_t)n + 1, sizeof(double));
  a->damping.modal_pivot = calloc((size_t)n + 1, sizeof(int));
  a->damping.n_modal = 0;
  if (!a->damping.modal || !a->damping.modal_solved || !a->damping.modal_small || !a->damping.modal_pivot)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  for (int k = 0; k < n; k++) {
    const double *phi = shape + (size_t)k * (size_t)a->numbering.n;
    double *m = a->damping.modal + (size_t)k * (size_t)a->numbering.n;
    const double generalised = modal_mass(&a->numbering, phi);
    /* Chopra 2012, Eq. 11.4.5: C = M (sum 2 zeta omega / M_n phi phi') M */
    const double scale = sqrt(2.0 * ratio[k] * omega[k] / generalised);
    for (int i = 0; i < a->numbering.n; i++)
      m[i] = scale * a->numbering.mass[i] * phi[i];
  }
  a->damping.n_modal = n;
  a->factors.stamp = -1;
  return ED_OK;
}

/* The stiffness that damping is proportional to in this attempt. */
const double *ed_damping_stiffness(ed_analysis *a)
{
  if (a->damping.rayleigh_kind != ED_STIFFNESS_CURRENT || a->damping.frozen)
    return a->damping.reference;
  return ed_damping_tangent(a);
}

/* Of the trial state. Damping acts on what moves beyond the structure that follows moving supports slowly. */
void ed_damping_force(ed_analysis *a, const double *v, double *force)
{
  const int n = a->numbering.n;
  if (a->run.n_motions > 0) {
    memcpy(a->iteration.work2, v, (size_t)n * sizeof *v);
    ed_subtract_slow_motion(&a->run, a->numbering.n, a->trial.support_v, a->iteration.work2);
    v = a->iteration.work2;
  }
  if (a->damping.rayleigh_stiffness != 0.0) {
    ed_multiply(&a->matrix, ed_damping_stiffness(a), v, force);
    for (int i = 0; i < n; i++)
      force[i] = a->damping.rayleigh_stiffness * force[i] + a->damping.rayleigh_mass * a->numbering.mass[i] * v[i];
  } else {
    for (int i = 0; i < n; i++)
      force[i] = a->damping.rayleigh_mass * a->numbering.mass[i] * v[i];
  }
  for (int k = 0; k < a->damping.n_modal; k++) {
    const double *m = a->damping.modal + (size_t)k * (size_t)n;
    double speed = 0.0;
    for (int i = 0; i < n; i++)
      speed += m[i] * v[i];
    for (int i = 0; i < n; i++)
      force[i] += m[i] * speed;
  }
}

void ed_freeze_damping(ed_analysis *a, int fallback)
{
  a->damping.frozen = fallback >= ED_FALLBACK_FROZEN_DAMPING;
  if (a->damping.rayleigh_stiffness == 0.0)
    return;
  const int kind = a->damping.rayleigh_kind;
  if (kind == ED_STIFFNESS_COMMITTED || (kind == ED_STIFFNESS_CURRENT && a->damping.frozen))
    memcpy(a->damping.reference, ed_damping_tangent(a), ((size_t)a->matrix.nnz + 1) * sizeof(double));
}

/* Woodbury: (A + c U U')^-1 with the small matrix I / c + U' A^-1 U */
int ed_factor_modal(ed_analysis *a, double c)
{
  if (a->damping.n_modal == 0 || c == 0.0)
    return ED_OK;
  const size_t r = (size_t)a->damping.n_modal, n = (size_t)a->numbering.n;
  memcpy(a->damping.modal_solved, a->damping.modal, r * n * sizeof(double));
  if (ed_solver_solve(a->factors.solver, a->damping.modal_solved, a->damping.n_modal) != ED_OK)
    return ED_E_SINGULAR;
  for (size_t i = 0; i < r; i++)
    for (size_t j = 0; j < r; j++) {
      double sum = i == j ? 1.0 / c : 0.0;
      for (size_t q = 0; q < n; q++)
        sum += a->damping.modal[i * n + q] * a->damping.modal_solved[j * n + q];
      a->damping.modal_small[i * r + j] = sum;
    }
  return ed_dense_factor(a->damping.n_modal, a->damping.modal_small, a->damping.modal_pivot) ? ED_OK : ED_E_SINGULAR;
}

/* What modal damping changes in a solution without it. */
void ed_damp_solution(ed_damping *damping, int equations, double *x, double *work)
{
  const size_t r = (size_t)damping->n_modal, n = (size_t)equations;
  double *y = work; /* n >= r */
  for (size_t i = 0; i < r; i++) {
    y[i] = 0.0;
    for (size_t q = 0; q < n; q++)
      y[i] += damping->modal[i * n + q] * x[q];
  }
  ed_dense_solve(damping->n_modal, damping->modal_small, damping->modal_pivot, y);
  for (size_t i = 0; i < r; i++)
    for (size_t q = 0; q < n; q++)
      x[q] -= damping->modal_solved[i * n + q] * y[i];
}

void ed_damping_free(ed_damping *damping)
{
  free(damping->reference);
  free(damping->modal);
  free(damping->modal_solved);
  free(damping->modal_small);
  free(damping->modal_pivot);
}
