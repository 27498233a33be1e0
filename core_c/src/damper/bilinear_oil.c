/* Oil damper with a relief valve: F = c v up to the relief force F_r, beyond it p c for each further unit of velocity (Japan Society of
 * Seismic Isolation, manual for passively controlled buildings). */
#include "damper/laws.h"
#include "edcore.h"

#include <math.h>

enum { ED_LAW_BILINEAR_OIL_PARAMETERS };

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  (void)committed, (void)trial;
  const double *p = damper->parameter, closed = p[C] * ed_path_v(path, path->h), over = fabs(closed) - p[F_R];
  const int opens = over > 0.0;
  out->force = opens ? copysign(p[F_R] + p[P] * over, closed) : closed;
  for (int j = 0; j < 2; j++)
    out->slope[j] = (opens ? p[P] : 1.0) * p[C] * ed_path_v(&direction[j], path->h);
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_bilinear_oil = {.name = "bilinear_oil",
                                .step = step};
