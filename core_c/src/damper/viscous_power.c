/* Power-law dashpot alone: F = c |v|^alpha sgn v, with one c or with one for each direction of the motion. */
#include "damper/laws.h"
#include "damper/power_dashpot.h"
#include "edcore.h"

#include <math.h>

static int follow(double c, double alpha, double v, double h, const ed_path direction[2], ed_damper_force *out)
{
  double secant, slope;
  ed_power_dashpot(c, alpha, v, &secant, &slope);
  out->force = secant * v;
  for (int j = 0; j < 2; j++) {
    out->slope[j] = slope * ed_path_v(&direction[j], h);
    out->chord[j] = alpha < 1.0 ? (secant - slope) * ed_path_v(&direction[j], h) : 0.0;
  }
  return isfinite(out->force) && isfinite(out->slope[0]) && isfinite(out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  enum { ED_LAW_VISCOUS_POWER_PARAMETERS };
  (void)committed, (void)trial;
  return follow(damper->parameter[C], damper->parameter[ALPHA], ed_path_v(path, path->h), path->h, direction, out);
}

static int step_asymmetric(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                           double *trial, ed_damper_force *out)
{
  enum { ED_LAW_ASYMMETRIC_VISCOUS_PARAMETERS };
  (void)committed, (void)trial;
  const double *p = damper->parameter, v = ed_path_v(path, path->h);
  return follow(p[v < 0.0 ? C_MINUS : C_PLUS], p[ALPHA], v, path->h, direction, out);
}

/* With a spring in series: equations that are smooth at rest, where an equilibrium of both by iteration is not. */
static void with_brace(ed_damper *damper)
{
  enum { ED_LAW_MAXWELL_POWER_PARAMETERS, PARAMETERS }; /* the first two are its own */
  damper->law = &ed_maxwell_power;
  damper->parameter[K] = INFINITY; /* no spring but the brace */
  damper->n_parameters = PARAMETERS;
}

const ed_law ed_viscous_power = {
    .name = "viscous_power", .with_brace = with_brace, .step = step};
const ed_law ed_asymmetric_viscous = {.name = "asymmetric_viscous",
                                      .step = step_asymmetric};
