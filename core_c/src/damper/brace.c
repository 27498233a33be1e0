/* Damper and brace in series: k_b (u - u_d) = F(u_d). Where the pins of the brace have play, it acts on what of u - u_d goes beyond half
 * the play, either way.
 *
 * Laws that depend on speed: the damper's own deformation u_d is a parabola over the step, and equilibrium holds at one third and
 * at the end of it (collocation at the points of Radau IIA, order 3, L-stable: Hairer & Wanner 1996, IV.5). The law meets that
 * parabola exactly, and both evaluations start from the committed state, so that the tangent is exact too.
 * Laws that do not: equilibrium at every turning point of the path and at its end, which is all that such laws know. */
#include "damper/brace.h"

#include <math.h>
#include <string.h>

enum { MOST_ITERATIONS = 40, MOST_HALVINGS = 8, PATIENCE = 20 };
static const double TOLERANCE = 1e-9; /* of the forces that balance: a hundredth of what a frame asks of its own balance */
static const double BETWEEN_TRIALS = 1e-2; /* of the change: what is made up to first order then is off by 1e-4 of itself */
static const double ROUGH = 0.1; /* Newton's method then gains a digit at least from one trial to the next */

static double largest(double a, double b)
{
  return a > b ? a : b;
}

static double stiffness(const ed_damper *d)
{
  return d->brace + d->joint; /* one of them is zero */
}

/* How far a brace is strained at a stretch, and 1 if it holds there, 0 within its play. */
static double strained(const ed_damper *d, double stretch, double *holds)
{
  const double beyond = fabs(stretch) - 0.5 * d->play;
  *holds = d->joint == 0.0 || beyond > 0.0;
  return d->joint == 0.0 ? stretch : beyond > 0.0 ? copysign(beyond, stretch) : 0.0;
}

/* ---- laws that depend on speed */

static const double THIRD = 1.0 / 3.0;

/* The parabola from u0 through u0 + a at h/3 and u0 + b at h. Changes, as short steps leave nothing of velocities from differences of
 * deformations but rounding. */
static void parabola(ed_path *path, double h, double u0, double a, double b)
{
  path->h = h;
  path->c[0] = u0;
  path->c[1] = (9.0 * a - b) / (2.0 * h);
  path->c[2] = (3.0 * b - 9.0 * a) / (2.0 * h * h);
  path->c[3] = 0.0;
}

typedef struct {
  double a, b;                       /* own deformation at h/3 and h, less that at 0 */
  double residual[2], size, slope[2][2], chord[2][2];
  double holds[2];                   /* 1, or 0 within the play of the brace */
  ed_damper_force end;
} ed_stage;

static int evaluate(const ed_damper *d, const double *committed, double h, const double total[2], ed_stage *stage, double *trial)
{
  const double kb = stiffness(d), u0 = committed[ed_damper_own_size(d)];
  ed_path whole, direction[2];
  parabola(&whole, h, u0, stage->a, stage->b);
  parabola(&direction[0], h, 0.0, 1.0, 0.0);
  parabola(&direction[1], h, 0.0, 0.0, 1.0);
  ed_path third = whole, third_direction[2] = {direction[0], direction[1]};
  third.h = third_direction[0].h = third_direction[1].h = THIRD * h;
  ed_damper_force at_third = {0};
  stage->end = (ed_damper_force){0};
  int status = ed_damper_own_step(d, committed, &third, third_direction, trial, &at_third);
  if (status == ED_OK)
    status = ed_damper_own_step(d, committed, &whole, direction, trial, &stage->end);
  if (status != ED_OK)
    return status;
  stage->residual[0] = at_third.force - kb * strained(d, total[0] - u0 - stage->a, &stage->holds[0]);
  stage->residual[1] = stage->end.force - kb * strained(d, total[1] - u0 - stage->b, &stage->holds[1]);
  stage->size = fabs(at_third.force) + fabs(stage->end.force) +
                kb * (fabs(total[0]) + fabs(total[1]) + fabs(u0 + stage->a) + fabs(u0 + stage->b));
  stage->slope[0][0] = at_third.slope[0] + kb * stage->holds[0];
  stage->slope[0][1] = at_third.slope[1];
  stage->slope[1][0] = stage->end.slope[0];
  stage->slope[1][1] = stage->end.slope[1] + kb * stage->holds[1];
  for (int i = 0; i < 2; i++) {
    stage->chord[0][i] = stage->slope[0][i] + at_third.chord[i];
    stage->chord[1][i] = stage->slope[1][i] + stage->end.chord[i];
  }
  return isfinite(stage->residual[0] + stage->residual[1]) ? ED_OK : ED_E_NOT_FINITE;
}

/* x of slope x = right; 0: singular */
static int solve(const double slope[2][2], double right0, double right1, double x[2])
{
  const double determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
  x[0] = (slope[1][1] * right0 - slope[0][1] * right1) / determinant;
  x[1] = (slope[0][0] * right1 - slope[1][0] * right0) / determinant;
  return isfinite(x[0] + x[1]);
}

/* The last element of that x is by[0] right[0] + by[1] right[1]. */
static int end_of_solution(const double slope[2][2], double by[2])
{
  const double determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
  by[0] = -slope[1][0] / determinant;
  by[1] = slope[0][0] / determinant;
  return isfinite(by[0] + by[1]);
}

/* What a trial leaves for the next one, behind the own deformation in the state. */
enum { STRETCHING = 1, BENDING, FROM, DURATION, OWN, TOTAL = OWN + 2, SLOPE = TOTAL + 2, RESIDUAL = SLOPE + 4 };

/* The first guess. In the first trial of a step damper and brace go on as in the step before, and share what the total deformation does
 * otherwise by the slopes at its end; where that step had another length, the damper takes all of it. In others the last trial of this
 * step moves on to where the total deformation is now. Returns by how much that moved the damper, or 0. */
static double guess(const ed_damper *d, const double *committed, const double *last, const ed_path *path, const double total[2],
                    ed_stage *stage)
{
  const double h = path->h, u0 = committed[0], third = THIRD * h, kb = d->brace;
  double slope[2][2], move[2];
  if (d->joint > 0.0) { /* slopes found within the play say nothing beyond it */
    stage->a = total[0] - path->c[0];
    stage->b = total[1] - path->c[0];
    return 0.0;
  }
  if (last[FROM] == u0 && last[DURATION] == h) {
    memcpy(slope, last + SLOPE, sizeof slope);
    if (solve(slope, kb * (total[0] - last[TOTAL]) - last[RESIDUAL], kb * (total[1] - last[TOTAL + 1]) - last[RESIDUAL + 1], move)) {
      stage->a = last[OWN] + move[0];
      stage->b = last[OWN + 1] + move[1];
      return fabs(move[0]) + fabs(move[1]);
    }
  }
  stage->a = total[0] - path->c[0] - third * (committed[STRETCHING] + 0.5 * third * committed[BENDING]);
  stage->b = total[1] - path->c[0] - h * (committed[STRETCHING] + 0.5 * h * committed[BENDING]);
  if (committed[DURATION] != h)
    return 0.0;
  const double a = committed[OWN], b = committed[OWN + 1], on[2] = {b - 2.0 * a, 4.0 * b - 9.0 * a}; /* the parabola of that step */
  memcpy(slope, committed + SLOPE, sizeof slope);
  if (solve(slope, kb * (stage->a - on[0]), kb * (stage->b - on[1]), move)) {
    stage->a = on[0] + move[0];
    stage->b = on[1] + move[1];
  }
  return 0.0;
}

static void leave(const ed_stage *stage, const double total[2], double u0, double h, double *last)
{
  last[FROM] = u0;
  last[DURATION] = h;
  last[OWN] = stage->a;
  last[OWN + 1] = stage->b;
  memcpy(last + TOTAL, total, 2 * sizeof *last);
  memcpy(last + SLOPE, stage->slope, sizeof stage->slope);
  memcpy(last + RESIDUAL, stage->residual, sizeof stage->residual);
}

static double unbalance(const ed_stage *stage)
{
  return fabs(stage->residual[0]) + fabs(stage->residual[1]);
}

/* Moves the stage towards balance by tangents, where they do not bring it much nearer by chords, then by shorter steps along the tangents;
 * takes the best of what was tried. */
static int improve(const ed_damper *d, const double *committed, double h, const double total[2], ed_stage *stage, double *trial)
{
  const ed_stage before = *stage;
  int status = ED_E_NOT_CONVERGED, tried = 0, last_is_best = 0;
  for (int attempt = 0; attempt < 2 + MOST_HALVINGS; attempt++) {
    const double part = attempt < 2 ? 1.0 : ldexp(1.0, 1 - attempt), enough = attempt < 2 ? 0.5 : 1.0 - 0.25 * part;
    double move[2];
    if (!solve(attempt == 1 ? before.chord : before.slope, -before.residual[0], -before.residual[1], move))
      continue;
    ed_stage next = {.a = before.a + part * move[0], .b = before.b + part * move[1]};
    const int found = evaluate(d, committed, h, total, &next, trial);
    last_is_best = found == ED_OK && (!tried || unbalance(&next) < unbalance(stage));
    if (last_is_best)
      *stage = next;
    tried |= found == ED_OK;
    status = found;
    if (found == ED_OK && unbalance(&next) <= enough * unbalance(&before))
      break;
  }
  if (!tried || last_is_best)
    return tried ? ED_OK : status;
  return evaluate(d, committed, h, total, stage, trial); /* `trial` is that of the stage */
}

/* Moves the stage by the whole tangent, however far from balance that leads: over a fall of the force, before which steps that must come
 * nearer stop. */
static int leap(const ed_damper *d, const double *committed, double h, const double total[2], ed_stage *stage, double *trial)
{
  double move[2];
  if (!solve(stage->slope, -stage->residual[0], -stage->residual[1], move))
    return ED_E_NOT_CONVERGED;
  stage->a += move[0];
  stage->b += move[1];
  return evaluate(d, committed, h, total, stage, trial);
}

static int viscous(const ed_damper *d, int rough, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                   ed_damper_force *out)
{
  const int own = ed_damper_own_size(d);
  const double h = path->h, kb = stiffness(d), u0 = committed[own];
  const double total[2] = {ed_path_u(path, THIRD * h), ed_path_u(path, h)};
  ed_stage stage;
  /* Between trials of one step the balance need only be better than the change from one to the next: the rest is made up to first
   * order below, and vanishes with the change. So is it in a rough trial, which begins with the whole deformation of the step. */
  double rest = BETWEEN_TRIALS * kb * guess(d, committed + own, trial + own, path, total, &stage);
  if (rough && d->joint == 0.0)
    rest = largest(rest, ROUGH * kb * (fabs(total[0] - path->c[0]) + fabs(total[1] - path->c[0])));
  int status = evaluate(d, committed, h, total, &stage, trial);
  for (int i = 0;; i++) {
    if (status != ED_OK)
      return status;
    if (unbalance(&stage) <= largest(TOLERANCE * stage.size, rest))
      break;
    if (i == MOST_ITERATIONS)
      return ED_E_NOT_CONVERGED;
    status = d->n_effects > 0 && i >= PATIENCE ? leap(d, committed, h, total, &stage, trial)
                                                  : improve(d, committed, h, total, &stage, trial);
  }
  double by[2], by_chord[2];
  if (!end_of_solution(stage.slope, by) || !end_of_solution(stage.chord, by_chord))
    return ED_E_NOT_CONVERGED;
  leave(&stage, total, u0, h, trial + own);
  trial[own] = u0 + stage.b;
  trial[own + STRETCHING] = ed_path_v(path, h) - (5.0 * stage.b - 9.0 * stage.a) / (2.0 * h);
  trial[own + BENDING] = 2.0 * path->c[2] + 6.0 * path->c[3] * h - (3.0 * stage.b - 9.0 * stage.a) / (h * h);
  /* What is missing to balance is made up to first order; a corner of the play would spoil that, and there the balance is as near */
  out->force = d->joint > 0.0 ? stage.end.force
                              : kb * (total[1] - u0 - stage.b + by[0] * stage.residual[0] + by[1] * stage.residual[1]);
  for (int i = 0; i < 2; i++) {
    const double of_third = stage.holds[0] * ed_path_u(&direction[i], THIRD * h);
    const double of_end = stage.holds[1] * ed_path_u(&direction[i], h);
    out->slope[i] = stage.holds[1] * kb * (of_end - kb * (by[0] * of_third + by[1] * of_end));
    out->chord[i] = stage.holds[1] * kb * (of_end - kb * (by_chord[0] * of_third + by_chord[1] * of_end)) - out->slope[i];
  }
  return ED_OK;
}

/* ---- laws that do not */

/* A path of the damper's own deformation from u0, by way of the turning point `turn` unless there is none, to `end`; direction: to
 * turn and end. Only the order of deformations counts, so a parabola that turns where it must will do. */
static void own_path(double u0, const double *turn, double end, ed_path *path, ed_path direction[2])
{
  *path = (ed_path){1.0, {u0, end - u0, 0.0, 0.0}};
  direction[0] = (ed_path){1.0, {0.0}};
  direction[1] = (ed_path){1.0, {0.0, 1.0, 0.0, 0.0}};
  if (!turn || *turn == u0 || *turn == end)
    return;
  const double top = 1.0 / (1.0 + sqrt(fabs((*turn - end) / (*turn - u0)))), rise = (*turn - u0) / (top * top);
  path->c[1] = 2.0 * rise * top;
  path->c[2] = -rise;
  direction[0].c[1] = 1.0 / (top * (1.0 - top));
  direction[0].c[2] = -direction[0].c[1];
  direction[1].c[1] = -top / (1.0 - top);
  direction[1].c[2] = 1.0 / (1.0 - top);
}

/* Own deformation at which damper and brace carry the same at `total`: Newton kept between u_from and where the brace is idle. */
static int meet(const ed_damper *d, const double *committed, double u0, const double *turn, double total_from, double total,
                double *found, double *holds, double *trial, ed_damper_force *out)
{
  const double kb = stiffness(d), from = turn ? *turn : u0, full = from + total - total_from;
  double low = fmin(from, full), high = fmax(from, full), u = full;
  for (int i = 0; i < 2 * MOST_ITERATIONS; i++) {
    ed_path path, direction[2];
    own_path(u0, turn, u, &path, direction);
    const int status = ed_damper_own_step(d, committed, &path, direction, trial, out);
    if (status != ED_OK)
      return status;
    const double residual = out->force - kb * strained(d, total - u, holds), slope = out->slope[1] + kb * *holds;
    if (!isfinite(residual))
      return ED_E_NOT_FINITE;
    if (i == 0 && (d->law->softens || d->n_effects > 0)) { /* the force may fall while the damper is deformed further */
      const double reach = 4.0 * fabs(residual) / kb;
      low = u - reach;
      high = u + reach;
    }
    *found = u;
    /* `from` says how large forces of this path are where they pass through zero */
    if (fabs(residual) <= TOLERANCE * (fabs(out->force) + kb * (fabs(total) + fabs(u) + fabs(from))))
      return ED_OK;
    *(residual > 0.0 ? &high : &low) = u;
    u -= residual / slope;
    if (!(u > low && u < high))
      u = 0.5 * (low + high);
    if (u == low || u == high)
      return ED_OK; /* the last digit */
  }
  return ED_E_NOT_CONVERGED;
}

static int hysteretic(const ed_damper *d, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                      ed_damper_force *out)
{
  const int own = ed_damper_own_size(d);
  const double u0 = committed[own], end = ed_path_u(path, path->h);
  double at[2], start = path->c[0], turn = 0.0, turned[2] = {0.0}, found, holds;
  const int reversals = ed_path_reversals(path, at);
  /* Two reversals in one step: the way between them is left out, which only a step far too long would notice. What then goes on beyond
   * the first has not turned there. */
  const double at_turn = reversals > 0 ? ed_path_u(path, at[0]) : start;
  const int one = (end - at_turn) * (at_turn - start) < 0.0;
  if (one) {
    const int status = meet(d, committed, u0, NULL, start, at_turn, &turn, &holds, trial, out);
    if (status != ED_OK)
      return status;
    const double kb = holds * stiffness(d);
    for (int i = 0; kb > 0.0 && i < 2; i++)
      turned[i] = kb * ed_path_u(&direction[i], at[0]) / (out->slope[1] + kb);
    start = at_turn;
  }
  const int status = meet(d, committed, u0, one ? &turn : NULL, start, end, &found, &holds, trial, out);
  if (status != ED_OK)
    return status;
  trial[own] = found;
  const double by_turn = one ? out->slope[0] : 0.0, own_slope = out->slope[1], kb = holds * stiffness(d);
  for (int i = 0; i < 2; i++) {
    const double of_end = ed_path_u(&direction[i], path->h);
    out->slope[i] = kb > 0.0 ? kb * (of_end - (kb * of_end - by_turn * turned[i]) / (own_slope + kb)) : 0.0;
  }
  return ED_OK;
}

int ed_brace_step(const ed_damper *damper, int rough, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out)
{
  return damper->rate_independent ? hysteretic(damper, committed, path, direction, trial, out)
                                       : viscous(damper, rough, committed, path, direction, trial, out);
}
