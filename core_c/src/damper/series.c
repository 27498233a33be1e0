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
#include "damper/law.h"
#include "damper/ode_system.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ITERATIONS = 200, PATIENCE = 8, PARTS = 6 };
/* Of the largest force so far. Laws that SUNDIALS integrates carry its tolerance, a tenth of theirs here. */
static const double TOLERANCE = 1e-8, ODE_TOLERANCE = 1e-7;

typedef struct {
  const ed_damper *damper;
  ed_ode_system *system; /* for laws without exact step */
  double stiffness, back, bend, power, within, gap, damping; /* of the rig; half the play */
  double tolerance, largest;
  double force; /* through rig and damper at the end of the step that was settled */
  ed_watch watch;
} series;

/* Of the stretch e at the end of a step that begins at `from`: still + each (e - from). */
typedef struct {
  double still, each;
} rate;

/* What stands beside the law at the end of a step. */
typedef struct {
  double factor, added, spring;
} beside;

static double beyond(const series *in, double stretch)
{
  return fmax(fabs(stretch) - in->gap, 0.0);
}

/* Stiffness at small stretches of the side on which a stretch or a force is. */
static double of_side(const series *in, double sign)
{
  return sign < 0.0 ? in->back * in->stiffness : in->stiffness;
}

/* How many times as stiff as at first, by the secant, parts are at a stretch z. */
static double stiffer(const series *in, double z)
{
  return in->power > 1.0 ? pow(in->bend * z * z, 0.5 * (in->power - 1.0)) : 1.0 + in->bend * z * z;
}

static double carried(const series *in, double stretch)
{
  const double z = beyond(in, stretch), closing = in->within * fmin(fabs(stretch), in->gap);
  return copysign(closing + of_side(in, stretch) * z * stiffer(in, z), stretch);
}

/* Stretch at which parts carry a force, if they stiffen with a power and no play stands before them. */
static double stretched(const series *in, double force)
{
  return copysign(pow(fabs(force) / (of_side(in, force) * pow(in->bend, 0.5 * (in->power - 1.0))), 1.0 / in->power), force);
}

/* Where a force that falls by `slope` (>= 0) from `force` at a stretch meets that of the rig, straight from this stretch on. */
static double meet(const series *in, double stretch, double force, double slope)
{
  const double z = beyond(in, stretch);
  if (in->power > 1.0 && (z == 0.0 || force * stretch < 0.0)) /* no tangent there, or that of the other side: a bracket */
    return stretched(in, force);
  if (z > 0.0 && in->bend > 0.0) {
    const double tangent = of_side(in, stretch) * (in->power > 1.0 ? in->power * stiffer(in, z) : 1.0 + 3.0 * in->bend * z * z);
    const double next = stretch + (force - carried(in, stretch)) / (tangent + slope);
    if (next * stretch > 0.0 && fabs(next) >= in->gap)
      return next;
  }
  const double closed = in->within * in->gap;
  const double at_high = force - slope * (in->gap - stretch), at_low = force + slope * (in->gap + stretch);
  if (at_high > closed)
    return in->gap + (at_high - closed) / (of_side(in, 1.0) + slope);
  if (at_low < -closed)
    return (at_low + closed) / (of_side(in, -1.0) + slope) - in->gap;
  return in->within + slope > 0.0 ? (force + slope * stretch) / (in->within + slope) : fmax(-in->gap, fmin(in->gap, stretch));
}

/* The stretch at the end of a step in which the damper follows `path` + (stretch - from) * direction; *stretch: a first guess. */
static int settle(series *in, const double *committed, double *trial, const ed_path *path, const ed_path direction[2], double from,
                  rate at_end, beside here, double *stretch)
{
  const double rise = fabs(ed_path_u(path, path->h) - path->c[0]);
  double low = -INFINITY, high = INFINITY, next = *stretch, before = 0.0;
  memcpy(trial, committed, (size_t)ed_damper_state_size(in->damper) * sizeof *trial); /* no guess from an older step */
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    const double e = *stretch = next;
    if (ed_watch_step(&in->watch))
      return ED_E_STOPPED;
    ed_path own = *path;
    for (int j = 0; j < 4; j++)
      own.c[j] += (e - from) * direction[0].c[j];
    ed_damper_force out = {0};
    const int status = ed_damper_advance(in->damper, in->system, committed, &own, direction, trial, &out);
    if (status != ED_OK)
      return status;
    const double more = here.added + here.spring * ed_path_u(&own, own.h);
    const double damped = in->damping * (at_end.still + at_end.each * (e - from));
    const double force = here.factor * out.force + more - damped, residual = force - carried(in, e);
    const int swings = residual * before < 0.0 && fabs(residual) > 0.5 * fabs(before);
    const double slope = fmax(here.spring - here.factor * (out.slope[0] + (swings ? out.chord[0] : 0.0)), 0.0);
    if (!isfinite(residual + slope))
      return ED_E_NOT_FINITE;
    in->force = carried(in, e) + damped;
    const double largest = fmax(in->largest, fabs(here.factor * out.force) + fabs(more));
    if (fabs(residual) <= in->tolerance * fmax(largest, slope * rise)) {
      in->largest = largest;
      return ED_OK;
    }
    *(residual > 0.0 ? &low : &high) = e;
    before = residual;
    next = meet(in, e, force, slope + in->damping * at_end.each);
    if (isfinite(low) && isfinite(high) && ((i > PATIENCE && i % 2) || !(next > low && next < high)))
      next = 0.5 * (low + high);
    if (fabs(next - e) <= 2.0 * DBL_EPSILON * (fabs(e) + in->gap))
      return ED_OK; /* the last digit */
  }
  return ED_E_NOT_CONVERGED;
}

static int check(int n, const double *time, const double *u, const double *v, const double *factor, const double *added,
                 const double *spring, int *done)
{
  for (*done = 0; *done < n; ++*done) {
    const int i = *done;
    if (!isfinite(time[i] + u[i] + v[i]) || (factor && !isfinite(factor[i])) || (added && !isfinite(added[i])) ||
        (spring && !isfinite(spring[i])))
      return ED_E_NOT_FINITE;
    if ((i > 0 && !(time[i] > time[i - 1])) || (factor && factor[i] < 0.0) || (spring && spring[i] < 0.0))
      return ED_E_ARGUMENT;
  }
  *done = 0;
  return n >= 1 ? ED_OK : ED_E_ARGUMENT;
}

/* How many times as long as the samples the way to the first of them takes. */
static const double SLOWLY = 1e6;

/* From rest to the first deformation so slowly that nothing viscous is left of the way. */
static int begin(series *in, const double *state, double *trial, double slowly, double u, beside here, double *stretch)
{
  ed_path path, direction[2] = {{slowly, {0.0, 0.0, -3.0 / (slowly * slowly), 2.0 / (slowly * slowly * slowly)}}, {slowly, {0.0}}};
  ed_path_hermite(&path, slowly, 0.0, 0.0, u, 0.0);
  *stretch = fmax(-in->gap, fmin(in->gap, u)); /* pins that nothing pushes move the damper no more than they must */
  return settle(in, state, trial, &path, direction, 0.0, (rate){0.0, 0.0}, here, stretch);
}

/* The rate of the stretch over the step before, and how long that was: infinite where the stretch is linear now. */
typedef struct {
  double rate, lasted;
} past;

static const past NO_PAST = {0.0, INFINITY};

/* One step along `path`, which begins at the deformation less the stretch `from`. *stretch: in, a first guess; out, that at its end. */
static int advance(series *in, const double *committed, double *trial, const ed_path *path, double from, past before, beside here,
                   double *stretch)
{
  const double h = path->h, both = h + before.lasted, bend = 1.0 / (h * both), old = before.rate / both;
  const ed_path direction[2] = {{h, {0.0, h * bend - 1.0 / h, -bend, 0.0}}, {h, {0.0}}};
  ed_path still = *path; /* of the stretch that is again `from` at the end */
  still.c[1] -= h * old;
  still.c[2] += old;
  return settle(in, committed, trial, &still, direction, from, (rate){-h * old, 1.0 / h + h * bend}, here, stretch);
}

static int turns_corner(const series *in, double from, double stretch)
{
  if (in->gap == 0.0)
    return in->back != 1.0 && from * stretch < 0.0;
  return (fabs(from) < in->gap || fabs(stretch) < in->gap || from * stretch < 0.0) &&
         (fabs(from) > in->gap || fabs(stretch) > in->gap);
}

static beside between(const beside ends[2], double share)
{
  return (beside){ends[0].factor + share * (ends[1].factor - ends[0].factor), ends[0].added + share * (ends[1].added - ends[0].added),
                  ends[0].spring + share * (ends[1].spring - ends[0].spring)};
}

/* The same step in PARTS, as the stretch is not linear where pins meet or part. `state` and `trial` are swapped in between; the
 * state at the end is in *trial. */
static int in_parts(series *in, double **state, double **trial, const ed_path *whole, double from, const beside ends[2],
                    double *stretch)
{
  double end = from, change = (*stretch - from) / PARTS;
  for (int i = 0; i < PARTS; i++) {
    const double share = (i + 1.0) / PARTS, begin = end;
    end += change;
    ed_path path;
    ed_path_piece(whole, whole->h * i / PARTS, whole->h * share, &path);
    path.c[0] += from - begin;
    if (i > 0) {
      double *swap = *state;
      *state = *trial;
      *trial = swap;
    }
    const int status = advance(in, *state, *trial, &path, begin, NO_PAST, between(ends, share), &end);
    if (status != ED_OK)
      return status;
    change = end - begin;
  }
  *stretch = end;
  return ED_OK;
}

static beside at(const double *factor, const double *added, const double *spring, int i)
{
  return (beside){factor ? factor[i] : 1.0, added ? added[i] : 0.0, spring ? spring[i] : 0.0};
}

static int run(series *in, double *state, double *trial, int n, const double *time, const double *u, const double *v,
               const double *factor, const double *added, const double *spring, double *force, double *own, int *done)
{
  double stretch, speed = 0.0, speeding = 0.0;
  past before = NO_PAST;
  beside ends[2] = {at(factor, added, spring, 0)};
  const double slowly = SLOWLY * (time[n - 1] - time[0] + 1.0); /* a single sample has no length */
  int status = begin(in, state, trial, slowly, u[0], ends[0], &stretch);
  for (int i = 0; status == ED_OK; i++) {
    double *swap = state;
    state = trial;
    trial = swap;
    force[i] = in->force;
    own[i] = u[i] - stretch;
    if (!isfinite(force[i] + own[i]))
      return ED_E_NOT_FINITE;
    *done = i + 1;
    if (i + 1 == n)
      break;
    const double h = time[i + 1] - time[i], from = stretch;
    ends[1] = at(factor, added, spring, i + 1);
    ed_path path;
    ed_path_hermite(&path, h, u[i], v[i], u[i + 1], v[i + 1]);
    path.c[0] -= from;
    stretch = from + h * (speed + h * speeding);
    status = advance(in, state, trial, &path, from, before, ends[1], &stretch);
    const int corner = status == ED_OK && turns_corner(in, from, stretch);
    if (corner)
      status = in_parts(in, &state, &trial, &path, from, ends, &stretch);
    speeding = ((stretch - from) / h - speed) / h;
    speed = (stretch - from) / h;
    before = corner || (i + 2 < n && time[i + 2] - time[i + 1] > 2.0 * h) ? NO_PAST : (past){speed, h};
    ends[0] = ends[1];
  }
  return status;
}

static int allowed(const ed_rig *rig)
{
  const double all = rig->stiffness + rig->back + rig->bend + rig->power + rig->within + rig->play + rig->damping;
  return isfinite(all) && rig->stiffness > 0.0 && rig->back > 0.0 && rig->bend >= 0.0 && rig->power >= 1.0 && rig->within >= 0.0 &&
         rig->play >= 0.0 && rig->damping >= 0.0 && (rig->power == 1.0 || (rig->bend > 0.0 && rig->play == 0.0));
}

int ed_damper_history_in_series(const ed_damper *damper, int n, const double *time, const double *u, const double *v,
                                const double *factor, const double *added, const double *spring, const ed_rig *rig, double *force,
                                double *own, int *done)
{
  *done = 0;
  if (!allowed(rig))
    return ED_E_ARGUMENT;
  int status = check(n, time, u, v, factor, added, spring, done);
  if (status != ED_OK)
    return status;
  series in = {.damper = damper, .stiffness = rig->stiffness, .back = rig->back, .bend = rig->bend, .power = rig->power,
               .within = rig->within, .gap = 0.5 * rig->play, .damping = rig->damping, .watch = ed_watch_of(&damper->stop)};
  in.tolerance = TOLERANCE;
  if (!ed_damper_has_exact_step(damper)) {
    in.tolerance = ODE_TOLERANCE;
    in.system = ed_ode_system_new(1, &damper, 0.1 * ODE_TOLERANCE, &status);
    if (!in.system)
      return status;
    ed_ode_system_watch(in.system, &in.watch);
  }
  const size_t size = (size_t)ed_damper_state_size(damper);
  double *state = calloc(2 * size + 1, sizeof *state);
  status = state ? ED_OK : ED_E_MEMORY;
  if (state) {
    ed_damper_start(damper, state);
    ed_amendments_start(damper, state, 0);
    status = run(&in, state, state + size, n, time, u, v, factor, added, spring, force, own, done);
  }
  free(state);
  ed_ode_system_free(in.system);
  return status;
}
