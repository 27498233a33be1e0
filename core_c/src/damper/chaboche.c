/* Steel with combined hardening [Lemaitre & Chaboche 1990, 5.4]: F = k (u - p), |F - X| <= Fy + R, X the sum of backstresses with
 * X_i' = C_i p' - gamma_i X_i |p'| (Armstrong & Frederick), R = Q (1 - exp(-b s)) (Voce), s the path of the plastic deformation p.
 * Along a monotone motion each is a function of the plastic way alone, so that one equation for this way makes a step of any length exact.
 * Memory: p, s, X_1, X_2. */
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { ED_LAW_CHABOCHE_PARAMETERS };
enum { BACKSTRESSES = 2, PLASTIC = 0, PATH, FIRST, N_MEMORY = FIRST + BACKSTRESSES, MOST_TRIALS = 200 };
static const int MODULUS[BACKSTRESSES] = {C1, C2}, RECOVERY[BACKSTRESSES] = {GAMMA1, GAMMA2};

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  damper->n_memory = N_MEMORY;
  if (p[FY] + p[Q] <= 0.0)
    return ed_refuse_parameter(message, "Q", p[Q], "above -Fy: no strength is left below");
  if (p[Q] * p[B] <= -p[K])
    return ed_refuse_parameter(message, "b", p[B], "below k / -Q: the strength falls faster than the spring unloads");
  return ED_OK;
}

/* (1 - exp(-rate way)) / rate, the way where nothing recovers. */
static double grown(double rate, double way)
{
  return rate > 0.0 ? -expm1(-rate * way) / rate : way;
}

/* What strength and backstresses in a direction carry after a plastic way in it; hardening: by which that grows with the way. */
static double carried(const double *p, const double *memory, double side, double way, double *hardening)
{
  const double fallen = exp(-p[B] * (memory[PATH] + way));
  double force = p[FY] + p[Q] * (1.0 - fallen);
  *hardening = p[Q] * p[B] * fallen;
  for (int i = 0; i < BACKSTRESSES; i++) {
    const double modulus = p[MODULUS[i]], rate = p[RECOVERY[i]], from = side * memory[FIRST + i], steep = modulus - rate * from;
    force += from + steep * grown(rate, way);
    *hardening += steep * exp(-rate * way);
  }
  return force;
}

/* The plastic way after which the spring carries as much: trial - k way = carried. Newton's method between bounds, NAN: none was found. */
static double yielded(const double *p, const double *memory, double side, double trial)
{
  double hardening, way = 0.0, low = 0.0, high = (trial - carried(p, memory, side, 0.0, &hardening)) / (p[K] + fmin(p[Q] * p[B], 0.0));
  for (int i = 0; i < MOST_TRIALS; i++) {
    const double over = trial - p[K] * way - carried(p, memory, side, way, &hardening);
    *(over > 0.0 ? &low : &high) = way;
    double next = way + over / (p[K] + hardening);
    if (!(next > low && next < high)) /* or at an end that has been tried: rounding would send it to and fro */
      next = 0.5 * (low + high);
    if (fabs(next - way) <= 4.0 * DBL_EPSILON * fmax(next, trial / p[K]))
      return next;
    way = next;
  }
  return NAN;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *p = damper->parameter;
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  double by[2][N_MEMORY] = {{0.0}}; /* derivatives of the memory to the two unknowns */
  memcpy(trial, committed, N_MEMORY * sizeof *trial);
  for (int m = 0; m < n; m++) {
    const double spring = p[K] * (motion[m].u - trial[PLASTIC]), side = spring > trial[FIRST] + trial[FIRST + 1] ? 1.0 : -1.0;
    double hardening, before[N_MEMORY];
    out->force = spring;
    for (int j = 0; j < 2; j++)
      out->slope[j] = p[K] * (motion[m].slope[j] - by[j][PLASTIC]);
    if (side * spring <= carried(p, trial, side, 0.0, &hardening))
      continue;
    memcpy(before, trial, sizeof before);
    const double way = yielded(p, before, side, side * spring), ended = p[B] * exp(-p[B] * (before[PATH] + way));
    (void)carried(p, before, side, way, &hardening);
    trial[PLASTIC] += side * way;
    trial[PATH] += way;
    out->force = p[K] * (motion[m].u - trial[PLASTIC]);
    for (int i = 0; i < BACKSTRESSES; i++)
      trial[FIRST + i] += (side * p[MODULUS[i]] - p[RECOVERY[i]] * before[FIRST + i]) * grown(p[RECOVERY[i]], way);
    for (int j = 0; j < 2; j++) {
      double over = side * out->slope[j] - p[Q] * ended * by[j][PATH];
      for (int i = 0; i < BACKSTRESSES; i++)
        over -= side * by[j][FIRST + i] * exp(-p[RECOVERY[i]] * way);
      const double by_way = over / (p[K] + hardening);
      for (int i = 0; i < BACKSTRESSES; i++)
        by[j][FIRST + i] = by[j][FIRST + i] * exp(-p[RECOVERY[i]] * way) +
                           (side * p[MODULUS[i]] - p[RECOVERY[i]] * trial[FIRST + i]) * by_way;
      by[j][PLASTIC] += side * by_way;
      by[j][PATH] += by_way;
      out->slope[j] -= p[K] * side * by_way;
    }
  }
  return isfinite(out->force + trial[PLASTIC]) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_chaboche = {.name = "chaboche", .rate_independent = 1, .prepare = prepare, .step = step};
