/* Self-centring device with flag-shaped loops (Christopoulos, Filiatrault & Folz 2002): F = k (u - p), and on the side of u > 0
 *
 *   U - (1 - b) beta Fy <= F <= U,  U = (1 - b) Fy + b k u,  p >= 0,
 *
 * so that the gap opens at Fy and closes at (1 - beta) Fy; likewise on the other side. As bounds of the inelastic deformation p these are a
 * play on each side, whose bounds rise with u; together they are exact along a monotone motion in one step. Memory: p of each side. */
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>

enum { ED_LAW_SELF_CENTRING_PARAMETERS, PARAMETERS };

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  (void)message;
  damper->n_memory = 2;
  return ED_OK;
}

/* The inelastic deformation of a side and its derivatives to the unknowns. */
typedef struct {
  double p, slope[2];
} inelastic;

/* Moves it within its bounds at a deformation to that side; `sign` turns the motion's slopes to it. */
static void keep(const double parameter[PARAMETERS], double u, double sign, const ed_motion *motion, inelastic *of)
{
  const double opens = parameter[FY] / parameter[K], closes = (1.0 - parameter[BETA]) * opens, rise = 1.0 - parameter[B];
  const double least = fmax(0.0, rise * (u - opens)), most = fmax(0.0, rise * (u - closes));
  if (of->p >= least && of->p <= most)
    return;
  const double moves = of->p < least || most > 0.0 ? rise * sign : 0.0; /* a bound of zero stands still */
  of->p = of->p < least ? least : most;
  for (int j = 0; j < 2; j++)
    of->slope[j] = moves * motion->slope[j];
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *parameter = damper->parameter;
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  inelastic plus = {.p = committed[0]}, minus = {.p = committed[1]};
  for (int i = 0; i < n; i++) {
    keep(parameter, motion[i].u, 1.0, &motion[i], &plus);
    keep(parameter, -motion[i].u, -1.0, &motion[i], &minus);
  }
  out->force = parameter[K] * (motion[n - 1].u - plus.p + minus.p);
  for (int j = 0; j < 2; j++)
    out->slope[j] = parameter[K] * (motion[n - 1].slope[j] - plus.slope[j] + minus.slope[j]);
  trial[0] = plus.p;
  trial[1] = minus.p;
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_self_centring = {.name = "self_centring",
                                 .rate_independent = 1,
                                 .prepare = prepare,
                                 .step = step};
