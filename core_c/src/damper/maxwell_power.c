/* Power-law dashpot in series with a spring: F' = k (v - sgn F (|F| / c)^(1/alpha)). A brace joins the spring.
 *
 * In x = F/c and the dashpot's own velocity w = sgn x |x|^(1/alpha): x' = kappa (v - w), kappa = k/c, v a parabola over the step.
 * Where x changes little against itself its Taylor series is summed: w is the only power, the coefficients of (x/x_0)^(1/alpha) follow from
 * those of x/x_0, and the derivatives to the unknowns solve a linear equation whose coefficients are again a power of x.
 * Elsewhere, through rest or where the spring is stiff against the step, Radau IIA of three stages (order 5, L-stable: Hairer & Wanner
 * 1996, IV.8) goes on in parts that an embedded estimate of order 3 chooses; derivatives follow from the equations of the stages. */
#include "base/dense.h"
#include "base/power_series.h"
#include "damper/laws.h"
#include "edcore.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { ED_LAW_MAXWELL_POWER_PARAMETERS };

/* For alpha > 1 the derivative of the dashpot's velocity to the force is infinite at rest. Below this share of c it is bounded: the
 * force itself is not touched, and a sensitivity that passes through rest fades there all the same. */
static const double AT_REST = 1e-16;

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  (void)message;
  damper->n_ode = 1;
  damper->diagonal_ode = 1;
  return ED_OK;
}

/* Of spring and brace. */
static double stiffness(const ed_damper *damper)
{
  const double k = damper->parameter[K];
  return damper->brace > 0.0 ? 1.0 / (1.0 / k + 1.0 / damper->brace) : k;
}

static double raised(double x, double power)
{
  const double size = fabs(x);
  return power == 1.0 ? x : power == 2.0 ? x * size : copysign(pow(size, power), x);
}

/* A part of the path: x' = kappa (v - w) from its start on. */
typedef struct {
  double kappa, power, alpha; /* power = 1 / alpha */
  double largest;             /* that x can reach over the whole path */
  double t, h;                /* of the part on the path */
  const ed_path *path, *direction; /* direction NULL: no derivatives are asked for */
  double x, slope[2];         /* at its start, then at its end */
} part;

/* ---- where x changes little */

enum { MOST_TERMS = ED_SERIES_TERMS };
/* Of the change of x against itself. The series ends where x is zero, so that its terms fall by this or faster. */
static const double LITTLE = 0.2;
/* Terms of a sum that begins with 1. */
static const double ROUNDING = 0.25 * DBL_EPSILON;

/* Coefficients of the velocity of a path from t on, in shares of a time h. */
static void velocity_series(const ed_path *path, double t, double h, double v[3])
{
  v[0] = ed_path_v(path, t);
  v[1] = (2.0 * path->c[2] + 6.0 * path->c[3] * t) * h;
  v[2] = 3.0 * path->c[3] * h * h;
}

/* How far the series may go: at most `left`. */
static double little(const part *of, double w, double left)
{
  double v[3];
  velocity_series(of->path, of->t, left, v);
  const double change = of->kappa * (fabs(v[0]) + fabs(v[1]) + fabs(v[2]) + fmax(1.0, of->power) * fabs(w));
  return change * left <= LITTLE * fabs(of->x) ? left : LITTLE * fabs(of->x) / change;
}

/* 0: the series does not settle; nothing is changed then. w: at the start. */
static int by_taylor(part *of, double w0)
{
  const double h = of->h, step = of->kappa * h, scale = step / of->x, stiff = scale * of->power * w0;
  double v[3], by[2][3], r[MOST_TERMS + 1], w[MOST_TERMS + 1], lower[MOST_TERMS + 1], s[2][MOST_TERMS + 1], sum = 1.0;
  double sums[2] = {of->slope[0], of->slope[1]};
  velocity_series(of->path, of->t, h, v);
  for (int j = 0; of->direction && j < 2; j++) {
    velocity_series(&of->direction[j], of->t, h, by[j]);
    s[j][0] = sums[j];
  }
  r[0] = w[0] = lower[0] = 1.0;
  for (int k = 0; k < MOST_TERMS; k++) {
    if (k > 0)
      w[k] = ed_power_of_series(of->power, k, r, w);
    r[k + 1] = scale * ((k < 3 ? v[k] : 0.0) - w0 * w[k]) * ED_INVERSE[k + 1];
    sum += r[k + 1];
    int settled = fmax(fabs(r[k + 1]), fabs(r[k])) <= ROUNDING;
    if (of->direction && k > 0)
      lower[k] = ed_power_of_series(of->power - 1.0, k, r, lower);
    for (int j = 0; of->direction && j < 2; j++) {
      double back = 0.0;
      for (int i = 0; i <= k; i++)
        back += lower[i] * s[j][k - i];
      s[j][k + 1] = (step * (k < 3 ? by[j][k] : 0.0) - stiff * back) * ED_INVERSE[k + 1];
      sums[j] += s[j][k + 1];
      settled &= fmax(fabs(s[j][k + 1]), fabs(s[j][k])) <= DBL_EPSILON * fabs(sums[j]);
    }
    if (settled && k >= 2) { /* beyond what the velocity itself adds */
      of->x *= sum;
      memcpy(of->slope, sums, sizeof sums);
      return 1;
    }
  }
  return 0;
}

/* ---- elsewhere */

enum { STAGES = 3, MOST_PARTS = 10000, MOST_NEWTON = 12 };
#define ROOT6 2.4494897427831781
static const double PLACE[STAGES] = {(4.0 - ROOT6) / 10.0, (4.0 + ROOT6) / 10.0, 1.0};
static const double WEIGHT[STAGES][STAGES] = {
    {(88.0 - 7.0 * ROOT6) / 360.0, (296.0 - 169.0 * ROOT6) / 1800.0, (-2.0 + 3.0 * ROOT6) / 225.0},
    {(296.0 + 169.0 * ROOT6) / 1800.0, (88.0 + 7.0 * ROOT6) / 360.0, (-2.0 - 3.0 * ROOT6) / 225.0},
    {(16.0 - ROOT6) / 36.0, (16.0 + ROOT6) / 36.0, 1.0 / 9.0}};
/* The embedded estimate (Hairer & Wanner 1996, IV.8.20): of the changes at the stages, and the real eigenvalue of WEIGHT's inverse. */
static const double ESTIMATE[STAGES] = {(-13.0 - 7.0 * ROOT6) / 3.0, (-13.0 + 7.0 * ROOT6) / 3.0, -1.0 / 3.0};
#define REAL_EIGENVALUE 3.6378342527444958
/* Of the embedded estimate, against the largest x that the step can reach: a hundredth of what SUNDIALS is asked for in frames. */
static const double TOLERANCE = 1e-8;
static const double SETTLED = 1e-11; /* of Newton's last change: what is left is its square */
/* How many parts by Taylor series cost what one of these does. */
static const double COST = 4.0;
/* Of the next part against this one. */
static const double SAFETY = 0.9, SHRINK = 0.1, GROW = 8.0;
/* A part behind one by Taylor series may be longer again; one that is too long costs little. */
static const double LONGER = 2.0;

/* x and w by the unknown of Newton's method, and their derivatives to it. The unknown is x; but where the spring is stiff even at the
 * largest x and alpha > 1, so that dw/dx is infinite at rest, it is w. */
typedef struct {
  double x, w, dx, dw;
} pair;

typedef struct {
  const part *of;
  int by_w;
  double v[1 + STAGES]; /* at the start and at the stages */
  pair at[1 + STAGES];
  double factors[STAGES * STAGES];
  int pivot[STAGES];
} stages;

static pair pair_of(const stages *in, double unknown)
{
  if (in->by_w) {
    const double x = raised(unknown, in->of->alpha);
    return (pair){x, unknown, unknown != 0.0 ? in->of->alpha * x / unknown : 0.0, 1.0};
  }
  const double w = raised(unknown, in->of->power), size = AT_REST * in->of->largest;
  return (pair){unknown, w, 1.0, in->of->power * (fabs(unknown) > size ? w / unknown : raised(size, in->of->power) / size)};
}

/* 0: singular */
static int factor(stages *in)
{
  const double step = in->of->kappa * in->of->h;
  for (int i = 0; i < STAGES; i++)
    for (int j = 0; j < STAGES; j++)
      in->factors[STAGES * i + j] = (i == j ? in->at[1 + i].dx : 0.0) + step * WEIGHT[i][j] * in->at[1 + j].dw;
  return ed_dense_factor(STAGES, in->factors, in->pivot);
}

/* Solves the stages; 0: they do not settle. */
static int solve_stages(stages *in)
{
  const part *of = in->of;
  const double step = of->kappa * of->h, most = in->by_w ? raised(of->largest, of->power) : of->largest;
  const pair start = in->at[0];
  /* rounding of what the dashpot goes, where x is free to follow it: that much Newton's method cannot resolve */
  const double settled = SETTLED * most + (in->by_w ? 0.0 : 4.0 * DBL_EPSILON * step * raised(most, of->power));
  double unknown[STAGES], change[STAGES];
  for (int i = 0; i < STAGES; i++) { /* a first guess by the implicit Euler rule, within what x can reach */
    const double reach = PLACE[i] * step, moved = reach * (in->v[1 + i] - start.w) / (start.dx + reach * start.dw);
    unknown[i] = fmax(-most, fmin(most, (in->by_w ? start.w : start.x) + moved));
    in->at[1 + i] = pair_of(in, unknown[i]);
  }
  for (int n = 0; n < MOST_NEWTON; n++) {
    double moved = 0.0, sum = 0.0;
    for (int i = 0; i < STAGES; i++) {
      change[i] = start.x - in->at[1 + i].x;
      for (int j = 0; j < STAGES; j++)
        change[i] += step * WEIGHT[i][j] * (in->v[1 + j] - in->at[1 + j].w);
    }
    if (!factor(in))
      return 0;
    ed_dense_solve(STAGES, in->factors, in->pivot, change);
    for (int i = 0; i < STAGES; i++) {
      unknown[i] += change[i];
      in->at[1 + i] = pair_of(in, unknown[i]);
      moved = fmax(moved, fabs(change[i]));
      sum += in->at[1 + i].x + in->at[1 + i].w;
    }
    if (!isfinite(sum))
      return 0;
    if (moved <= settled)
      return 1;
  }
  return 0;
}

/* Of the error of x at the end. The rate at which x forgets is the smaller one of start and end: at rest it may be infinite. Through rest w
 * is not smooth, unless it is a line, and may bend between the stages unseen: all that it changes there counts as error. */
static double estimate(const stages *in)
{
  const pair *start = &in->at[0], *end = &in->at[STAGES];
  const pair *slow = start->dw * end->dx < end->dw * start->dx ? start : end;
  const double step = in->of->kappa * in->of->h;
  double sum = step * (in->v[0] - start->w);
  for (int i = 0; i < STAGES; i++)
    sum += ESTIMATE[i] * (in->at[1 + i].x - start->x);
  const double bend = start->x * end->x < 0.0 && in->of->power != 1.0 ? step * fmax(fabs(start->w), fabs(end->w)) : 0.0;
  /* fractions, so that dx may be zero */
  return fmax(fabs(sum) * slow->dx / (REAL_EIGENVALUE * slow->dx + step * slow->dw), bend * slow->dx / (slow->dx + step * slow->dw));
}

/* Moves the derivatives from the start to the end. */
static int move_slopes(stages *in, double slope[2])
{
  const part *of = in->of;
  if (!factor(in))
    return 0;
  for (int j = 0; j < 2; j++) {
    double moved[STAGES];
    for (int i = 0; i < STAGES; i++) {
      moved[i] = slope[j];
      for (int k = 0; k < STAGES; k++)
        moved[i] += of->kappa * of->h * WEIGHT[i][k] * ed_path_v(&of->direction[j], of->t + PLACE[k] * of->h);
    }
    ed_dense_solve(STAGES, in->factors, in->pivot, moved);
    slope[j] = in->at[STAGES].dx * moved[STAGES - 1];
  }
  return 1;
}

/* Tries the part; *longer: how much longer one of the same error may be that the next begins with. 0: this one was too long. */
static int by_radau(part *of, double w0, double *longer)
{
  const double stiff = of->kappa * of->h * of->power * raised(of->largest, of->power);
  stages in = {.of = of, .by_w = of->alpha > 1.0 && stiff > of->largest};
  in.at[0] = pair_of(&in, in.by_w ? w0 : of->x);
  in.v[0] = ed_path_v(of->path, of->t);
  for (int i = 0; i < STAGES; i++)
    in.v[1 + i] = ed_path_v(of->path, of->t + PLACE[i] * of->h);
  *longer = SHRINK;
  if (!solve_stages(&in))
    return 0;
  const double error = estimate(&in), room = TOLERANCE * of->largest;
  *longer = error > 0.0 ? fmax(SHRINK, fmin(GROW, SAFETY * sqrt(sqrt(room / error)))) : GROW;
  if (!(error <= room) || (of->direction && !move_slopes(&in, of->slope)))
    return 0;
  of->x = in.at[STAGES].x;
  return 1;
}

static int follow(part *of)
{
  const double end = of->path->h;
  double next = end; /* length of the next part by Radau IIA */
  for (int parts = 0; of->t < end; parts++) {
    const double left = end - of->t, w = raised(of->x, of->power), reach = little(of, w, left);
    double longer = 1.0;
    int gone = 0;
    if (parts == MOST_PARTS || of->t + next == of->t)
      return ED_E_NOT_CONVERGED;
    if (reach > 0.0 && COST * reach >= fmin(next, left)) {
      of->h = reach;
      gone = by_taylor(of, w);
      if (gone)
        next = LONGER * fmax(next, reach);
    }
    if (!gone) {
      of->h = fmin(next, left);
      gone = by_radau(of, w, &longer);
      next = longer * of->h;
    }
    if (gone)
      of->t = of->h < left ? of->t + of->h : end;
  }
  return ED_OK;
}

/* The size of x where nothing moves. */
static const double NOTHING = 1e-100;

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *p = damper->parameter, *c = path->c, h = path->h;
  part of = {.kappa = stiffness(damper) / p[C], .power = 1.0 / p[ALPHA], .alpha = p[ALPHA], .path = path,
             .direction = ed_path_moves(direction) ? direction : NULL, .x = committed[0] / p[C]};
  /* |w| never passes the largest velocity from below, nor does x grow faster than the spring alone would let it */
  const double fastest = fabs(c[1]) + h * (2.0 * fabs(c[2]) + 3.0 * h * fabs(c[3])), size = fabs(of.x);
  of.largest = fmax(size, fmin(raised(fastest, of.alpha), size + of.kappa * fastest * h));
  of.largest = fmax(of.largest, NOTHING);
  const int status = follow(&of);
  trial[0] = out->force = p[C] * of.x;
  /* About rest Newton's method oscillates on tangents. There the secant of the dashpot counts, in series with the spring over the step */
  const double secant = fabs(of.x) > NOTHING ? fabs(of.x) / raised(fabs(of.x), of.power) : HUGE_VAL;
  const double series = 1.0 / (1.0 / secant + 1.0 / (of.kappa * h));
  for (int j = 0; j < 2; j++) {
    const double by_v = ed_path_v(&direction[j], h), chord = series * by_v - of.slope[j];
    out->slope[j] = p[C] * of.slope[j];
    out->chord[j] = p[ALPHA] < 1.0 && chord * by_v > 0.0 ? p[C] * chord : 0.0;
  }
  return status == ED_OK && !isfinite(of.x) ? ED_E_NOT_FINITE : status;
}

static void rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  (void)u, (void)memory;
  const double *p = damper->parameter, power = 1.0 / p[ALPHA], k = stiffness(damper);
  const double size = fmax(fabs(y[0]) / p[C], AT_REST);
  const double lower = power == 1.0 ? 1.0 : power == 2.0 ? size : pow(size, power - 1.0);
  out->force = y[0];
  out->force_u = out->force_v = 0.0;
  out->force_y[0] = 1.0;
  out->y[0] = k * (v - lower * (y[0] / p[C]));
  out->y_u[0] = 0.0;
  out->y_v[0] = k;
  out->y_y[0] = -k * power * lower / p[C];
}

const ed_law ed_maxwell_power = {.name = "maxwell_power",
                                 .takes_brace = 1,
                                 .step_takes_brace = 1,
                                 .in_parts = 1,
                                 .prepare = prepare,
                                 .step = step,
                                 .rate = rate};
