/* Bouc-Wen with softening by the largest deformation, beside a power-law dashpot (thesis Eqs. 2.69 to 2.71; Karavasilis,
 * Blakeborough & Williams 2011): F = k (alpha u + (1 - alpha) Y z) + C |v|^alpha_d sgn v, k = k1 exp(-u_max/u_ref) + k2.
 *
 * As differential equation with a brace k_b in series (SUNDIALS integrates it where there is a dashpot too) the elongation of
 * the brace, e = F / k_b, is a variable, so that errors are judged by the force; the own deformation is u - e. Its velocity w
 * follows from the dashpot, which takes what the brace gives beyond the hysteretic part: C |w|^alpha_d sgn w = k_b e - k (...);
 * without dashpot from k_b (v - w) = dF/d(u - e) w. Memory: largest and smallest (own) deformation. */
#include "damper/bouc_wen.h"
#include "damper/laws.h"
#include "damper/power_dashpot.h"
#include "damper/running_extremes.h"
#include "damper/softening.h"
#include "edcore.h"

#include <string.h>

enum { ED_LAW_MODIFIED_BOUC_WEN_PARAMETERS };

/* For alpha_d > 1 the slope of the dashpot's speed is infinite at no force: below this share of C it is bounded. */
static const double NO_FORCE = 1e-16;
static const double rounding = 1e-10; /* of the extremes: so near to one it grows */
static const double no_way = 1e-12; /* of the brace's force: which way the device goes then follows from the whole */

static ed_bouc_wen_shape shape_of(const ed_damper *damper)
{
  const double *p = damper->parameter;
  return (ed_bouc_wen_shape){p[Y], p[A], p[BETA], p[GAMMA], p[N]};
}

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double *p = damper->parameter;
  const ed_bouc_wen_shape shape = shape_of(damper);
  damper->n_ode = damper->brace > 0.0 ? 2 : 1;
  damper->n_memory = 2;
  damper->rate_independent = p[C] == 0.0;
  damper->without_step = damper->brace > 0.0 && p[C] > 0.0;
  return ed_bouc_wen_check(&shape, message);
}

/* Stiffness at the end of a path and its derivatives; `memory` is moved there. */
static ed_modulus stiffness(const double *p, const ed_path *path, const ed_path direction[2], int wanted, double *memory)
{
  const ed_softening law = {p[K1], p[K2], p[U_REF]};
  const ed_running start = {memory[0], memory[1]};
  ed_softening_piece piece[ED_EXTREMES_PIECES];
  ed_running after;
  double along[2] = {0.0, 0.0};
  const int n = ed_softening_pieces(start, path, wanted ? direction : NULL, 0.0, piece, &after);
  for (int j = 0; wanted && j < 2; j++)
    along[j] = ed_path_u(&direction[j], path->h);
  memory[0] = after.largest;
  memory[1] = after.smallest;
  return ed_softening_modulus(&law, &piece[n - 1], ed_path_u(path, path->h), along);
}

/* Without brace, or without dashpot behind a brace that brace.c puts there: its elongation, the first variable, follows from the force. */
static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *p = damper->parameter, h = path->h, u = ed_path_u(path, h), f = (1.0 - p[ALPHA]) * p[Y];
  const ed_bouc_wen_shape shape = shape_of(damper);
  const int wanted = ed_path_moves(direction), n = damper->n_ode;
  double *z = trial + n - 1, z_slope[2], secant = 0.0, slope = 0.0;
  memcpy(trial, committed, (size_t)(n + damper->n_memory) * sizeof *trial);
  const int status = ed_bouc_wen_follow(&shape, path, direction, z, z_slope);
  if (status != ED_OK)
    return status;
  const ed_modulus k = stiffness(p, path, direction, wanted, trial + n);
  const double part = p[ALPHA] * u + f * *z, v = ed_path_v(path, h);
  if (p[C] > 0.0)
    ed_power_dashpot(p[C], p[ALPHA_D], v, &secant, &slope);
  out->force = k.value * part + secant * v;
  for (int j = 0; j < 2; j++) {
    const double by_v = ed_path_v(&direction[j], h);
    out->slope[j] = k.slope[j] * part + k.value * (p[ALPHA] * ed_path_u(&direction[j], h) + f * z_slope[j]) + slope * by_v;
    out->chord[j] = p[ALPHA_D] < 1.0 ? (secant - slope) * by_v : 0.0;
  }
  if (n > 1)
    trial[0] = out->force / damper->brace;
  return isfinite(out->force) ? ED_OK : ED_E_NOT_FINITE;
}

/* The hysteretic part at own deformation x and z, and its derivatives. */
typedef struct {
  double force, x, z, xx, xz; /* xx, xz: second derivatives */
} hysteretic;

static hysteretic hysteretic_part(const double *p, double x, double z, double way, const double *memory)
{
  const ed_running before = {memory[0], memory[1]}, now = ed_extremes_with(before, x);
  const double soft = p[K1] * exp(-ed_extremes_mean(now) / p[U_REF]), k = soft + p[K2];
  /* while an extreme grows, u_max changes by half of what the deformation does */
  const double near = rounding * (now.largest - now.smallest);
  const double growth = x >= now.largest - near && way > 0.0 ? 0.5 : x <= now.smallest + near && way < 0.0 ? -0.5 : 0.0;
  const double per = -growth / p[U_REF], part = p[ALPHA] * x + (1.0 - p[ALPHA]) * p[Y] * z, f = (1.0 - p[ALPHA]) * p[Y];
  return (hysteretic){.force = k * part,
                      .x = k * p[ALPHA] + per * soft * part,
                      .z = k * f,
                      .xx = 2.0 * per * soft * p[ALPHA] + per * per * soft * part,
                      .xz = per * soft * f};
}

/* Without brace: y = z. */
static void rigid_rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  const double *p = damper->parameter, way = ed_way(v);
  const ed_bouc_wen_shape shape = shape_of(damper);
  const hysteretic part = hysteretic_part(p, u, y[0], way, memory);
  double slope, slope_z, chord = 0.0, tangent = 0.0;
  ed_bouc_wen_slope(&shape, y[0], way, &slope, &slope_z);
  if (p[C] > 0.0)
    ed_power_dashpot(p[C], p[ALPHA_D], v, &chord, &tangent);
  out->force = part.force + chord * v;
  out->force_u = part.x;
  out->force_v = tangent;
  out->force_y[0] = part.z;
  out->y[0] = slope * v;
  out->y_u[0] = 0.0;
  out->y_v[0] = slope;
  out->y_y[0] = slope_z * v;
}

/* With brace: y = elongation of the brace, z. */
static void braced_rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  const double *p = damper->parameter, brace = damper->brace, x = u - y[0];
  const ed_bouc_wen_shape shape = shape_of(damper);
  double way = ed_way(v), slope, slope_z, w, w_v = 0.0, w_e = 0.0, w_x, w_z;
  hysteretic part = hysteretic_part(p, x, y[1], way, memory);
  if (p[C] > 0.0) {
    const double rest = brace * y[0] - part.force;
    if (fabs(rest) > no_way * brace * (fabs(u) + fabs(y[0])) && ed_way(rest) != way) {
      way = ed_way(rest);
      part = hysteretic_part(p, x, y[1], way, memory);
    }
    const double power = 1.0 / p[ALPHA_D], size = fmax(fabs(rest) / p[C], NO_FORCE);
    const double lower = power == 1.0 ? 1.0 : pow(size, power - 1.0), w_rest = power * lower / p[C];
    ed_bouc_wen_slope(&shape, y[1], way, &slope, &slope_z);
    w = lower * rest / p[C];
    w_e = w_rest * brace;
    w_x = -w_rest * part.x;
    w_z = -w_rest * part.z;
  } else {
    ed_bouc_wen_slope(&shape, y[1], way, &slope, &slope_z);
    const double whole = brace + part.x + part.z * slope, share = whole > 0.0 ? brace / whole : NAN;
    const double per = -share * share / brace * v;
    w = share * v;
    w_v = share;
    w_x = per * (part.xx + part.xz * slope);
    w_z = per * (part.xz + part.z * slope_z);
  }
  out->force_v = 0.0;
  if (p[C] > 0.0) {
    out->force = brace * y[0];
    out->force_u = out->force_y[1] = 0.0;
    out->force_y[0] = brace;
  } else { /* brace and device carry the same: of the two variables z alone gives the force, to second order in the error of e */
    const double share = brace / (brace + part.x);
    out->force = brace * y[0] + share * (part.force - brace * y[0]);
    out->force_u = share * part.x;
    out->force_y[0] = 0.0;
    out->force_y[1] = share * part.z;
  }
  out->y[0] = v - w;
  out->y_u[0] = -w_x;
  out->y_v[0] = 1.0 - w_v;
  out->y_y[0] = w_x - w_e;
  out->y_y[1] = -w_z;
  out->y[1] = slope * w;
  out->y_u[1] = slope * w_x;
  out->y_v[1] = slope * w_v;
  out->y_y[2] = slope * (w_e - w_x);
  out->y_y[3] = slope * w_z + slope_z * w;
}

static void rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  (damper->brace > 0.0 ? braced_rate : rigid_rate)(damper, u, v, y, memory, out);
}

static void remember(const ed_damper *damper, double u, double v, const double *y, double *memory)
{
  (void)v;
  const ed_running now = ed_extremes_with((ed_running){memory[0], memory[1]}, damper->brace > 0.0 ? u - y[0] : u);
  memory[0] = now.largest;
  memory[1] = now.smallest;
}

static void keep(const ed_damper *damper, const double *before, double *state)
{
  const int n = damper->n_ode;
  memcpy(state + n, before + n, (size_t)damper->n_memory * sizeof *state);
}

/* Where the whole deformation begins or ceases to be an extreme; that of the device itself is known only while it is integrated. */
static int events(const ed_damper *damper, const ed_path *path, const double *memory, double at[8])
{
  return damper->brace > 0.0 ? 0 : ed_extremes_breaks((ed_running){memory[0], memory[1]}, path, at);
}

const ed_law ed_modified_bouc_wen = {.name = "modified_bouc_wen",
                                     .softens = 1,
                                     .takes_brace = 1,
                                     .prepare = prepare,
                                     .step = step,
                                     .rate = rate,
                                     .remember = remember,
                                     .keep = keep,
                                     .events = events};
