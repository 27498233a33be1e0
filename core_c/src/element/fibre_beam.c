/* State determination of the force-based beam-column (Spacone, Ciampi & Filippou 1996; Neuenhofer & Filippou 1997).
 *
 * Given the basic deformations v, find section deformations e_p and basic forces q with
 *     s_p(e_p) = b_p q + sl_p        (equilibrium in every section, sl: element load)
 *     sum_p w_p b_p' e_p = v         (compatibility)
 * Newton on both at once, with e_p condensed out. After the first step compatibility holds exactly, and the iteration is
 * then Newton on the convex potential of the sections under linear constraints, so a line search on its slope makes it
 * converge from anywhere for laws without softening.
 */
#include "base/symmetric.h"
#include "element/element.h"

#include <math.h>
#include <string.h>

enum { MAX_ITERATIONS = 200, MAX_SEARCH = 40 };

/* A fully plastic section has no stiffness; for the direction of the next step (never for forces) it keeps this share of
 * the elastic one. */
static const double RESIDUAL_STIFFNESS = 1e-8;

/* b_p' f b_p with b = [1 0 0; 0 x-1 x], added with its weight to the flexibility. */
static inline void add_flexibility(double *F, const double *f, double x, double w)
{
  const double i = x - 1.0;
  F[0] += w * f[0];
  F[1] += w * f[1] * i;
  F[2] += w * f[1] * x;
  F[3] += w * f[2] * i * i;
  F[4] += w * f[2] * i * x;
  F[5] += w * f[2] * x * x;
}

static inline void section_flexibility(const ed_element *e, int p, const double *point, double *f)
{
  if (point[ED_POINT_ELASTIC] != 0.0) {
    memcpy(f, e->inverse[p], 3 * sizeof *f);
    return;
  }
  const ed_section *section = e->section[p];
  const double *k = point + ED_POINT_K;
  const double k11 = k[0] + RESIDUAL_STIFFNESS * section->k11;
  const double k12 = k[1] + RESIDUAL_STIFFNESS * section->k12;
  const double k22 = k[2] + RESIDUAL_STIFFNESS * section->k22;
  const double r = 1.0 / (k11 * k22 - k12 * k12);
  f[0] = k22 * r;
  f[1] = -k12 * r;
  f[2] = k11 * r;
}

static inline int invert_flexibility(const ed_element *e, const double *F, double *K)
{
  double reduced[6];
  memcpy(reduced, F, sizeof reduced);
  for (int end = 0; end < 2; end++)
    if (e->release[end])
      ed_sym3_release(reduced, end + 1, F[3]);
  if (!(ed_sym3_inverse(reduced, K) > 0.0))
    return 0;
  for (int end = 0; end < 2; end++)
    if (e->release[end])
      ed_sym3_release(K, end + 1, 0.0);
  return 1;
}

/* Moves a section by (de, dk); the return is 1 where its forces follow the tangent that far, so that its layers need not be asked. */
static inline int respond(const ed_element *e, int p, const double *layers, double *point, double de, double dk, int fast)
{
  const ed_section *section = e->section[p];
  point[0] += de;
  point[1] += dk;
  const double change = fabs(de) + section->depth * fabs(dk);
  if (fast && change <= point[ED_POINT_REACH]) {
    const double *k = point + ED_POINT_K;
    point[ED_POINT_S] += k[0] * de + k[1] * dk;
    point[ED_POINT_S + 1] += k[1] * de + k[2] * dk;
    point[ED_POINT_REACH] -= change;
    return 1;
  }
  /* a section that never yielded and provably does not yield now needs no layers */
  if (fast && point[ED_POINT_INELASTIC] == 0.0 &&
      fabs(point[0]) + section->depth * fabs(point[1]) < section->yield_strain) {
    point[ED_POINT_S] = section->k11 * point[0] + section->k12 * point[1];
    point[ED_POINT_S + 1] = section->k12 * point[0] + section->k22 * point[1];
    point[ED_POINT_K] = section->k11;
    point[ED_POINT_K + 1] = section->k12;
    point[ED_POINT_K + 2] = section->k22;
    point[ED_POINT_ELASTIC] = 1.0;
    point[ED_POINT_REACH] = 0.0;
    return 0;
  }
  ed_section_response r;
  ed_section_trial(section, layers + e->layer_offset[p], point[0], point[1], e->record[p], &r);
  point[ED_POINT_S] = r.N;
  point[ED_POINT_S + 1] = r.M;
  point[ED_POINT_K] = r.k11;
  point[ED_POINT_K + 1] = r.k12;
  point[ED_POINT_K + 2] = r.k22;
  point[ED_POINT_ELASTIC] = r.elastic;
  point[ED_POINT_REACH] = r.reach;
  return 0;
}

/* Slope of the potential of the sections along a step that keeps compatibility; q drops out but for rounding. */
static double slope_at(const ed_element *e, const double *points, const double *q, double (*step)[2])
{
  double slope = 0.0;
  for (int p = 0; p < e->points; p++) {
    const double *point = points + p * ED_POINT_SIZE;
    const double x = e->x[p];
    const double N = q[0] + e->section_load[p][0] - point[ED_POINT_S];
    const double M = (x - 1.0) * q[1] + x * q[2] + e->section_load[p][1] - point[ED_POINT_S + 1];
    slope -= e->weight[p] * (N * step[p][0] + M * step[p][1]);
  }
  return slope;
}

/* A member that never yielded and does not yield now is linear: closed form. Returns 0 when it does not apply. */
static int elastic_shortcut(const ed_element *e, const double *v, double *block)
{
  double relative[3], q[3];
  for (int i = 0; i < 3; i++)
    relative[i] = v[i] - e->free_deformation[i];
  ed_sym3_times(e->stiffness, relative, q);
  double deformation[ED_MAX_POINTS][2], force[ED_MAX_POINTS][2];
  for (int p = 0; p < e->points; p++) {
    const double x = e->x[p];
    const double N = q[0] + e->section_load[p][0];
    const double M = (x - 1.0) * q[1] + x * q[2] + e->section_load[p][1];
    const double *f = e->inverse[p];
    force[p][0] = N;
    force[p][1] = M;
    deformation[p][0] = f[0] * N + f[1] * M;
    deformation[p][1] = f[1] * N + f[2] * M;
    if (!(fabs(deformation[p][0]) + e->section[p]->depth * fabs(deformation[p][1]) < e->section[p]->yield_strain))
      return 0;
  }
  memcpy(block + ED_BLOCK_V, v, 3 * sizeof *v);
  memcpy(block + ED_BLOCK_Q, q, sizeof q);
  memcpy(block + ED_BLOCK_K, e->stiffness, 6 * sizeof(double));
  for (int p = 0; p < e->points; p++) {
    double *point = block + ED_BLOCK_POINTS + p * ED_POINT_SIZE;
    memcpy(point + ED_POINT_E, deformation[p], sizeof deformation[p]);
    memcpy(point + ED_POINT_S, force[p], sizeof force[p]);
    point[ED_POINT_K] = e->section[p]->k11;
    point[ED_POINT_K + 1] = e->section[p]->k12;
    point[ED_POINT_K + 2] = e->section[p]->k22;
    point[ED_POINT_ELASTIC] = 1.0;
    point[ED_POINT_REACH] = 0.0;
  }
  return 1;
}

int ed_fibre_beam_update(const ed_element *e, const double *v, const double *layers, double *block,
                         ed_element_control *control)
{
  control->updates++;
  if (control->fast_elastic && block[ED_BLOCK_INELASTIC] == 0.0 && elastic_shortcut(e, v, block)) {
    control->elastic++;
    return ED_OK;
  }
  double *q = block + ED_BLOCK_Q, *K = block + ED_BLOCK_K, *points = block + ED_BLOCK_POINTS;
  double f[ED_MAX_POINTS][3], unbalance[ED_MAX_POINTS][2], step[ED_MAX_POINTS][2];
  memcpy(block + ED_BLOCK_V, v, 3 * sizeof *v);
  int linear = 1; /* K is that of the sections as they are */

  for (int iteration = 0;; iteration++) {
    double F[6] = {0};
    double gap[3] = {v[0], v[1], v[2]};  /* of compatibility at present: rounding, after the first iteration */
    double missing[3];                   /* after the sections have followed their unbalance */
    double correction[3] = {0};
    double energy = 0.0, level = 0.0;
    int elastic = 1;
    for (int p = 0; p < e->points; p++)
      elastic &= points[p * ED_POINT_SIZE + ED_POINT_ELASTIC] != 0.0;
    for (int p = 0; p < e->points; p++) {
      double *point = points + p * ED_POINT_SIZE;
      const double x = e->x[p], w = e->weight[p];
      const double N = q[0] + e->section_load[p][0];
      const double M = (x - 1.0) * q[1] + x * q[2] + e->section_load[p][1];
      section_flexibility(e, p, point, f[p]);
      unbalance[p][0] = N - point[ED_POINT_S];
      unbalance[p][1] = M - point[ED_POINT_S + 1];
      const double de = f[p][0] * unbalance[p][0] + f[p][1] * unbalance[p][1];
      const double dk = f[p][1] * unbalance[p][0] + f[p][2] * unbalance[p][1];
      gap[0] -= w * point[0];
      gap[1] -= (x - 1.0) * w * point[1];
      gap[2] -= x * w * point[1];
      correction[0] += w * de;
      correction[1] += (x - 1.0) * w * dk;
      correction[2] += x * w * dk;
      if (!linear && !elastic)
        add_flexibility(F, f[p], x, w);
      /* measured with the elastic flexibility: the softened one would magnify rounding */
      const double *f0 = e->inverse[p];
      energy += w * (f0[0] * unbalance[p][0] * unbalance[p][0] + 2.0 * f0[1] * unbalance[p][0] * unbalance[p][1] +
                     f0[2] * unbalance[p][1] * unbalance[p][1]);
      level += w * (f0[0] * N * N + 2.0 * f0[1] * N * M + f0[2] * M * M);
    }
    double gap_force[3];
    ed_sym3_times(e->stiffness, gap, gap_force);
    for (int i = 0; i < 3; i++) {
      missing[i] = gap[i] - correction[i];
      energy += gap[i] * gap_force[i];
    }
    if (!isfinite(energy))
      return ED_E_NOT_FINITE;
    if (level < block[ED_BLOCK_REFERENCE])
      level = block[ED_BLOCK_REFERENCE];
    if (!linear) {
      if (elastic)
        memcpy(K, e->stiffness, sizeof e->stiffness);
      else if (!invert_flexibility(e, F, K))
        return ED_E_ELEMENT;
    }
    if (iteration > 0 && energy <= control->tolerance * level) {
      block[ED_BLOCK_REFERENCE] = level;
      return ED_OK;
    }
    if (iteration == MAX_ITERATIONS)
      return ED_E_ELEMENT;
    control->iterations++;

    double dq[3], slope = 0.0;
    linear = 1;
    ed_sym3_times(K, missing, dq);
    for (int i = 0; i < 3; i++)
      q[i] += dq[i];
    for (int p = 0; p < e->points; p++) {
      double *point = points + p * ED_POINT_SIZE;
      const double x = e->x[p];
      const double N = unbalance[p][0] + dq[0];
      const double M = unbalance[p][1] + (x - 1.0) * dq[1] + x * dq[2];
      step[p][0] = f[p][0] * N + f[p][1] * M;
      step[p][1] = f[p][1] * N + f[p][2] * M;
      slope -= e->weight[p] * (unbalance[p][0] * step[p][0] + unbalance[p][1] * step[p][1]);
      linear &= respond(e, p, layers, point, step[p][0], step[p][1], control->fast_elastic);
    }
    if (iteration == 0)
      continue;
    /* slope of the potential along the step: negative at its start, rising; near zero where to stop */
    double taken = 1.0, low = 0.0, at_low = slope, high = 1.0, at_high = 0.0;
    for (int search = 0; search < MAX_SEARCH && slope < 0.0; search++) {
      const double end = slope_at(e, points, q, step);
      if (fabs(end) <= 0.5 * -slope || (taken == 1.0 && end <= 0.0))
        break;
      if (end > 0.0) {
        high = taken;
        at_high = end;
      } else {
        low = taken;
        at_low = end;
      }
      const double width = high - low, secant = low + width * at_low / (at_low - at_high);
      const double next = fmin(fmax(secant, low + 0.1 * width), high - 0.1 * width);
      for (int p = 0; p < e->points; p++) {
        double *point = points + p * ED_POINT_SIZE;
        linear &= respond(e, p, layers, point, (next - taken) * step[p][0], (next - taken) * step[p][1], control->fast_elastic);
      }
      taken = next;
    }
  }
}
