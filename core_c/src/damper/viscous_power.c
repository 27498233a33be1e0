/* Power-law dashpot alone: F = c |v|^alpha sgn v, with one c or with one for each direction of the motion. */
#include "damper/laws.h"
#include "damper/power_dashpot.h"
#include "edcore.h"

#include <math.h>

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double c = damper->parameter[0], alpha = damper->parameter[1];
  if (!(c > 0.0))
    return ed_refuse_parameter(message, "c", c, "it must be above zero");
  if (!(alpha > 0.0 && alpha <= 2.0))
    return ed_refuse_parameter(message, "alpha", alpha, "it must be above 0 and at most 2");
  return ED_OK;
}

static int prepare_asymmetric(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  for (int i = 0; i < 2; i++)
    if (!(p[i] > 0.0))
      return ed_refuse_parameter(message, i == 0 ? "c_plus" : "c_minus", p[i], "it must be above zero");
  if (!(p[2] > 0.0 && p[2] <= 2.0))
    return ed_refuse_parameter(message, "alpha", p[2], "it must be above 0 and at most 2");
  return ED_OK;
}

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
  (void)committed, (void)trial;
  return follow(damper->parameter[0], damper->parameter[1], ed_path_v(path, path->h), path->h, direction, out);
}

static int step_asymmetric(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                           double *trial, ed_damper_force *out)
{
  (void)committed, (void)trial;
  const double v = ed_path_v(path, path->h);
  return follow(damper->parameter[v < 0.0], damper->parameter[2], v, path->h, direction, out);
}

/* With a spring in series: equations that are smooth at rest, where an equilibrium of both by iteration is not. */
static void with_brace(ed_damper *damper)
{
  damper->law = &ed_maxwell_power;
  damper->parameter[2] = INFINITY; /* no spring but the brace */
  damper->n_parameters = 3;
}

const ed_law ed_viscous_power = {
    .name = "viscous_power", .least_parameters = 2, .most_parameters = 2, .with_brace = with_brace, .prepare = prepare, .step = step};
const ed_law ed_asymmetric_viscous = {.name = "asymmetric_viscous",
                                      .least_parameters = 3,
                                      .most_parameters = 3,
                                      .prepare = prepare_asymmetric,
                                      .step = step_asymmetric};
