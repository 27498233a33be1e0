/* Oil damper with a relief valve: F = c v up to the relief force F_r, beyond it p c for each further unit of velocity (Japan Society of
 * Seismic Isolation, manual for passively controlled buildings). */
#include "damper/laws.h"
#include "edcore.h"

#include <math.h>

enum { C, RELIEF, RATIO, PARAMETERS };

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  if (!(p[C] > 0.0))
    return ed_refuse_parameter(message, "c", p[C], "greater than 0");
  if (!(p[RELIEF] > 0.0))
    return ed_refuse_parameter(message, "F_r", p[RELIEF], "greater than 0");
  if (!(p[RATIO] >= 0.0 && p[RATIO] <= 1.0))
    return ed_refuse_parameter(message, "p", p[RATIO], "at least 0 and at most 1");
  return ED_OK;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  (void)committed, (void)trial;
  const double *p = damper->parameter, closed = p[C] * ed_path_v(path, path->h), over = fabs(closed) - p[RELIEF];
  const int opens = over > 0.0;
  out->force = opens ? copysign(p[RELIEF] + p[RATIO] * over, closed) : closed;
  for (int j = 0; j < 2; j++)
    out->slope[j] = (opens ? p[RATIO] : 1.0) * p[C] * ed_path_v(&direction[j], path->h);
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_bilinear_oil = {.name = "bilinear_oil",
                                .least_parameters = PARAMETERS,
                                .most_parameters = PARAMETERS,
                                .prepare = prepare,
                                .step = step};
