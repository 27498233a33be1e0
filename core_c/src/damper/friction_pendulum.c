/* Friction pendulum bearing under a constant weight (Zayas, Low & Mahin 1990; Constantinou, Mokha & Reinhorn 1990):
 *
 *   F = W/R u + Q,  |Q| <= mu W,  mu = f_fast - (f_fast - f_slow) exp(-a |v|),
 *
 * where Q rises with mu(0) W / Y before it slips. Return mapping of the slip p at the turns of the path, where v = 0, and at its end. In
 * slip that is exact; where mu falls between them more than at both, the step is too long anyway. Memory: p. */
#include "damper/circular.h"
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>

enum { ED_LAW_FRICTION_PENDULUM_PARAMETERS };

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  if (!(p[F_FAST] >= p[F_SLOW]))
    return ed_refuse_parameter(message, "f_fast", p[F_FAST], "at least f_slow");
  damper->n_memory = 1;
  damper->rate_independent = p[A] == 0.0 || p[F_FAST] == p[F_SLOW];
  return ED_OK;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *parameter = damper->parameter, weight = parameter[W];
  const double pendulum = weight / parameter[R], k = parameter[F_SLOW] * weight / parameter[Y];
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  double slip = committed[0], slip_slope[2] = {0.0, 0.0};
  for (int i = 0; i < n; i++) {
    const int last = i == n - 1;
    const double v = last ? ed_path_v(path, path->h) : 0.0;
    const double fading = (parameter[F_FAST] - parameter[F_SLOW]) * exp(-parameter[A] * fabs(v));
    const double limit = (parameter[F_FAST] - fading) * weight, stuck = k * (motion[i].u - slip);
    const int slips = fabs(stuck) > limit;
    const double friction = slips ? copysign(limit, stuck) : stuck;
    const double by_speed = last ? copysign(parameter[A] * fading * weight, stuck * v) : 0.0;
    if (slips)
      slip = motion[i].u - friction / k;
    out->force = pendulum * motion[i].u + friction;
    for (int j = 0; j < 2; j++) {
      const double moves = slips ? by_speed * ed_path_v(&direction[j], path->h) : k * (motion[i].slope[j] - slip_slope[j]);
      if (slips)
        slip_slope[j] = motion[i].slope[j] - moves / k;
      out->slope[j] = pendulum * motion[i].slope[j] + moves;
    }
  }
  trial[0] = slip;
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

/* In two directions: a pendulum in both, friction within a circle. Memory: the friction. */
static int step_pair(const ed_damper *damper, const double *const committed[2], const ed_path path[2], const ed_path direction[2],
                     double *const trial[2], ed_pair_force *out)
{
  const double *p = damper->parameter;
  const ed_circle circle = {.stiffness = p[F_SLOW] * p[W] / p[Y],
                            .limit = p[F_FAST] * p[W],
                            .fading = (p[F_FAST] - p[F_SLOW]) * p[W],
                            .rate = p[A]};
  return ed_circle_beside_spring(&circle, p[W] / p[R], committed, path, direction, trial, out);
}

const ed_law ed_friction_pendulum = {.name = "friction_pendulum",
                                     .rate_independent = 1,
                                     .prepare = prepare,
                                     .step = step,
                                     .step_pair = step_pair};
