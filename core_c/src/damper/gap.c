/* Contact that opens: F = k x (1 + d x') s where x = s u - gap > 0, s = 1, -1 or both sides, and never pulls. The loss d x' of Hunt &
 * Crossley (1975) begins at zero with the contact, so that the force has no jump. */
#include "damper/laws.h"
#include "edcore.h"

#include <math.h>

enum { ED_LAW_GAP_PARAMETERS };

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  (void)message;
  damper->rate_independent = p[D] == 0.0;
  return ED_OK;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  (void)committed, (void)trial;
  const double *p = damper->parameter, h = path->h, u = ed_path_u(path, h);
  const double side = p[SIDE] != 0.0 ? p[SIDE] : copysign(1.0, u), x = side * u - p[GAP];
  const double loss = 1.0 + p[D] * side * ed_path_v(path, h);
  const int touches = x > 0.0 && loss > 0.0;
  out->force = touches ? side * p[K] * x * loss : 0.0;
  for (int j = 0; j < 2; j++) /* side * side = 1 */
    out->slope[j] = touches ? p[K] * (loss * ed_path_u(&direction[j], h) + x * p[D] * ed_path_v(&direction[j], h)) : 0.0;
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_gap = {.name = "gap",
                       .rate_independent = 1,
                       .prepare = prepare,
                       .step = step};
