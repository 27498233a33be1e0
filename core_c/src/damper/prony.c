#include "damper/prony.h"

#include "damper/laws.h"
#include "damper/relaxation.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPRING, DASHPOT, RATES }; /* in `derived`; the rates of the branches, then their stiffnesses */

int ed_prony_prepare(ed_damper *damper, const ed_prony *series, char message[ED_DAMPER_MESSAGE])
{
  const int n = series->branches;
  const size_t size = (size_t)n * sizeof(double);
  if (!isfinite(series->spring))
    return ed_refuse_parameter(message, "stiffness", series->spring, "it must be finite");
  if (!isfinite(series->dashpot))
    return ed_refuse_parameter(message, "damping coefficient", series->dashpot, "it must be finite");
  for (int i = 0; i < n; i++) {
    if (!(series->rate[i] > 0.0) || !isfinite(series->rate[i]))
      return ed_refuse_parameter(message, "relaxation rate", series->rate[i], "it must be finite and above zero");
    if (!(series->stiffness[i] >= 0.0) || !isfinite(series->stiffness[i]))
      return ed_refuse_parameter(message, "stiffness of a branch", series->stiffness[i], "it must be finite");
  }
  damper->n_derived = RATES + 2 * n;
  damper->derived = malloc((size_t)damper->n_derived * sizeof *damper->derived);
  if (!damper->derived)
    return ED_E_MEMORY;
  damper->derived[SPRING] = series->spring;
  damper->derived[DASHPOT] = series->dashpot;
  memcpy(damper->derived + RATES, series->rate, size);
  memcpy(damper->derived + RATES + n, series->stiffness, size);
  damper->n_ode = n;
  damper->diagonal_ode = 1;
  return ED_OK;
}

void ed_prony_without_dashpots(ed_damper *damper)
{
  enum { ED_LAW_KELVIN_VOIGT_PARAMETERS, PARAMETERS };
  damper->law = &ed_kelvin_voigt;
  damper->n_parameters = PARAMETERS;
  damper->parameter[C] = 0.0;
}

int ed_prony_step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out)
{
  const double h = path->h, *c = path->c, *rate = damper->derived + RATES;
  const int n = damper->n_ode;
  double first[ED_MAX_ODE], second[ED_MAX_ODE], third[ED_MAX_ODE];
  double sum = 0.0, gain[3] = {0.0};
  if (n) {
    const double v[3] = {c[1], 2.0 * c[2] * h, 6.0 * c[3] * h * h};
    ed_relax(n, h, v, rate, rate + n, committed, trial, (double *const[3]){first, second, third});
    for (int i = 0; i < n; i++) {
      sum += trial[i];
      gain[0] += first[i];
      gain[1] += second[i];
      gain[2] += third[i];
    }
  }
  const double spring = damper->derived[SPRING], dashpot = damper->derived[DASHPOT];
  out->force = spring * ed_path_u(path, h) + dashpot * ed_path_v(path, h) + sum;
  for (int j = 0; j < 2; j++) {
    const ed_path *d = &direction[j];
    out->slope[j] = spring * ed_path_u(d, h) + dashpot * ed_path_v(d, h) +
                    (gain[0] * d->c[1] + gain[1] * 2.0 * d->c[2] * h + gain[2] * 6.0 * d->c[3] * h * h);
  }
  return isfinite(out->force) && isfinite(out->slope[0]) && isfinite(out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

void ed_prony_rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  (void)memory;
  const int n = damper->n_ode;
  const double *rate = damper->derived + RATES, *stiffness = rate + n;
  out->force = damper->derived[SPRING] * u + damper->derived[DASHPOT] * v;
  out->force_u = damper->derived[SPRING];
  out->force_v = damper->derived[DASHPOT];
  for (int i = 0; i < n; i++) {
    out->force += y[i];
    out->force_y[i] = 1.0;
    out->y[i] = stiffness[i] * v - rate[i] * y[i];
    out->y_u[i] = 0.0;
    out->y_v[i] = stiffness[i];
    out->y_y[i] = -rate[i];
  }
}
