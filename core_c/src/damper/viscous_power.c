/* Power-law dashpot alone: F = c |v|^alpha sgn v. */
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

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  (void)committed, (void)trial;
  const double c = damper->parameter[0], alpha = damper->parameter[1], h = path->h;
  const double v = ed_path_v(path, h);
  double secant, slope;
  ed_power_dashpot(c, alpha, v, &secant, &slope);
  out->force = secant * v;
  for (int j = 0; j < 2; j++) {
    out->slope[j] = slope * ed_path_v(&direction[j], h);
    out->chord[j] = alpha < 1.0 ? (secant - slope) * ed_path_v(&direction[j], h) : 0.0;
  }
  return isfinite(out->force) && isfinite(out->slope[0]) && isfinite(out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
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
