/* A dashpot F = c |v|^alpha sgn v.
 *
 * For alpha < 1 its slope at rest is infinite: a tangent matrix would be useless there, and rounding of the velocity (1e-13 of a unit) would
 * make forces. Below ED_AT_REST, in the caller's units of length and time (a nanometre a second), F is therefore the chord from the origin,
 * and so is the slope. It differs there from the power by less than c ED_AT_REST^alpha, 0.4 % of the force at 0.1 for alpha = 0.3, and a
 * device that slow is at rest for any other purpose. */
#ifndef ED_POWER_DASHPOT_H
#define ED_POWER_DASHPOT_H

#include <math.h>

#define ED_AT_REST 1e-9

/* Secant and slope: the force is secant * v. */
static inline void ed_power_dashpot(double c, double alpha, double v, double *secant, double *slope)
{
  const double speed = fabs(v);
  const int rest = speed < ED_AT_REST && alpha <= 1.0;
  *secant = alpha == 1.0 ? c : c * pow(rest ? ED_AT_REST : speed, alpha - 1.0);
  *slope = rest ? *secant : alpha * *secant;
}

#endif
