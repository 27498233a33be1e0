/* Law with asymptotes (Sause et al. 2009, Lee et al. 2009; thesis Eqs. 2.65-2.66), beside a dashpot c v.
 *
 * Asymptotes Fa = s f0 + P(u), P(u) = k1 u + k2 u|u| + k3 u^3, s the sign of the velocity. From the last reversal (u_r, F_r), with
 * e0 = Fa(u_r) - F_r, the force is at the distance e = e0 (1 + kappa (n - 1) (Fa - Fa_r)/e0)^(-1/(n-1)) from its asymptote, for
 * n = 1 e0 exp(-kappa (Fa - Fa_r)/e0); that solves dF = dFa (1 + kappa (e/e0)^n). The virgin state is a reversal at (0, 0).
 * In other words F = P(u) + w, |w| <= f0, where w alone is hysteretic: w goes from w_r towards s f0, the distance q = |s f0 - w_r|
 * shrinking with L = |P(u) - P(u_r)|. With s in e0 the law is odd. q = 0, on the asymptote already, leaves it there.
 *
 * Where the asymptote falls (P' < 0), the equation as printed drives the force away from it without bound. Here L is the way that
 * P has gone, the integral of |P'| |du|: the force always approaches its asymptote, and nothing changes where P rises.
 *
 * As published the law forgets all but the last reversal, however small: after any turn the tangent is (1 + kappa) P' again. So
 * a ripple on a rise keeps the force at w = kappa P, and unloading without ripple gives back more than was put in: small cycles
 * can create energy (up to 0.11 f0^2 / (kappa k1) for n = 1, from rest to f0 and back, P = k1 u). The dashpot does not make up
 * for it in slow motion. Memory: s, u_r, w_r, w. */
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>

enum { ED_LAW_ASYMPTOTE_PARAMETERS };
enum { SIGN, U_REVERSAL, W_REVERSAL, W, N_MEMORY };

/* The way of P from 0 to x > 0 is offset + sign P(x) up to each end, the last one infinite. */
typedef struct {
  double end[3], offset[3], sign[3];
} way;

static double polynomial(const double *p, double u, double *slope)
{
  const double x = fabs(u);
  *slope = p[K1] + x * (2.0 * p[K2] + x * 3.0 * p[K3]);
  return u * (p[K1] + x * (p[K2] + x * p[K3]));
}

static void find_way(const double *p, way *w)
{
  double root[2];
  int roots = 0, n = 0;
  const double discriminant = p[K2] * p[K2] - 3.0 * p[K1] * p[K3]; /* of k1 + 2 k2 x + 3 k3 x^2 */
  if (p[K3] == 0.0 && p[K2] != 0.0)
    root[roots++] = -0.5 * p[K1] / p[K2];
  else if (p[K3] != 0.0 && discriminant > 0.0) {
    const double q = -(p[K2] + copysign(sqrt(discriminant), p[K2]));
    const double one = q / (3.0 * p[K3]), other = p[K1] / q;
    root[0] = fmin(one, other);
    root[1] = fmax(one, other);
    roots = 2;
  }
  const double first = p[K1] != 0.0 ? p[K1] : p[K2] != 0.0 ? p[K2] : p[K3]; /* the sign of P' just above 0 */
  double sign = copysign(1.0, first), offset = 0.0, slope;
  for (int i = 0; i <= roots; i++) {
    if (i < roots && !(root[i] > 0.0))
      continue;
    w->end[n] = i < roots ? root[i] : HUGE_VAL;
    w->offset[n] = offset;
    w->sign[n++] = sign;
    if (i < roots)
      offset += 2.0 * sign * polynomial(p, root[i], &slope);
    sign = -sign;
  }
}

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  if (p[K1] == 0.0 && p[K2] == 0.0 && p[K3] == 0.0)
    return ed_refuse_parameter(message, "k1", p[K1], "k1, k2, k3 must not all be 0");
  damper->derived = malloc(sizeof(way));
  if (!damper->derived)
    return ED_E_MEMORY;
  damper->n_derived = sizeof(way) / sizeof(double);
  find_way(p, (way *)damper->derived);
  damper->n_memory = N_MEMORY;
  damper->rate_independent = p[C] == 0.0;
  return ED_OK;
}

/* Way of P from 0 to u, with the sign of u; slope: |P'|. */
static double way_to(const ed_damper *damper, double u, double *slope)
{
  const way *w = (const way *)damper->derived;
  const double x = fabs(u);
  int i = 0;
  while (x > w->end[i])
    i++;
  const double value = polynomial(damper->parameter, x, slope);
  *slope *= w->sign[i];
  return copysign(w->offset[i] + w->sign[i] * value, u);
}

/* w along the present branch at a motion's end, and its derivatives; those of the reversal are u_moves and w_moves. */
static double approach(const ed_damper *damper, const double *memory, const ed_motion *motion, const double u_moves[2],
                       const double w_moves[2], double slope[2])
{
  const double *p = damper->parameter;
  const double kappa = p[KAPPA], bend = p[N] - 1.0;
  const double s = memory[SIGN] != 0.0 ? memory[SIGN] : 1.0; /* at rest from the beginning either sign gives the same */
  const double distance = p[F0] - s * memory[W_REVERSAL];
  if (!(distance > 1e-15 * p[F0])) {
    slope[0] = slope[1] = 0.0;
    return s * p[F0];
  }
  double rise, rise_r;
  const double gone = s * (way_to(damper, motion->u, &rise) - way_to(damper, memory[U_REVERSAL], &rise_r));
  const double z = kappa * gone / distance, base = 1.0 + bend * z;
  const double fading = bend > 0.0 ? -log1p(bend * z) / bend : -z, share = exp(fading); /* e / e0 */
  const double by_way = kappa * share / base;                          /* kappa (e/e0)^n */
  const double by_reversal = share * (1.0 + z / base);
  for (int j = 0; j < 2; j++)
    slope[j] = by_way * (rise * motion->slope[j] - rise_r * u_moves[j]) + by_reversal * w_moves[j];
  return memory[W_REVERSAL] - s * distance * expm1(fading); /* f0 less the distance would be rounding alone where the way is short */
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion);
  double u_moves[2] = {0.0, 0.0}, w_moves[2] = {0.0, 0.0}, w_slope[2] = {0.0, 0.0}, slope;
  for (int i = 0; i < N_MEMORY; i++)
    trial[i] = committed[i];
  for (int i = 0; i < n; i++) {
    if (motion[i].sign != 0 && motion[i].sign != trial[SIGN]) {
      trial[SIGN] = motion[i].sign;
      trial[U_REVERSAL] = i > 0 ? motion[i - 1].u : path->c[0];
      trial[W_REVERSAL] = trial[W];
      for (int j = 0; j < 2; j++) {
        u_moves[j] = i > 0 ? motion[i - 1].slope[j] : 0.0;
        w_moves[j] = w_slope[j];
      }
    }
    trial[W] = approach(damper, trial, &motion[i], u_moves, w_moves, w_slope);
  }
  const ed_motion *end = &motion[n - 1];
  const double c = damper->parameter[C];
  out->force = polynomial(damper->parameter, end->u, &slope) + trial[W] + c * ed_path_v(path, path->h);
  for (int j = 0; j < 2; j++)
    out->slope[j] = slope * end->slope[j] + w_slope[j] + c * ed_path_v(&direction[j], path->h);
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_asymptote = {.name = "asymptote",
                             .prepare = prepare,
                             .step = step};
