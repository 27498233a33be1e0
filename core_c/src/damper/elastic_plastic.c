/* Elastic-plastic device with kinematic hardening: F = k (u - p), |F - b k u| <= (1 - b) Fy, return mapping of the plastic
 * deformation p. Along a monotone motion that is exact in one step. Coulomb friction in series with the stiffness of its
 * connection is the same without hardening; a lead-rubber bearing the same by its characteristic strength. Memory: p. */
#include "damper/circular.h"
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>

enum { STIFFNESS, HARDENING, LIMIT, N_DERIVED }; /* k, b k, (1 - b) Fy */

static int derive(ed_damper *damper, double k, double yield, double ratio)
{
  damper->n_memory = 1;
  damper->derived = malloc(N_DERIVED * sizeof *damper->derived);
  if (!damper->derived)
    return ED_E_MEMORY;
  damper->n_derived = N_DERIVED;
  damper->derived[STIFFNESS] = k;
  damper->derived[HARDENING] = ratio * k;
  damper->derived[LIMIT] = (1.0 - ratio) * yield;
  return ED_OK;
}

static int prepare_friction(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_FRICTION_PARAMETERS };
  const double *p = damper->parameter;
  (void)message;
  return derive(damper, p[K], p[MU] * p[N], 0.0);
}

static int prepare_elastic_plastic(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_ELASTIC_PLASTIC_PARAMETERS };
  const double *p = damper->parameter;
  (void)message;
  return derive(damper, p[K], p[FY], p[B]);
}

/* Characteristic strength Q, stiffness K_d after yielding, yield deformation Y. */
static int prepare_lead_rubber(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_LEAD_RUBBER_PARAMETERS };
  const double *p = damper->parameter;
  (void)message;
  const double yield = p[Q] + p[K_D] * p[Y];
  return derive(damper, yield / p[Y], yield, p[K_D] * p[Y] / yield);
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double k = damper->derived[STIFFNESS], hardening = damper->derived[HARDENING], limit = damper->derived[LIMIT];
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  double plastic = committed[0], plastic_slope[2] = {0.0, 0.0};
  for (int i = 0; i < n; i++) {
    const double u = motion[i].u, force = k * (u - plastic), beyond = force - hardening * u;
    const int yields = fabs(beyond) > limit;
    out->force = yields ? hardening * u + copysign(limit, beyond) : force;
    if (yields)
      plastic = u - out->force / k;
    for (int j = 0; j < 2; j++) {
      out->slope[j] = yields ? hardening * motion[i].slope[j] : k * (motion[i].slope[j] - plastic_slope[j]);
      if (yields)
        plastic_slope[j] = motion[i].slope[j] - out->slope[j] / k;
    }
  }
  trial[0] = plastic;
  return isfinite(out->force + plastic) ? ED_OK : ED_E_NOT_FINITE;
}

/* In two directions: the linear hardening is isotropic, and what is beyond it lies within a circle. Memory: that part of the force. */
static int step_pair(const ed_damper *damper, const double *const committed[2], const ed_path path[2], const ed_path direction[2],
                     double *const trial[2], ed_pair_force *out)
{
  const double hardening = damper->derived[HARDENING];
  const ed_circle circle = {.stiffness = damper->derived[STIFFNESS] - hardening, .limit = damper->derived[LIMIT]};
  return ed_circle_beside_spring(&circle, hardening, committed, path, direction, trial, out);
}

const ed_law ed_friction = {.name = "friction",
                            .rate_independent = 1,
                            .prepare = prepare_friction,
                            .step = step,
                            .step_pair = step_pair};
const ed_law ed_elastic_plastic = {.name = "elastic_plastic",
                                   .rate_independent = 1,
                                   .prepare = prepare_elastic_plastic,
                                   .step = step,
                                   .step_pair = step_pair};
const ed_law ed_lead_rubber = {.name = "lead_rubber",
                               .rate_independent = 1,
                               .prepare = prepare_lead_rubber,
                               .step = step,
                               .step_pair = step_pair};
