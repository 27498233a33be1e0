/* A force c |v|^alpha sgn v that reaches the outside through a relaxation of time tau. */
#ifndef ED_POWER_INTEGRAL_H
#define ED_POWER_INTEGRAL_H

#include "damper/path.h"
#include "edcore.h"

enum { ED_POWER_FEW = 3, ED_POWER_MANY = 5 };

typedef struct {
  double alpha, tau;
  double rest;                                          /* speed at which the power is rounded */
  double few[ED_POWER_FEW], few_weight[ED_POWER_FEW];   /* Gauss rules on [0, 1] */
  double many[ED_POWER_MANY], many_weight[ED_POWER_MANY];
  double turn[ED_POWER_MANY], turn_weight[ED_POWER_MANY]; /* for the weight t^(alpha - 1): from or to a reversal */
} ed_power_rule;

/* alpha > 0, tau > 0. For alpha < 1 the power is rounded at rest to v (v^2 + rest^2)^((alpha - 1)/2), rest > 0: its slope is finite,
 * and a motion that dies out, which a power below 1 stops in finite time, does not end in the rounding of the velocity. */
void ed_power_rule_prepare(ed_power_rule *rule, double alpha, double tau, double rest);

/* 1/tau integral over the path of exp(-(h - s)/tau) |v|^alpha sgn v, its derivatives along two directions, and what these were with
 * the chord of the power instead of its tangent (direction NULL: not wanted, slope and chord are left as they are). Paths of up to
 * some 40 tau. Not a number where the path is not finite. */
double ed_power_integral(const ed_power_rule *rule, const ed_path *path, const ed_path *direction, double slope[2],
                         double chord[2]);

/* The rounded power at one velocity. */
double ed_power_now(const ed_power_rule *rule, double v, double *slope);

#endif
