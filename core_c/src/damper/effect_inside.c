/* Effects inside a law that relaxes all of its forces, F + tau F' = everything. A force G there adds Q, Q + tau Q' = G. A factor phi
 * adds Q, Q + tau Q' = (phi - 1)(F + tau F'): with Q = (phi - 1) F + R the law's force is not differentiated, R + tau R' = -tau phi' F. */
#include "damper/effect.h"
#include "damper/relaxation.h"

#include <math.h>

/* What is left after h of q + tau q' = g, and the shares of g at the beginning and the end of the step, linear between, times h/tau. */
typedef struct {
  double decay, first, last;
} shares;

static shares shares_of(double h, double tau)
{
  const double none[3] = {0.0}, rate = 1.0 / tau, one = 1.0, each = 1.0 / h;
  double decay, gain[3], *const gains[3] = {&gain[0], &gain[1], &gain[2]};
  ed_relax(1, h, none, &rate, &each, &one, &decay, gains);
  return (shares){decay, gain[0] - gain[1], gain[1]};
}

enum { RELAXING, LAST }; /* what relaxes, and the last force, or factor less 1 */

void ed_effect_relaxed_factor(double tau, const ed_effect_value *found, double h, double law0, double law1, const double before[2],
                             double after[2], ed_effect_value *beside, double *by_law)
{
  const shares of = shares_of(h, tau);
  const double now = found->value - 1.0, change = now - before[LAST], mean = of.first * law0 + of.last * law1, left = law1 - mean;
  after[RELAXING] = of.decay * before[RELAXING] - change * mean;
  after[LAST] = now;
  beside->value += now * law1 + after[RELAXING];
  beside->by_u1 += found->by_u1 * left;
  beside->by_v1 += found->by_v1 * left;
  *by_law += now - change * of.last + found->by_law * left;
}

void ed_effect_relaxed_force(double tau, const ed_effect_value *found, double h, const double before[2], double after[2], ed_effect_value *beside)
{
  const shares of = shares_of(h, tau);
  const double time = h / tau, share = time * of.last;
  after[RELAXING] = of.decay * before[RELAXING] + time * of.first * before[LAST] + share * found->value;
  after[LAST] = found->value;
  beside->value += after[RELAXING];
  beside->by_u1 += share * found->by_u1;
  beside->by_v0 += share * found->by_v0;
  beside->by_v1 += share * found->by_v1;
  beside->chord += share * found->chord;
  beside->by_law += share * found->by_law;
  for (int j = 0; j < 2; j++)
    beside->by_path[j] += share * found->by_path[j];
}
