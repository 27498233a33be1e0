/* What the terms of the MGMM do over each step, for any relaxation time. */
#include "damper/laws.h"
#include "damper/mgmm_terms.h"
#include "damper/test_run.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

/* Integral of x^m T_k(2 x - 1) from 0 to 1. */
static const double OF_POWERS[4][ED_MOMENTS] = {
  {1.0, 0.0, -1.0 / 3.0, 0.0, -1.0 / 15.0, 0.0},
  {1.0 / 2.0, 1.0 / 6.0, -1.0 / 6.0, -1.0 / 10.0, -1.0 / 30.0, -1.0 / 42.0},
  {1.0 / 3.0, 1.0 / 6.0, -1.0 / 15.0, -1.0 / 10.0, -1.0 / 21.0, -1.0 / 42.0},
  {1.0 / 4.0, 3.0 / 20.0, -1.0 / 60.0, -11.0 / 140.0, -23.0 / 420.0, -1.0 / 36.0},
};

/* At rest at a first deformation, then at once at a first velocity. */
static void begin(const ed_damper *damper, double u, double v, double *memory)
{
  const double *been = damper->been;
  ed_mgmm_remember(ed_mgmm_constants_of(damper), ed_extremes_with(ed_mgmm_extremes(been, ED_LARGEST_U), u),
                   ed_extremes_with(ed_mgmm_extremes(been, ED_LARGEST_V), v), memory);
}

/* Moments of a path times a modulus; NULL: not wanted. */
static void constant_moments(double modulus, const ed_path *path, double *moment)
{
  const double h = path->h, *c = path->c, of[4] = {modulus * c[0], modulus * h * c[1], modulus * h * h * c[2], modulus * h * h * h * c[3]};
  for (int k = 0; moment && k < ED_MOMENTS; k++)
    moment[k] = of[0] * OF_POWERS[0][k] + of[1] * OF_POWERS[1][k] + of[2] * OF_POWERS[2][k] + of[3] * OF_POWERS[3][k];
}

/* The moments of k_mod u and c_mod v over one step; moves what is remembered to its end. */
static int softened_moments(const ed_mgmm_constants *law, double *memory, const ed_path *path, double *spring, double *dashpot)
{
  ed_path velocity;
  ed_path_of_velocity(path, &velocity);
  if (ed_mgmm_still(memory, path)) {
    constant_moments(memory[ED_K_MOD], path, spring);
    constant_moments(memory[ED_C_MOD], &velocity, dashpot);
    return ED_OK;
  }
  ed_mgmm_sums sum = {.path = *path, .velocity = velocity, .moments = 1, .spring = spring, .dashpot = dashpot};
  ed_softening_piece of_u[ED_EXTREMES_PIECES], of_v[ED_EXTREMES_PIECES];
  ed_running after_u, after_v;
  const int n_u = ed_softening_pieces(ed_mgmm_extremes(memory, ED_LARGEST_U), path, NULL, 0.0, of_u, &after_u);
  const int n_v = ed_softening_pieces(ed_mgmm_extremes(memory, ED_LARGEST_V), &velocity, NULL, 0.0, of_v, &after_v);
  of_u[n_u - 1].to = of_v[n_v - 1].to = path->h;
  if (!ed_mgmm_add_softened(law, &sum, of_u, of_v))
    return ED_E_NOT_FINITE;
  ed_mgmm_remember(law, after_u, after_v, memory);
  return ED_OK;
}

/* Rows before the first one that is not finite; NULL: all. */
static int finite_rows(const double *moment, int rows)
{
  for (int i = 0; moment && i < rows; i++)
    for (int k = 0; k < ED_MOMENTS; k++)
      if (!isfinite(moment[(size_t)i * ED_MOMENTS + (size_t)k]))
        return i;
  return rows;
}

int ed_mgmm_moments(const ed_damper *damper, int n, const double *time, const double *u, const double *v, double *spring,
                    double *dashpot, double *power, double *held, int *done)
{
  *done = 0;
  if (damper->law != &ed_mgmm || damper->brace + damper->joint > 0.0 || damper->n_amendments > 0)
    return ED_E_STATE;
  int status = ed_check_samples(n, time, u, v, done);
  if (status != ED_OK)
    return status;
  const ed_mgmm_constants *law = ed_mgmm_constants_of(damper);
  ed_watch watch = ed_watch_of(&damper->stop);
  double memory[ED_MGMM_MEMORY];
  begin(damper, u[0], v[0], memory);
  *held = memory[ED_K_MOD] * u[0];
  if (!isfinite(*held))
    return ED_E_NOT_FINITE;
  const size_t size = ED_MOMENTS * ((size_t)n - 1) * sizeof(double);
  double *const wanted[] = {spring, dashpot, power};
  for (int j = 0; j < 3; j++)
    if (wanted[j])
      memset(wanted[j], 0, size);
  for (size_t i = 1; (spring || dashpot) && i < (size_t)n; i++) {
    const size_t at = ED_MOMENTS * (i - 1);
    ed_path path;
    ed_path_hermite(&path, time[i] - time[i - 1], u[i - 1], v[i - 1], u[i], v[i]);
    status = isfinite(ed_path_u(&path, path.h)) ? ED_OK : ED_E_NOT_FINITE;
    if (status == ED_OK)
      status = softened_moments(law, memory, &path, spring ? spring + at : NULL, dashpot ? dashpot + at : NULL);
    if (status == ED_OK && ed_watch_step(&watch))
      status = ED_E_STOPPED;
    if (status != ED_OK) {
      *done = (int)i;
      return status;
    }
  }
  if (power && !ed_power_moments(&law->power, n, time, u, v, power, &watch))
    return ED_E_STOPPED;
  *done = n;
  for (int j = 0; j < 3; j++) {
    const int finite = finite_rows(wanted[j], n - 1) + 1;
    *done = finite < *done ? finite : *done;
  }
  return *done == n ? ED_OK : ED_E_NOT_FINITE;
}
