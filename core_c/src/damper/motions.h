/* The path as hysteresis sees it: the deformations at which it turns, and the one at which it ends. */
#ifndef ED_MOTIONS_H
#define ED_MOTIONS_H

#include "damper/path.h"

#include <math.h>

/* A monotone motion from where the last one ended. */
typedef struct {
  double u;        /* where it leads */
  double slope[2]; /* derivative of that to the unknowns. At a turn v = 0, so that its moving in time adds nothing */
  int sign;        /* of the motion; 0: none beyond rounding */
} ed_motion;

/* Signs alternate; a sign 0 comes only alone, when nothing moves. How many there are, 1 to 3. */
static inline int ed_path_motions(const ed_path *path, const ed_path direction[2], ed_motion motion[3])
{
  const double *c = path->c, h = path->h;
  /* A turn that rounding makes must not count: some laws forget their last reversal at any turn, however small. */
  const double rounding = 1e-14 * (fabs(c[0]) + h * (fabs(c[1]) + h * (fabs(c[2]) + h * fabs(c[3]))));
  double at[3], from = c[0];
  const int turns = ed_path_reversals(path, at);
  int n = 0;
  at[turns] = h;
  for (int i = 0; i <= turns; i++) {
    const double u = ed_path_u(path, at[i]), change = u - from;
    const int sign = change > rounding ? 1 : change < -rounding ? -1 : 0;
    if (sign == 0 && i < turns)
      continue;
    if (n == 0 || (sign != 0 && sign != motion[n - 1].sign))
      motion[n++].sign = sign;
    motion[n - 1].u = from = u;
    motion[n - 1].slope[0] = ed_path_u(&direction[0], at[i]);
    motion[n - 1].slope[1] = ed_path_u(&direction[1], at[i]);
  }
  return n;
}

#endif
