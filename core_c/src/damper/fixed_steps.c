#include "damper/fixed_steps.h"

#include "base/dense.h"
#include "edcore.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COPIES = 3, MOST_SUB_STEPS = 64, MOST_ITERATIONS = 80, MOST_HALVINGS = 12 }; /* copies: the variables, and two derivatives */
/* About a turn of the motion forces that follow a power of the velocity change fast: so many sub-steps at least, where the speed at one
 * end is below this share of that at the other. */
enum { ABOUT_TURNS = 4 };
static const double SLOW = 0.5;
static const double GAMMA = 1.0 - M_SQRT1_2;
static const double QUARTER = 0.25;   /* of the length, a sub-step */
static const double SETTLED = 1e-7;   /* of Newton's last change: what is left is its square, below rounding */

typedef double values[COPIES][ED_MAX_ODE];

struct ed_fixed_steps {
  const ed_damper *damper;
  double length;
  int planned;                     /* sub-steps of each piece; 0: as the path itself asks for */
  const ed_path *path, *direction; /* direction NULL: no derivatives are asked for */
  double *memory;
  double way;                      /* sign of the velocity of the piece: at its ends, where v = 0, rounding must not choose */
  ed_damper_rate rate;
  double matrix[ED_MAX_ODE * ED_MAX_ODE], change[ED_MAX_ODE], slope[ED_MAX_ODE];
  int pivot[ED_MAX_ODE];
  values y, known, stage;
};

int ed_fixed_steps_suit(const ed_damper *damper)
{
  const ed_law *law = damper->law;
  return law->rate != NULL && (!ed_damper_has_exact_step(damper) || (law->in_parts && damper->joint == 0.0));
}

ed_fixed_steps *ed_fixed_steps_new(const ed_damper *damper, double length)
{
  ed_fixed_steps *fixed = calloc(1, sizeof *fixed);
  if (fixed) {
    fixed->damper = damper;
    fixed->length = length;
  }
  return fixed;
}

void ed_fixed_steps_free(ed_fixed_steps *fixed)
{
  free(fixed);
}

/* Rates at instant t and y. 0: not finite. */
static int rate_at(ed_fixed_steps *in, double t, const double *y)
{
  const ed_damper *damper = in->damper;
  const double u = ed_path_u(in->path, t);
  double v = ed_path_v(in->path, t), sum;
  if (v * in->way <= 0.0)
    v = in->way * DBL_MIN;
  damper->law->rate(damper, u, v, y, in->memory, &in->rate);
  sum = in->rate.force;
  for (int i = 0; i < damper->n_ode; i++)
    sum += in->rate.y[i];
  return isfinite(sum);
}

static int is_diagonal(const ed_damper *damper)
{
  return damper->n_ode == 1 || damper->diagonal_ode;
}

/* The matrix 1 - gain df/dy, factored; diagonal, or of two variables, as its inverse. 0: singular. */
static int factor(ed_fixed_steps *in, double gain)
{
  const int n = in->damper->n_ode;
  double *m = in->matrix;
  if (is_diagonal(in->damper)) {
    for (int i = 0; i < n; i++)
      m[i] = 1.0 / (1.0 - gain * in->rate.y_y[i]);
    return 1;
  }
  if (n == 2) {
    const double *j = in->rate.y_y, a = 1.0 - gain * j[0], b = -gain * j[1], c = -gain * j[2], d = 1.0 - gain * j[3];
    const double each = 1.0 / (a * d - b * c);
    m[0] = each * d, m[1] = -each * b, m[2] = -each * c, m[3] = each * a;
    return 1;
  }
  for (int i = 0; i < n * n; i++)
    m[i] = -gain * in->rate.y_y[i];
  for (int i = 0; i < n; i++)
    m[i * n + i] += 1.0;
  return ed_dense_factor(n, m, in->pivot);
}

static void solve(const ed_fixed_steps *in, double *x)
{
  const int n = in->damper->n_ode;
  const double *m = in->matrix, first = x[0];
  if (is_diagonal(in->damper))
    for (int i = 0; i < n; i++)
      x[i] *= m[i];
  else if (n == 2) {
    x[0] = m[0] * first + m[1] * x[1];
    x[1] = m[2] * first + m[3] * x[1];
  } else
    ed_dense_solve(n, in->matrix, in->pivot, x);
}

/* Newton's next z of one variable, whose residual falls as z grows, as it does for all that decays: kept between the ends that were found
 * to lie on either side; halfway between them where it does not come closer quickly, as about rest where a slope is infinite. */
static double kept(double z, double residual, double change, double *before, double *low, double *high)
{
  *(residual > 0.0 ? low : high) = z;
  double next = z + change;
  if (!(next > *low && next < *high && fabs(change) <= 0.5 * *before) && isfinite(*high - *low))
    next = 0.5 * (*low + *high);
  *before = fabs(next - z);
  return next;
}

/* z = known + gain f(t, z) from a first guess in `stage`, and its derivatives. 0: Newton's method does not settle. */
static int solve_stage(ed_fixed_steps *in, double t, double gain)
{
  const int n = in->damper->n_ode;
  double *z = in->stage[0], before = INFINITY, low = -INFINITY, high = INFINITY;
  int settled = 0;
  for (int k = 0; !settled; k++) {
    if (k == MOST_ITERATIONS || !rate_at(in, t, z) || !factor(in, gain))
      return 0;
    for (int i = 0; i < n; i++)
      in->change[i] = in->known[0][i] + gain * in->rate.y[i] - z[i];
    const double residual = in->change[0];
    solve(in, in->change);
    settled = 1;
    for (int i = 0; i < n; i++) {
      settled &= fabs(in->change[i]) <= SETTLED * (fabs(z[i]) + fabs(in->known[0][i]));
      z[i] = n > 1 || settled ? z[i] + in->change[i] : kept(z[i], residual, in->change[i], &before, &low, &high);
      if (!isfinite(z[i]))
        return 0;
    }
  }
  for (int j = 0; in->direction && j < 2; j++) {
    const double by_u = ed_path_u(&in->direction[j], t), by_v = ed_path_v(&in->direction[j], t);
    double *s = in->stage[1 + j];
    for (int i = 0; i < n; i++)
      s[i] = in->known[1 + j][i] + gain * (in->rate.y_u[i] * by_u + in->rate.y_v[i] * by_v);
    solve(in, s);
  }
  return 1;
}

/* One sub-step from t on; in halves where a stage does not settle. */
static int sub_step(ed_fixed_steps *in, double t, double h, int halvings)
{
  const ed_damper *damper = in->damper;
  const int n = damper->n_ode, copies = in->direction ? COPIES : 1;
  const double gain = GAMMA * h, on = (1.0 - GAMMA) / GAMMA;
  for (int c = 0; c < copies; c++)
    memcpy(in->known[c], in->y[c], (size_t)n * sizeof(double));
  for (int i = 0; i < n; i++)
    in->stage[0][i] = in->y[0][i] + gain * in->slope[i];
  int solved = solve_stage(in, t + gain, gain);
  if (solved) {
    for (int c = 0; c < copies; c++)
      for (int i = 0; i < n; i++) {
        const double moved = in->stage[c][i] - in->y[c][i];
        in->known[c][i] = in->y[c][i] + on * moved;
        in->stage[c][i] = in->known[c][i] + moved;
      }
    solved = solve_stage(in, t + h, gain);
  }
  if (!solved) {
    memset(in->slope, 0, sizeof in->slope);
    return halvings < MOST_HALVINGS && sub_step(in, t, 0.5 * h, halvings + 1) && sub_step(in, t + 0.5 * h, 0.5 * h, halvings + 1);
  }
  for (int i = 0; i < n; i++)
    in->slope[i] = (in->stage[0][i] - in->known[0][i]) / gain;
  for (int c = 0; c < copies; c++)
    memcpy(in->y[c], in->stage[c], (size_t)n * sizeof(double));
  if (damper->law->remember)
    damper->law->remember(damper, ed_path_u(in->path, t + h), ed_path_v(in->path, t + h), in->y[0], in->memory);
  return 1;
}

/* Sub-steps from one turn of a path to the next. */
static int sub_steps_between(const ed_fixed_steps *in, const ed_path *path, double from, double to)
{
  const double way = fabs(ed_path_u(path, to) - ed_path_u(path, from));
  const double begins = fabs(ed_path_v(path, from)), ends = fabs(ed_path_v(path, to));
  const double least = fmin(begins, ends) < SLOW * fmax(begins, ends) ? ABOUT_TURNS : 1.0;
  return (int)fmax(least, fmin(ceil(way / (QUARTER * in->length)), MOST_SUB_STEPS));
}

void ed_fixed_steps_plan(ed_fixed_steps *fixed, const ed_path *motion)
{
  double at[2], from = 0.0;
  const int turns = motion ? ed_path_reversals(motion, at) : -1;
  fixed->planned = 0;
  for (int i = 0; i <= turns; i++) {
    const double to = i < turns ? at[i] : motion->h;
    const int needed = sub_steps_between(fixed, motion, from, to);
    fixed->planned = needed > fixed->planned ? needed : fixed->planned;
    from = to;
  }
}

/* From one turn of the path to the next. */
static int piece(ed_fixed_steps *in, double from, double to)
{
  const int sub_steps = in->planned > 0 ? in->planned : sub_steps_between(in, in->path, from, to);
  const double h = (to - from) / sub_steps, v = ed_path_v(in->path, 0.5 * (from + to));
  in->way = (v > 0.0) - (v < 0.0);
  for (int i = 0; i < sub_steps; i++)
    if (!sub_step(in, from + i * h, h, 0))
      return 0;
  return 1;
}

int ed_fixed_steps_along(ed_fixed_steps *fixed, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                         ed_damper_force *out)
{
  const ed_damper *damper = fixed->damper;
  const int n = damper->n_ode;
  if (!isnormal(path->h)) /* a part of it could be nothing */
    return ED_E_ARGUMENT;
  if (!isfinite(ed_path_u(path, path->h) + ed_path_v(path, path->h)))
    return ED_E_NOT_FINITE;
  fixed->path = path;
  fixed->direction = ed_path_moves(direction) ? direction : NULL;
  fixed->memory = trial + n;
  memcpy(trial + n, committed + n, (size_t)damper->n_memory * sizeof *trial);
  for (int i = 0; i < n; i++) {
    fixed->y[0][i] = committed[i];
    fixed->y[1][i] = fixed->y[2][i] = fixed->slope[i] = 0.0;
  }
  double at[2], from = 0.0;
  const int turns = ed_path_reversals(path, at);
  for (int i = 0; i <= turns; i++) {
    const double to = i < turns ? at[i] : path->h;
    if (to > from && !piece(fixed, from, to))
      return ED_E_NOT_CONVERGED;
    from = to;
  }
  memcpy(trial, fixed->y[0], (size_t)n * sizeof *trial);
  if (!rate_at(fixed, path->h, trial))
    return ED_E_NOT_FINITE;
  out->force = fixed->rate.force;
  for (int j = 0; j < 2; j++) {
    out->slope[j] = fixed->rate.force_u * ed_path_u(&direction[j], path->h) + fixed->rate.force_v * ed_path_v(&direction[j], path->h);
    for (int i = 0; i < n; i++)
      out->slope[j] += fixed->rate.force_y[i] * fixed->y[1 + j][i];
  }
  return damper->n_effects > 0 ? ed_effects_apply(damper, committed, path, direction, trial, out) : ED_OK;
}
