/* Modified generalised Maxwell model (thesis Eqs. 4.23 to 4.29):
 *
 *   F + tau F' = (k0 + k_mod) u + (tau k0 + c1 + c_mod) v + c_NL |v|^alpha sgn v,  tau = c1/k1,
 *
 * as printed. Carrying the derivative of k_mod u as that of k0 u (consistent = 1) adds tau d(k_mod u)/dt on the right. With
 *
 *   F = k0 u + Q           and Q + tau Q' = k_mod u + (c1 + c_mod) v + c_NL |v|^alpha sgn v   as printed,
 *   F = (k0 + k_mod) u + Q and Q + tau Q' = (c1 + c_mod) v + c_NL |v|^alpha sgn v             when consistent,
 *
 * the right-hand side G of Q depends on the path alone, so that Q follows by quadrature: Q(h) = Q(0) exp(-h/tau) + 1/tau integral
 * of exp(-(h - s)/tau) G(s) ds. State: Q, largest and smallest deformation, largest and smallest velocity,
 * k_mod and c_mod for these. */
#include "damper/laws.h"
#include "damper/mgmm_terms.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of what happened so many relaxation times ago nothing is left in double precision. */
static const double FORGOTTEN = 40.0;
/* Share of a step below which a relaxation time is none: a part of the step that is so short lies in its rounding. */
static const double INSTANT = 1e-13;
/* Share of v_ref at which the power of the non-linear dashpot, whose slope at rest is infinite for alpha < 1, is rounded. */
static const double REST = 1e-7;

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_MGMM_PARAMETERS };
  const double *p = damper->parameter, tau = p[C1] / p[K1];
  if (!(tau > 0.0) || !isfinite(tau))
    return ed_refuse_parameter(message, "c1/k1", tau, "a finite time greater than 0");
  ed_mgmm_constants *law = malloc(sizeof *law);
  if (!law)
    return ED_E_MEMORY;
  *law = (ed_mgmm_constants){.tau = tau, .k0 = p[K0], .c1 = p[C1], .c_nl = p[C_NL], .alpha = p[ALPHA],
                             .relaxing = 1.0 - p[CONSISTENT], .k_mod = {p[K_A], p[K_B], p[U_REF]},
                             .c_mod = {p[C_A], p[C_B], p[V_REF]}};
  ed_power_rule_prepare(&law->power, p[ALPHA], tau, REST * p[V_REF]);
  damper->derived = (double *)(void *)law;
  damper->n_derived = (int)(sizeof *law / sizeof(double));
  damper->n_ode = 1;
  damper->n_memory = ED_MGMM_MEMORY;
  damper->diagonal_ode = 1;
  return ED_OK;
}

/* What the chord of the power has more than its tangent, if it has: where the power is below 1. */
static double softer(const ed_mgmm_constants *law, double slope, double chord)
{
  return law->alpha < 1.0 ? law->c_nl * (chord - slope) : 0.0;
}

/* 1/tau integral over a step of exp(-(h - s)/tau) (s/h)^m for m = 0..3, time = h/tau. From one to the next by parts, in the way in
 * which errors die out; over short steps the last one by its series, 3! time sum of (-time)^k / (k + 4)!. */
static void moments(double time, double moment[4])
{
  static const double SHORT = 0.3; /* the first term left out is 1e-16 of the first */
  if (time >= SHORT) {
    moment[0] = -expm1(-time);
    for (int m = 1; m < 4; m++)
      moment[m] = 1.0 - m / time * moment[m - 1];
    return;
  }
  const double t2 = time * time, t4 = t2 * t2, t8 = t4 * t4;
  const double low = 1.0 / 4.0 - time * (1.0 / 20.0) + t2 * (1.0 / 120.0 - time * (1.0 / 840.0));
  const double high = 1.0 / 6720.0 - time * (1.0 / 60480.0) + t2 * (1.0 / 604800.0 - time * (1.0 / 6652800.0));
  moment[3] = time * (low + t4 * high + t8 * (1.0 / 79833600.0 - time * (1.0 / 1037836800.0)));
  moment[2] = time * (1.0 - moment[3]) * (1.0 / 3.0);
  moment[1] = time * (1.0 - moment[2]) * 0.5;
  moment[0] = time * (1.0 - moment[1]);
}

/* The same integral of stiffness u + damping v. */
static double relaxed(const ed_path *path, const double moment[4], double stiffness, double damping)
{
  const double h = path->h, *c = path->c;
  const double u = c[0] * moment[0] + h * (c[1] * moment[1] + h * (c[2] * moment[2] + h * c[3] * moment[3]));
  const double v = c[1] * moment[0] + h * (2.0 * c[2] * moment[1] + h * 3.0 * c[3] * moment[2]);
  return stiffness * u + damping * v;
}

/* The integral of the power over the end of a step that is not forgotten. */
static double power_integral(const ed_mgmm_constants *law, const ed_path *path, const ed_path *direction, double slope[2], double chord[2])
{
  const double h = path->h, length = FORGOTTEN * law->tau;
  if (h <= length)
    return ed_power_integral(&law->power, path, direction, slope, chord);
  ed_path late, late_direction[2];
  ed_path_piece(path, h - length, h, &late);
  late.h = length;
  for (int j = 0; direction && j < 2; j++)
    ed_path_piece(&direction[j], h - length, h, &late_direction[j]);
  return ed_power_integral(&law->power, &late, direction ? late_direction : NULL, slope, chord);
}

/* A step over which both moduli are constant. */
static int still_step(const ed_mgmm_constants *law, const double *committed, const ed_path *path, const ed_path direction[2], int wanted,
                      double *trial, ed_damper_force *out)
{
  const double *memory = committed + 1;
  const double h = path->h, k = memory[ED_K_MOD];
  const double stiffness = law->relaxing * k, spring = law->k0 + (1.0 - law->relaxing) * k;
  const double damping = law->c1 + memory[ED_C_MOD];
  double moment[4], slope[2] = {0.0}, chord[2] = {0.0};
  moments(h / law->tau, moment);
  double relaxing = committed[0] * (1.0 - moment[0]) + relaxed(path, moment, stiffness, damping);
  if (law->c_nl > 0.0)
    relaxing += law->c_nl * power_integral(law, path, wanted ? direction : NULL, slope, chord);
  trial[0] = relaxing;
  memcpy(trial + 1, memory, ED_MGMM_MEMORY * sizeof *trial);
  out->force = spring * ed_path_u(path, h) + relaxing;
  for (int j = 0; j < 2; j++) {
    out->slope[j] = law->c_nl * slope[j];
    if (wanted)
      out->slope[j] += spring * ed_path_u(&direction[j], h) + relaxed(&direction[j], moment, stiffness, damping);
    out->chord[j] = softer(law, slope[j], chord[j]);
  }
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

/* What is remembered after a path. */
static void remember_path(const ed_mgmm_constants *law, const double *memory, const ed_path *path, double *after)
{
  ed_path velocity;
  ed_path_of_velocity(path, &velocity);
  const ed_running of_u = ed_extremes_along(ed_mgmm_extremes(memory, ED_LARGEST_U), path);
  const ed_running of_v = ed_extremes_along(ed_mgmm_extremes(memory, ED_LARGEST_V), &velocity);
  ed_mgmm_remember(law, of_u, of_v, after);
}

/* Whether the moduli mind the extremes at all. */
static int softens(const ed_mgmm_constants *law)
{
  return law->k_mod.a > 0.0 || law->c_mod.a > 0.0;
}

/* Without relaxation: Q is its right-hand side at the end of the step, on which the growth of the extremes has no slope. */
static int instant_step(const ed_mgmm_constants *law, const double *memory, const ed_path *path, const ed_path direction[2], double *trial,
                        ed_damper_force *out)
{
  const double h = path->h, u = ed_path_u(path, h), v = ed_path_v(path, h);
  double *after = trial + 1;
  remember_path(law, memory, path, after);
  const double k = after[ED_K_MOD], c = law->c1 + after[ED_C_MOD];
  double steep, power = ed_power_now(&law->power, v, &steep);
  trial[0] = law->relaxing * k * u + c * v + law->c_nl * power;
  out->force = (law->k0 + (1.0 - law->relaxing) * k) * u + trial[0];
  for (int j = 0; j < 2; j++) {
    out->slope[j] = (law->k0 + k) * ed_path_u(&direction[j], h) + (c + law->c_nl * steep) * ed_path_v(&direction[j], h);
    out->chord[j] = 0.0;
  }
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const ed_mgmm_constants *law = ed_mgmm_constants_of(damper);
  const double h = path->h, length = fmin(h, FORGOTTEN * law->tau), origin = h - length;
  const double *memory = committed + 1;
  if (!isfinite(path->c[0] + h * (path->c[1] + h * (path->c[2] + h * path->c[3]))))
    return ED_E_NOT_FINITE;
  if (law->tau < INSTANT * h)
    return instant_step(law, memory, path, direction, trial, out);
  const int wanted = ed_path_moves(direction);
  const int resting = ed_mgmm_still(memory, path);
  if (resting || !softens(law)) {
    const int status = still_step(law, committed, path, direction, wanted, trial, out);
    if (!resting)
      remember_path(law, memory, path, trial + 1);
    return status;
  }
  ed_path velocity, along[2], velocity_along[2];
  ed_mgmm_sums sum = {.path = *path};
  ed_path_of_velocity(path, &velocity);
  sum.velocity = velocity;
  for (int j = 0; wanted && j < 2; j++) {
    along[j] = direction[j];
    ed_path_of_velocity(&direction[j], &velocity_along[j]);
  }
  ed_softening_piece of_u[ED_EXTREMES_PIECES], of_v[ED_EXTREMES_PIECES];
  ed_running extremes_u, extremes_v;
  const int n_u = ed_softening_pieces(ed_mgmm_extremes(memory, ED_LARGEST_U), path, wanted ? along : NULL, origin, of_u, &extremes_u);
  const int n_v = ed_softening_pieces(ed_mgmm_extremes(memory, ED_LARGEST_V), &velocity, wanted ? velocity_along : NULL, origin, of_v,
                                      &extremes_v);
  of_u[n_u - 1].to = of_v[n_v - 1].to = length;
  if (origin > 0.0) {
    ed_path_piece(path, origin, h, &sum.path);
    sum.path.h = length;
    ed_path_of_velocity(&sum.path, &sum.velocity);
    for (int j = 0; wanted && j < 2; j++) {
      ed_path_piece(&direction[j], origin, h, &along[j]);
      ed_path_of_velocity(&along[j], &velocity_along[j]);
    }
  }
  if (wanted) {
    sum.direction = along;
    sum.velocity_direction = velocity_along;
  }
  if (!ed_mgmm_add_softened(law, &sum, of_u, of_v))
    return ED_E_NOT_FINITE;
  double slope[2] = {0.0}, chord[2] = {0.0};
  if (law->c_nl > 0.0)
    sum.value += law->c_nl * ed_power_integral(&law->power, &sum.path, sum.direction, slope, chord);
  const double relaxing = sum.value + committed[0] * exp(-h / law->tau), u = ed_path_u(&sum.path, length);
  trial[0] = relaxing;
  ed_mgmm_remember(law, extremes_u, extremes_v, trial + 1);
  double along_u[2] = {0.0};
  for (int j = 0; wanted && j < 2; j++)
    along_u[j] = ed_path_u(&along[j], length);
  const ed_modulus k = ed_softening_modulus(&law->k_mod, &of_u[n_u - 1], u, along_u);
  const double spring = 1.0 - law->relaxing, stiffness = law->k0 + spring * k.value;
  out->force = stiffness * u + relaxing;
  for (int j = 0; j < 2; j++) {
    out->slope[j] = stiffness * along_u[j] + spring * k.slope[j] * u + sum.slope[j] + law->c_nl * slope[j];
    out->chord[j] = softer(law, slope[j], chord[j]);
  }
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

/* Modulus at one instant, with its derivative to the value. */
static double modulus_now(const ed_softening *law, double largest, double smallest, double value, double *slope)
{
  const double mean = ed_extremes_mean(ed_extremes_with((ed_running){largest, smallest}, value));
  const double falling = law->a * exp(-mean / law->reference);
  const double follow = value > largest ? 0.5 : value < smallest ? -0.5 : 0.0;
  *slope = -falling * follow / law->reference;
  return falling + law->b;
}

static void rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  const ed_mgmm_constants *law = ed_mgmm_constants_of(damper);
  double k_slope, c_slope;
  const double k = modulus_now(&law->k_mod, memory[ED_LARGEST_U], memory[ED_SMALLEST_U], u, &k_slope);
  const double c = modulus_now(&law->c_mod, memory[ED_LARGEST_V], memory[ED_SMALLEST_V], v, &c_slope);
  const double spring = 1.0 - law->relaxing;
  double power_slope, power = law->c_nl * ed_power_now(&law->power, v, &power_slope);
  power_slope *= law->c_nl;
  out->force = (law->k0 + spring * k) * u + y[0];
  out->force_u = law->k0 + spring * (k + k_slope * u);
  out->force_v = 0.0;
  out->force_y[0] = 1.0;
  out->y[0] = (law->relaxing * k * u + (law->c1 + c) * v + power - y[0]) / law->tau;
  out->y_u[0] = law->relaxing * (k + k_slope * u) / law->tau;
  out->y_v[0] = (law->c1 + c + c_slope * v + power_slope) / law->tau;
  out->y_y[0] = -1.0 / law->tau;
}

static void remember(const ed_damper *damper, double u, double v, const double *y, double *memory)
{
  (void)y;
  ed_mgmm_remember(ed_mgmm_constants_of(damper), ed_extremes_with(ed_mgmm_extremes(memory, ED_LARGEST_U), u),
                   ed_extremes_with(ed_mgmm_extremes(memory, ED_LARGEST_V), v), memory);
}

static void start(const ed_damper *damper, double *state)
{
  const double *prior = damper->prior_extremes;
  ed_mgmm_remember(ed_mgmm_constants_of(damper), ed_mgmm_extremes(prior, ED_LARGEST_U), ed_mgmm_extremes(prior, ED_LARGEST_V), state + 1);
}

static ed_running both(ed_running one, ed_running other)
{
  return ed_extremes_with(ed_extremes_with(one, other.largest), other.smallest);
}

static void keep(const ed_damper *damper, const double *before, double *state)
{
  double *memory = state + 1;
  ed_mgmm_remember(ed_mgmm_constants_of(damper),
                   both(ed_mgmm_extremes(memory, ED_LARGEST_U), ed_mgmm_extremes(before + 1, ED_LARGEST_U)),
                   both(ed_mgmm_extremes(memory, ED_LARGEST_V), ed_mgmm_extremes(before + 1, ED_LARGEST_V)), memory);
}

/* At most 5 of the deformation and 3 of the velocity, which is quadratic. */
static int events(const ed_damper *damper, const ed_path *path, const double *memory, double at[8])
{
  (void)damper;
  ed_path velocity;
  ed_path_of_velocity(path, &velocity);
  double of_u[ED_EXTREMES_BREAKS], of_v[ED_EXTREMES_BREAKS];
  const int n_u = ed_extremes_breaks(ed_mgmm_extremes(memory, ED_LARGEST_U), path, of_u);
  const int n_v = ed_extremes_breaks(ed_mgmm_extremes(memory, ED_LARGEST_V), &velocity, of_v);
  int n = 0;
  for (int i = 0, j = 0; (i < n_u || j < n_v) && n < 8;)
    at[n++] = j == n_v || (i < n_u && of_u[i] <= of_v[j]) ? of_u[i++] : of_v[j++];
  return n;
}

static double relaxation_time(const ed_damper *damper)
{
  return ed_mgmm_constants_of(damper)->tau;
}

/* k0 beside k_b, where it brings no tau k0 v, and of c1 less than its rounding, as tau = c1/k1 stays. */
static void without_dashpots(ed_damper *damper)
{
  enum { ED_LAW_MGMM_PARAMETERS, NOTHING = -60 };
  double *p = damper->parameter;
  p[K1] = ldexp(p[K1], NOTHING);
  p[C1] = ldexp(p[C1], NOTHING);
  p[K_B] += p[K0];
  p[K0] = p[C_NL] = p[C_A] = p[C_B] = 0.0;
}

const ed_law ed_mgmm = {.name = "mgmm", .prepare = prepare, .start = start,
                        .step = step, .rate = rate, .remember = remember, .events = events, .keep = keep,
                        .relaxation_time = relaxation_time, .without_dashpots = without_dashpots};
