/* A damper in a test rig whose pins have play and whose parts are flexible: u = u_d + e, and
 *
 *   factor F(u_d) + added + spring u_d = within (e - z) + stiffness * side * z (1 + bend z^2), z: e beyond half the play, either way,
 *
 * or stiffness * side * z |sqrt(bend) z|^(power - 1) beyond it, as of bodies in contact; side: `back` where e < 0, else 1. Beside all of
 * it damping e'.
 *
 * The stretch e of the rig balances at the end of a step, over which it is a parabola in time through its ends and the sample before:
 * its rate at the end is that of the second backward difference. It is linear over the first step, over parts of a step in which it
 * turns a corner, over the step after that, and over one much longer than the one before, with which that difference is not stable.
 * What the damper's own deformation u_d then does is a cubic, that its law meets exactly. The force of the law falls as e grows, that
 * of the rig rises: there is one balance. Newton's method with the law's own tangent finds it, the corners of the rig taken as they
 * are; bisection where that leaves the bracket.
 *
 * Third order in the sampling step; second order for laws whose force jumps with the velocity (a bare dashpot), first order where a
 * power of the velocity is steep at rest, and where e turns a corner of the rig inside a step; second order with damping of the rig,
 * whose force takes the rate at the end as it is. */
#include "damper/run_of_test.h"
#include "damper/rig.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST_ITERATIONS = 200, PATIENCE = 8, PARTS = 6 };
/* Of the largest force so far. Laws that SUNDIALS integrates carry its tolerance, ED_SERIES_TOLERANCE, a tenth of theirs here. */
static const double TOLERANCE = 1e-8, ODE_TOLERANCE = 1e-7;
/* Of Newton's first move: what the curvature of the step before may add to it. */
static const double STRAIGHT = 0.1;

typedef struct {
  ed_test_run *run;
  const ed_rig *rig;
  double gap; /* half the play */
  double tolerance, largest;
  double force; /* through rig and damper at the end of the step that was settled */
  /* Of the last step that Newton's method moved, for the guesses of the next one: */
  double share; /* of a change of the deformation that the stretch takes */
  double bend;  /* residual that the first move by the tangent left, over the square of that move */
} series;

/* Of the stretch e at the end of a step that begins at `from`: still + each (e - from). */
typedef struct {
  double still, each;
} rate;

/* What stands beside the law at the end of a step. */
typedef struct {
  double factor, added, spring;
} beside;

/* The stretch at the end of a step in which the damper follows `path` + (stretch - from) * direction; *stretch: a first guess. */
static int settle(series *in, const ed_path *path, const ed_path direction[2], double from, rate at_end, beside here,
                  double *stretch)
{
  const double rise = fabs(ed_path_u(path, path->h) - path->c[0]);
  const ed_stepper *stepper = &in->run->stepper;
  const double *committed = in->run->state, damping = in->rig->damping;
  double low = -INFINITY, high = INFINITY, next = *stretch, before = 0.0, *trial = in->run->trial;
  double moved = 0.0, more_moved = 0.0, tangent = NAN; /* Newton's first move, and what the curvature adds */
  memcpy(trial, committed, (size_t)ed_damper_state_size(stepper->damper) * sizeof *trial); /* no guess from an older step */
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    const double e = *stretch = next;
    if (ed_watch_step(in->run->watch))
      return ED_E_STOPPED;
    ed_path own = *path;
    for (int j = 0; j < 4; j++)
      own.c[j] += (e - from) * direction[0].c[j];
    ed_damper_force out = {0};
    const int status = ed_stepper_along(stepper, committed, &own, direction, trial, &out);
    if (status != ED_OK)
      return status;
    const double more = here.added + here.spring * ed_path_u(&own, own.h);
    const double damped = damping * (at_end.still + at_end.each * (e - from));
    const double force = here.factor * out.force + more - damped, residual = force - ed_rig_carries(in->rig, e);
    const int oscillates = residual * before < 0.0 && fabs(residual) > 0.5 * fabs(before);
    if (i == 1) /* what the tangent alone would have left */
      in->bend = isfinite(tangent) && moved != 0.0 ? (residual + tangent * more_moved) / (moved * moved) : 0.0;
    const double slope = fmax(here.spring - here.factor * (out.slope[0] + (oscillates ? out.chord[0] : 0.0)), 0.0);
    if (!isfinite(residual + slope))
      return ED_E_NOT_FINITE;
    in->force = ed_rig_carries(in->rig, e) + damped;
    const double largest = fmax(in->largest, fabs(here.factor * out.force) + fabs(more));
    if (fabs(residual) <= in->tolerance * fmax(largest, slope * rise)) {
      in->largest = largest;
      return ED_OK;
    }
    *(residual > 0.0 ? &low : &high) = e;
    before = residual;
    next = ed_rig_meets(in->rig, e, force, slope + damping * at_end.each);
    if (i == 0) { /* on by what the curvature of the step before adds, so that most steps need no third trial */
      moved = next - e;
      tangent = residual / moved;
      in->share = fmin(fmax(slope / tangent, 0.0), 1.0);
      more_moved = in->bend * moved * moved / tangent;
      if (!(fabs(more_moved) < STRAIGHT * fabs(moved)))
        more_moved = 0.0;
      next += more_moved;
    }
    if (isfinite(low) && isfinite(high) && ((i > PATIENCE && i % 2) || !(next > low && next < high)))
      next = 0.5 * (low + high);
    if (fabs(next - e) <= 2.0 * DBL_EPSILON * (fabs(e) + in->gap))
      return ED_OK; /* the last digit */
  }
  return ED_E_NOT_CONVERGED;
}

/* How many times as long as the samples the way to the first of them takes. */
static const double SLOWLY = 1e6;

/* Along a path at whose beginning and end nothing moves, with the stretch. */
static int hold(series *in, double h, double u0, double u1, double from, beside here, double *stretch)
{
  const ed_path direction[2] = {{h, {0.0, 0.0, -3.0 / (h * h), 2.0 / (h * h * h)}}, {h, {0.0}}};
  ed_path path;
  ed_path_hermite(&path, h, u0, 0.0, u1, 0.0);
  ed_stepper_plan(&in->run->stepper, &path);
  return settle(in, &path, direction, from, (rate){0.0, 0.0}, here, stretch);
}

/* From rest to the first deformation so slowly that nothing viscous is left of the way, and then what the test before left. */
static int begin(series *in, double slowly, double u, beside here, double *stretch)
{
  ed_test_run *run = in->run;
  *stretch = fmax(-in->gap, fmin(in->gap, u)); /* pins that nothing pushes move the damper no more than they must */
  const int status = hold(in, slowly, 0.0, u, 0.0, here, stretch);
  if (status != ED_OK || !run->before || run->stepper.damper->n_effects == 0)
    return status;
  const double from = *stretch;
  ed_test_run_accept(run);
  ed_effects_keep(run->stepper.damper, run->before, run->state);
  return hold(in, run->rest, u - from, u - from, from, here, stretch);
}

/* The rate of the stretch over the step before, and how long that was: infinite where the stretch is linear now. */
typedef struct {
  double rate, lasted;
} past;

static const past NO_PAST = {0.0, INFINITY};

/* One step along `path`, which begins at the deformation less the stretch `from`. *stretch: in, a first guess; out, that at its end. */
static int advance(series *in, const ed_path *path, double from, past before, beside here,
                   double *stretch)
{
  const double h = path->h, both = h + before.lasted, bend = 1.0 / (h * both), old = before.rate / both;
  const ed_path direction[2] = {{h, {0.0, h * bend - 1.0 / h, -bend, 0.0}}, {h, {0.0}}};
  ed_path still = *path; /* of the stretch that is again `from` at the end */
  still.c[1] -= h * old;
  still.c[2] += old;
  ed_stepper_plan(&in->run->stepper, path);
  return settle(in, &still, direction, from, (rate){-h * old, 1.0 / h + h * bend}, here, stretch);
}

static int turns_corner(const series *in, double from, double stretch)
{
  if (in->gap == 0.0)
    return in->rig->back != 1.0 && from * stretch < 0.0;
  return (fabs(from) < in->gap || fabs(stretch) < in->gap || from * stretch < 0.0) &&
         (fabs(from) > in->gap || fabs(stretch) > in->gap);
}

static beside between(const beside ends[2], double share)
{
  return (beside){ends[0].factor + share * (ends[1].factor - ends[0].factor), ends[0].added + share * (ends[1].added - ends[0].added),
                  ends[0].spring + share * (ends[1].spring - ends[0].spring)};
}

/* The same step in PARTS, as the stretch is not linear where pins meet or part. */
static int in_parts(series *in, const ed_path *whole, double from, const beside ends[2], double *stretch)
{
  double end = from, change = (*stretch - from) / PARTS;
  for (int i = 0; i < PARTS; i++) {
    const double share = (i + 1.0) / PARTS, begin = end;
    end += change;
    ed_path path;
    ed_path_piece(whole, whole->h * i / PARTS, whole->h * share, &path);
    path.c[0] += from - begin;
    if (i > 0)
      ed_test_run_accept(in->run);
    const int status = advance(in, &path, begin, NO_PAST, between(ends, share), &end);
    if (status != ED_OK)
      return status;
    change = end - begin;
  }
  *stretch = end;
  return ED_OK;
}

static beside at(const ed_test *test, int i)
{
  return (beside){test->factor ? test->factor[i] : 1.0, test->added ? test->added[i] : 0.0, test->spring ? test->spring[i] : 0.0};
}

/* Rate over the last step, and its change over the time of that step. */
typedef struct {
  double rate, change;
} course;

/* What a quantity changes by over the next step if both go on. */
static double led_to(const course *of, double h)
{
  return h * (of->rate + h * of->change);
}

static void take_course(course *of, double h, double by)
{
  of->change = (by / h - of->rate) / h;
  of->rate = by / h;
}

int ed_test_run_in_series(ed_test_run *run, const ed_test *test, double *force, double *own, int *done)
{
  const double *time = test->time, *u = test->u, *v = test->v;
  const int n = test->n;
  series in = {.run = run, .rig = test->rig, .gap = 0.5 * test->rig->play,
               .tolerance = run->stepper.system ? ODE_TOLERANCE : TOLERANCE};
  double stretch;
  course of_u = {0.0, 0.0}, of_stretch = {0.0, 0.0};
  past before = NO_PAST;
  beside ends[2] = {at(test, 0)};
  const double slowly = SLOWLY * (time[n - 1] - time[0] + 1.0); /* a single sample has no length */
  ed_test_run_begin(run);
  int status = begin(&in, slowly, u[0], ends[0], &stretch);
  for (int i = 0; status == ED_OK; i++) {
    ed_test_run_accept(run);
    force[i] = in.force;
    own[i] = u[i] - stretch;
    if (!isfinite(force[i] + own[i]))
      return ED_E_NOT_FINITE;
    *done = i + 1;
    if (i + 1 == n)
      break;
    const double h = time[i + 1] - time[i], from = stretch;
    ends[1] = at(test, i + 1);
    ed_path path;
    ed_path_hermite(&path, h, u[i], v[i], u[i + 1], v[i + 1]);
    path.c[0] -= from;
    const double strayed = u[i + 1] - u[i] - led_to(&of_u, h); /* as noise of the motion does, which no course shows */
    stretch = from + led_to(&of_stretch, h) + in.share * strayed;
    status = advance(&in, &path, from, before, ends[1], &stretch);
    const int corner = status == ED_OK && turns_corner(&in, from, stretch);
    if (corner)
      status = in_parts(&in, &path, from, ends, &stretch);
    take_course(&of_u, h, u[i + 1] - u[i]);
    take_course(&of_stretch, h, stretch - from);
    before = corner || (i + 2 < n && time[i + 2] - time[i + 1] > 2.0 * h) ? NO_PAST : (past){of_stretch.rate, h};
    ends[0] = ends[1];
  }
  return status;
}
