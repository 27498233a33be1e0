/* Power-law dashpot in series with a spring: F' = k (v - sgn F (|F| / c)^(1/alpha)). A brace joins the spring. */
#include "damper/laws.h"
#include "edcore.h"

#include <math.h>

enum { C, ALPHA, K, PARAMETERS };

/* For alpha > 1 the derivative of the dashpot's velocity to the force is infinite at rest. Below this share of c it is held: the
 * force itself is not touched, and a sensitivity that passes through rest fades there all the same. */
static const double AT_REST = 1e-16;

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  if (!(p[C] > 0.0))
    return ed_refuse_parameter(message, "c", p[C], "above zero");
  if (!(p[ALPHA] > 0.0 && p[ALPHA] <= 2.0))
    return ed_refuse_parameter(message, "alpha", p[ALPHA], "above 0 and at most 2");
  if (!(p[K] > 0.0))
    return ed_refuse_parameter(message, "k", p[K], "above zero");
  damper->n_ode = 1;
  damper->diagonal_ode = 1;
  return ED_OK;
}

static void rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  (void)u, (void)memory;
  const double *p = damper->parameter, power = 1.0 / p[ALPHA];
  const double k = damper->brace > 0.0 ? 1.0 / (1.0 / p[K] + 1.0 / damper->brace) : p[K];
  const double size = fmax(fabs(y[0]) / p[C], AT_REST);
  const double lower = power == 1.0 ? 1.0 : power == 2.0 ? size : pow(size, power - 1.0);
  out->force = y[0];
  out->force_u = out->force_v = 0.0;
  out->force_y[0] = 1.0;
  out->y[0] = k * (v - lower * (y[0] / p[C]));
  out->y_u[0] = 0.0;
  out->y_v[0] = k;
  out->y_y[0] = -k * power * lower / p[C];
}

const ed_law ed_maxwell_power = {.name = "maxwell_power",
                                 .least_parameters = PARAMETERS,
                                 .most_parameters = PARAMETERS,
                                 .takes_brace = 1,
                                 .prepare = prepare,
                                 .rate = rate};
