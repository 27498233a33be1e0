/* Buckling-restrained brace by its manufacturer's values: F = K (u - p), K = KF E A_sc / L_wp, and
 *
 *   -(Fy + R_C(s)) <= F - H p <= Fy + R_T(s),  Fy = F_ysc A_sc,  H = alpha K / (1 - alpha),
 *
 * p the plastic deformation and s the sum of its sizes so far. R_T and R_C, the isotropic hardening under tension and
 * compression, are linear between points and constant beyond the last. They are those with which the protocol of AISC 341-16,
 * K3.4, two cycles each at 1/4, 1/2, 3/4 and all of the largest strain that the manufacturer gives, in tension first, reaches
 * omega Fy and beta omega Fy in its second cycle at each strain: the forces given, linear in the strain between them and from
 * Fy at first yielding. Hardening never falls, so that the return mapping has one solution, exact along a monotone motion in
 * one step. Memory: p, s. */
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ED_LAW_BUCKLING_RESTRAINED_PARAMETERS, ROWS };
enum { ED_LAW_BUCKLING_RESTRAINED_BRANCH, ROW };
enum { TENSION, COMPRESSION, SIDES };
enum { PLASTIC, PATH, N_MEMORY };
enum { STEPS = 4, CYCLES = 2 }; /* of the protocol */

/* Hardening of a side: points (s, R), s ascending; linear from (0, 0) to the first, constant after the last. */
typedef struct {
  double path[STEPS], force[STEPS];
} hardening;

typedef struct {
  double stiffness, yield, kinematic; /* K, Fy, H */
  int points;
  hardening side[SIDES];
} brace;

_Static_assert(sizeof(brace) % sizeof(double) == 0, "kept as the derived constants of a damper");

/* R at s, the slope of its segment, and where that ends (infinite after the last). */
static double hardened(const hardening *of, int points, double s, double *slope, double *end)
{
  double before = 0.0, at = 0.0;
  for (int i = 0; i < points; i++) {
    if (s < of->path[i]) {
      *slope = (of->force[i] - before) / (of->path[i] - at);
      *end = of->path[i];
      return before + *slope * (s - at);
    }
    before = of->force[i];
    at = of->path[i];
  }
  *slope = 0.0;
  *end = INFINITY;
  return before;
}

/* State of the flow and its derivatives to the two unknowns of a path. */
typedef struct {
  double plastic, path;
  double plastic_slope[2], path_slope[2];
} flow;

/* Moves the flow by a monotone motion to u; the force there, `slope` its derivatives. stiffness: of the spring in series with the flow. */
static double follow(const brace *of, double stiffness, double u, const double u_slope[2], flow *now, double slope[2])
{
  const double elastic = stiffness * (u - now->plastic), beyond = elastic - of->kinematic * now->plastic;
  const double sign = copysign(1.0, beyond);
  const hardening *side = &of->side[beyond > 0.0 ? TENSION : COMPRESSION];
  double rise, end, limit = of->yield + hardened(side, of->points, now->path, &rise, &end);
  double excess = fabs(beyond) - limit;
  if (!(excess > 0.0)) {
    for (int j = 0; j < 2; j++)
      slope[j] = stiffness * (u_slope[j] - now->plastic_slope[j]);
    return elastic;
  }
  double total = stiffness + of->kinematic + rise, plastic = now->plastic, path = now->path;
  double plastic_slope[2], path_slope[2];
  for (int j = 0; j < 2; j++) {
    plastic_slope[j] = now->plastic_slope[j];
    path_slope[j] = now->path_slope[j];
  }
  while (excess > total * (end - path)) { /* over the end of a segment */
    const double way = end - path;
    excess -= total * way;
    plastic += sign * way;
    for (int j = 0; j < 2; j++) { /* to a fixed path */
      plastic_slope[j] -= sign * path_slope[j];
      path_slope[j] = 0.0;
    }
    path = end;
    (void)hardened(side, of->points, path, &rise, &end);
    total = stiffness + of->kinematic + rise;
  }
  const double way = excess / total;
  for (int j = 0; j < 2; j++) {
    const double grows = sign * (stiffness * u_slope[j] - (stiffness + of->kinematic) * plastic_slope[j]) - rise * path_slope[j];
    plastic_slope[j] += sign * grows / total;
    path_slope[j] += grows / total;
    now->plastic_slope[j] = plastic_slope[j];
    now->path_slope[j] = path_slope[j];
    slope[j] = stiffness * (u_slope[j] - plastic_slope[j]);
  }
  now->plastic = plastic + sign * way;
  now->path = path + way;
  return stiffness * (u - now->plastic);
}

/* Strain of a step of the protocol. */
static double strain_of(const double *p, int rows, int step)
{
  return p[ROWS + ROW * (rows - 1) + STRAIN] * (step + 1) / STEPS;
}

/* What a side reaches at a strain beyond that of yielding, and the plastic deformation there. */
static double reached(const double *p, int rows, int side, double strain, double *plastic)
{
  double from = p[F_YSC] / p[E], before = 1.0, factor = 1.0;
  for (int i = 0; i < rows; i++) {
    const double *row = p + ROWS + ROW * i;
    const double there = row[OMEGA] * (side == COMPRESSION ? row[BETA] : 1.0);
    if (strain <= row[STRAIN] || i == rows - 1) {
      factor = before + (there - before) * (strain - from) / (row[STRAIN] - from);
      break;
    }
    from = row[STRAIN];
    before = there;
  }
  *plastic = p[L_Y] * (strain - factor * p[F_YSC] / p[E]);
  return factor * p[F_YSC] * p[A_SC];
}

/* Goes through the protocol and notes the plastic path at the peaks of the second cycle at each strain. The core alone is a spring
 * E A_sc / L_y in series with the flow. The largest change of a path noted, relative. */
static double protocol(brace *of, const double *p, int rows)
{
  flow now = {0};
  const double none[2] = {0.0, 0.0};
  double ignored[2], path[SIDES][STEPS], change = 0.0;
  for (int i = STEPS - of->points; i < STEPS; i++)
    for (int cycle = 0; cycle < CYCLES; cycle++)
      for (int side = 0; side < SIDES; side++) {
        const double u = (side == TENSION ? 1.0 : -1.0) * strain_of(p, rows, i) * p[L_Y];
        (void)follow(of, p[E] * p[A_SC] / p[L_Y], u, none, &now, ignored);
        path[side][i - (STEPS - of->points)] = now.path;
      }
  for (int side = 0; side < SIDES; side++)
    for (int i = 0; i < of->points; i++) {
      change = fmax(change, fabs(path[side][i] - of->side[side].path[i]) / path[side][i]);
      of->side[side].path[i] = path[side][i];
    }
  return change;
}

/* Finds the places of the hardening: they set the plastic path of the protocol, and follow from it. Forces at peaks hardly change the
 * path, so that each round gains about three digits. */
static int place(brace *of, const double *p, int rows)
{
  enum { ROUNDS = 60 };
  for (int side = 0; side < SIDES; side++)
    for (int i = 0; i < of->points; i++) /* any to begin with */
      of->side[side].path[i] = strain_of(p, rows, i) * p[L_Y] * 4.0 * CYCLES * STEPS;
  for (int round = 0; round < ROUNDS; round++)
    if (protocol(of, p, rows) <= 1e-13)
      return 1;
  return 0;
}

static int check(const double *p, int rows, char message[ED_DAMPER_MESSAGE])
{
  char allowed[ED_DAMPER_MESSAGE / 2];
  if (p[L_Y] > p[L_WP]) {
    snprintf(allowed, sizeof allowed, "at most L_wp = %g", p[L_WP]);
    return ed_refuse_parameter(message, "L_y", p[L_Y], allowed);
  }
  if (!(p[KF] <= p[L_WP] / p[L_Y] * (1.0 + 1e-9))) { /* rounding of who writes the quotient */
    snprintf(allowed, sizeof allowed, "1 (core all along) to L_wp / L_y = %g (rigid beside it)", p[L_WP] / p[L_Y]);
    return ed_refuse_parameter(message, "KF", p[KF], allowed);
  }
  double before[SIDES] = {1.0, 1.0}, from = p[F_YSC] / p[E];
  for (int i = 0; i < rows; i++) {
    const double *row = p + ROWS + ROW * i;
    char of[24];
    snprintf(of, sizeof of, "strain%d", i + 1);
    const double elastic = row[OMEGA] * row[BETA] * p[F_YSC] / p[E];
    if (i > 0 && !(row[STRAIN] > from))
      return ed_refuse_parameter(message, of, row[STRAIN], "greater than the one before: strains ascend");
    if (!(row[STRAIN] > elastic)) {
      snprintf(allowed, sizeof allowed, "greater than that of an elastic core, beta omega F_ysc / E = %g", elastic);
      return ed_refuse_parameter(message, of, row[STRAIN], allowed);
    }
    for (int side = 0; side < SIDES; side++) {
      const double there = row[OMEGA] * (side == COMPRESSION ? row[BETA] : 1.0);
      snprintf(of, sizeof of, "%s%d", side == TENSION ? "omega" : "beta", i + 1);
      if (there < before[side]) { /* R_T and R_C only grow */
        if (side == TENSION)
          snprintf(allowed, sizeof allowed, "at least omega%d = %g: omega does not fall with the strain", i, before[side]);
        else
          snprintf(allowed, sizeof allowed, "at least %g: beta omega does not fall with the strain", before[side] / row[OMEGA]);
        return ed_refuse_parameter(message, of, row[OMEGA + side], allowed);
      }
      if (!((there - before[side]) * p[F_YSC] / p[E] < row[STRAIN] - from))
        return ed_refuse_parameter(message, of, row[OMEGA + side],
                                   "from the point before, the force would rise faster with the strain than an elastic core");
      before[side] = there;
    }
    from = row[STRAIN];
  }
  return ED_OK;
}

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  const int rows = (damper->n_parameters - ROWS) / ROW;
  const int status = check(p, rows, message);
  if (status != ED_OK)
    return status;
  brace of = {.stiffness = p[KF] * p[E] * p[A_SC] / p[L_WP], .yield = p[F_YSC] * p[A_SC]};
  of.kinematic = p[ALPHA] * of.stiffness / (1.0 - p[ALPHA]);
  while (of.points < STEPS && strain_of(p, rows, STEPS - 1 - of.points) > p[F_YSC] / p[E])
    of.points++;
  for (int side = 0; side < SIDES; side++) {
    double before = 0.0, plastic_before = 0.0, force_before = of.yield;
    for (int i = 0; i < of.points; i++) {
      double plastic;
      const double strain = strain_of(p, rows, STEPS - of.points + i), force = reached(p, rows, side, strain, &plastic);
      const double isotropic = force - of.yield - of.kinematic * plastic;
      if (isotropic < before - 1e-12 * of.yield) { /* beyond the rounding of who computed the largest alpha */
        const double most = (force - force_before) / (plastic - plastic_before);
        char allowed[ED_DAMPER_MESSAGE / 2];
        snprintf(allowed, sizeof allowed, "at most %.4g, or kinematic hardening alone exceeds %s at a strain of %g %%",
                 fmax(0.0, most / (of.stiffness + most)), side == TENSION ? "omega" : "beta omega", 100.0 * strain);
        return ed_refuse_parameter(message, "alpha", p[ALPHA], allowed);
      }
      of.side[side].force[i] = before = fmax(before, isotropic);
      plastic_before = plastic;
      force_before = force;
    }
  }
  if (!place(&of, p, rows)) {
    snprintf(message, ED_DAMPER_MESSAGE, "law buckling_restrained: no hardening was found that reaches omega and beta");
    return ED_E_NOT_CONVERGED;
  }
  damper->n_memory = N_MEMORY;
  damper->derived = malloc(sizeof of);
  if (!damper->derived)
    return ED_E_MEMORY;
  damper->n_derived = (int)(sizeof of / sizeof(double));
  memcpy(damper->derived, &of, sizeof of);
  return ED_OK;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  brace of;
  memcpy(&of, damper->derived, sizeof of);
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  flow now = {.plastic = committed[PLASTIC], .path = committed[PATH]};
  for (int i = 0; i < n; i++)
    out->force = follow(&of, of.stiffness, motion[i].u, motion[i].slope, &now, out->slope);
  trial[PLASTIC] = now.plastic;
  trial[PATH] = now.path;
  return isfinite(out->force + now.path) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_buckling_restrained = {.name = "buckling_restrained",
                                       .rate_independent = 1,
                                       .plastic_path = PATH + 1,
                                       .prepare = prepare,
                                       .step = step};
