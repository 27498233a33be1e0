/* Ramberg-Osgood with Masing's rule (Jennings 1964). Skeleton u = F/k (1 + a |F/Fy|^(n-1)); after a reversal at (u_r, F_r) the
 * branch (u - u_r)/2 = skeleton of (F - F_r)/2. Reversals are remembered: a branch that comes back to the reversal before the
 * last closes its loop there and goes on as the branch that the loop interrupted; one that reaches the mirror image of the first
 * reversal goes on along the skeleton.
 * At most REMEMBERED reversals (as many nested half loops). When they are full, a further reversal is forgotten: inside the
 * smallest loop the force goes back and forth along one line, without loss, until it leaves that loop; force and closing of the
 * others stay right. Memory: count, direction of the last motion, force, then (u, F) of each reversal. */
#include "damper/laws.h"
#include "damper/motions.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

enum { REMEMBERED = 64, COUNT = 0, DIRECTION, FORCE, POINTS, N_MEMORY = POINTS + 2 * REMEMBERED };

/* Derivatives of a point of the diagram to the unknowns of the path. */
typedef struct {
  double u[2], force[2];
} moving;

typedef struct {
  double u, force, tangent; /* force and tangent are not numbers where the skeleton's was not found */
  moving moves;
} point;

/* The diagram during one step; reversals before `fresh` do not move with the unknowns. */
typedef struct {
  int n, direction, fresh;
  double *reversal; /* u, F of each */
  moving moves[3];  /* of reversals from `fresh` on; a step makes at most one at its start and two inside */
} diagram;

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  (void)message;
  damper->n_memory = N_MEMORY;
  return ED_OK;
}

/* Force and tangent of the skeleton: f (1 + a f^(n-1)) = x in units of Fy and Fy/k. The left side is convex, so Newton from
 * above goes straight to the root; `guess` is a force near it, or 0. Not a number where it did not get there. */
static double skeleton(const double *p, double u, double guess, double *tangent)
{
  enum { ED_LAW_RAMBERG_OSGOOD_PARAMETERS };
  const double k = p[K], yield = p[FY], a = p[A], n = p[N];
  const double x = fabs(u) * k / yield;
  double f = fabs(guess) / yield, plastic = 0.0;
  int bounded = 0, settled = !(x > 0.0);
  if (!(f > 0.0 && f < x))
    f = x;
  for (int i = 0; i < 100 && !settled; i++) {
    plastic = a * pow(f, n - 1.0);
    const double slope = 1.0 + n * plastic;
    double change = (x - f * (1.0 + plastic)) / slope;
    if (!bounded && !(n * fabs(change) <= f)) { /* far off, where Newton creeps or overflows: begin at the larger share */
      f = fmin(x, pow(x / a, 1.0 / n));
      bounded = 1;
      continue;
    }
    f += change;
    if (fabs(change) <= 1e-9 * f) { /* convergence is quadratic: what is left is rounding */
      plastic *= 1.0 + (n - 1.0) * change / f;
      settled = 1;
    }
  }
  *tangent = settled ? k / (1.0 + n * plastic) : NAN;
  return settled ? copysign(f * yield, u) : NAN;
}

/* The point at u on the present branch; `here` gives the guess. */
static void evaluate(const ed_damper *damper, const diagram *d, const ed_motion *motion, point *here)
{
  const int branch = d->n > 0;
  const double *last = branch ? d->reversal + 2 * (d->n - 1) : NULL;
  const double scale = branch ? 2.0 : 1.0, u_r = branch ? last[0] : 0.0, force_r = branch ? last[1] : 0.0;
  const moving *moves = branch && d->n > d->fresh ? &d->moves[d->n - 1 - d->fresh] : NULL;
  here->u = motion->u;
  here->force = force_r + scale * skeleton(damper->parameter, (motion->u - u_r) / scale, (here->force - force_r) / scale,
                                           &here->tangent);
  for (int j = 0; j < 2; j++) {
    here->moves.u[j] = motion->slope[j];
    here->moves.force[j] = here->tangent * (motion->slope[j] - (moves ? moves->u[j] : 0.0)) + (moves ? moves->force[j] : 0.0);
  }
}

static void reverse(diagram *d, const point *here)
{
  if (d->n == REMEMBERED)
    return;
  d->reversal[2 * d->n] = here->u;
  d->reversal[2 * d->n + 1] = here->force;
  d->moves[d->n - d->fresh] = here->moves;
  d->n++;
}

/* Closes the loops that a motion to u leaves behind. */
static void close_loops(diagram *d, double u)
{
  while (d->n > 0) {
    const double *last = d->reversal + 2 * (d->n - 1);
    /* back along the branch itself, when the reversals are full */
    const int back = d->n == REMEMBERED && (last[-2] - last[0]) * d->direction < 0.0;
    const double target = back ? last[0] : d->n == 1 ? -last[0] : last[-2];
    if ((u - target) * d->direction < 0.0)
      return;
    d->n -= back || d->n == 1 ? 1 : 2;
    if (d->n < d->fresh)
      d->fresh = d->n;
  }
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  memcpy(trial, committed, N_MEMORY * sizeof *trial);
  if (!(trial[COUNT] >= 0.0 && trial[COUNT] <= REMEMBERED && fabs(trial[DIRECTION]) <= 1.0))
    return ED_E_ARGUMENT; /* no state that a step has made */
  ed_motion motion[3];
  const int motions = ed_path_motions(path, direction, motion);
  diagram d = {.n = (int)trial[COUNT], .direction = (int)trial[DIRECTION], .fresh = (int)trial[COUNT], .reversal = trial + POINTS};
  point here = {.u = path->c[0], .force = trial[FORCE]};
  for (int i = 0; i < motions; i++) {
    if (motion[i].sign != 0) {
      if (d.direction != 0 && motion[i].sign != d.direction)
        reverse(&d, &here);
      d.direction = motion[i].sign;
      close_loops(&d, motion[i].u);
    }
    evaluate(damper, &d, &motion[i], &here);
  }
  trial[COUNT] = d.n;
  trial[DIRECTION] = d.direction;
  trial[FORCE] = out->force = here.force;
  out->slope[0] = here.moves.force[0];
  out->slope[1] = here.moves.force[1];
  if (isnan(here.tangent))
    return ED_E_NOT_CONVERGED;
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}

const ed_law ed_ramberg_osgood = {.name = "ramberg_osgood",
                                  .rate_independent = 1,
                                  .prepare = prepare,
                                  .step = step};
