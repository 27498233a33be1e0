#include "damper/laws.h"
#include "edcore.h"

#include <math.h>

/* F = c |v|^alpha sgn v. For alpha < 1 its slope at rest is infinite: a tangent matrix would be useless there, and rounding of the
 * velocity (1e-13 of a unit) would make forces. Below this speed, in the caller's units of length and time (a nanometre a second),
 * F is therefore the chord from the origin, and so is the slope. It differs there from the power by less than c AT_REST^alpha,
 * 0.4 % of the force at 0.1 for alpha = 0.3, and a device that slow is at rest for any other purpose. */
static const double AT_REST = 1e-9;

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
  const double v = ed_path_v(path, h), speed = fabs(v);
  double secant, slope;
  if (speed < AT_REST && alpha <= 1.0) {
    secant = slope = c * pow(AT_REST, alpha - 1.0);
  } else {
    secant = c * pow(speed, alpha - 1.0);
    slope = alpha * secant;
  }
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
