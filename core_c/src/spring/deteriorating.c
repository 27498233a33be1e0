#include "spring/deteriorating.h"

#include <math.h>
#include <string.h>

/* Of the elastic stiffness: by how much unloading stays steeper than the bounds it has to meet. */
static const double STEEPER = 1e-6;

/* A state as its law reads it; it lies in doubles so that states are copied whole. */
typedef struct {
  double deformation, force;
  double unloading;           /* stiffness */
  double yield[2], hardening[2]; /* yield force, slope after it */
  double softening[2], reference[2]; /* the line after capping: how it falls, its force at no deformation */
  double work;                /* done on it so far */
  double at_crossing;         /* energy dissipated when the force last passed zero */
  double at_reversal;         /* and when the path last left a bound */
  double bound;               /* side of the bound that it is on: 1, -1; 0: on none */
  double failed;              /* 1: carries nothing from the next step on */
  double tangent;
} state_of;

_Static_assert(sizeof(state_of) == ED_DETERIORATING_STATE * sizeof(double), "the state is as long as it says");

void ed_deteriorating_initialise(const ed_deteriorating *law, double *state)
{
  state_of s;
  memset(&s, 0, sizeof s);
  s.unloading = s.tangent = law->stiffness;
  for (int i = 0; i < 2; i++) {
    const ed_deteriorating_side *side = &law->side[i];
    s.yield[i] = side->yield;
    s.hardening[i] = (side->capped - 1.0) * side->yield / side->plastic;
    const double at_capping = side->yield / law->stiffness + side->plastic;
    s.softening[i] = side->capped * side->yield / side->capping;
    s.reference[i] = side->capped * side->yield + s.softening[i] * at_capping;
  }
  memcpy(state, &s, sizeof s);
}

int ed_deteriorating_valid(const double *state)
{
  state_of s;
  memcpy(&s, state, sizeof s);
  return s.unloading > 0.0 && (s.failed == 0.0 || s.failed == 1.0) && (s.bound == 0.0 || fabs(s.bound) == 1.0);
}

/* Of the capacity that is left, what the last excursion used, to the power c (Ibarra et al. 2005, Eq. 3); 1: nothing is left. */
static double deterioration(const ed_deteriorating *law, int kind, double before, double now)
{
  if (law->capacity[kind] == HUGE_VAL)
    return 0.0;
  const double used = fmax(now - before, 0.0), left = law->capacity[kind] - now;
  return used < left ? pow(used / left, law->exponent[kind]) : 1.0;
}

/* The line of the bound that counts at x, on a side i where x and forces are positive along it; its slope. */
static double bound_at(const ed_deteriorating *law, const state_of *s, int i, double x, double *slope)
{
  const double harder = s->yield[i] + s->hardening[i] * (x - s->yield[i] / law->stiffness);
  const double softer = s->reference[i] - s->softening[i] * x, residual = law->side[i].residual * law->side[i].yield;
  const double higher = fmin(harder, softer);
  *slope = higher < residual ? 0.0 : harder < softer ? s->hardening[i] : -s->softening[i];
  return fmax(higher, residual);
}

/* Along the bound of a side to x: where its lines meet on the way the work is summed piece by piece. */
static void follow_bound(const ed_deteriorating *law, state_of *s, int i, double x)
{
  const double sign = i == 0 ? 1.0 : -1.0;
  const ed_deteriorating_side *side = &law->side[i];
  const double after = s->softening[i], residual = side->residual * side->yield;
  const double origin = s->yield[i] - s->hardening[i] * s->yield[i] / law->stiffness; /* of the hardening line, at x = 0 */
  const double corner[3] = {s->hardening[i] > 0.0 ? (residual - origin) / s->hardening[i] : -HUGE_VAL,
                            (s->reference[i] - origin) / (s->hardening[i] + after), (s->reference[i] - residual) / after};
  double from = sign * s->deformation, slope, force = bound_at(law, s, i, from, &slope);
  for (int k = 0; k <= 3; k++) {
    const double to = k < 3 ? fmin(corner[k], x) : x;
    if (!(to > from))
      continue;
    const double next = bound_at(law, s, i, to, &slope);
    s->work += 0.5 * (force + next) * (to - from);
    force = next;
    from = to;
  }
  bound_at(law, s, i, x, &slope);
  s->deformation = sign * x;
  s->force = sign * force;
  s->tangent = slope;
  s->bound = sign;
  if (x >= side->ultimate)
    s->failed = 1.0;
}

/* Where the line of the unloading stiffness through the present point meets the bound of a side, not before the point. */
static double meets_bound(const ed_deteriorating *law, const state_of *s, int i)
{
  const double sign = i == 0 ? 1.0 : -1.0, x = sign * s->deformation, m = sign * s->force;
  const ed_deteriorating_side *side = &law->side[i];
  const double after = s->softening[i], residual = side->residual * side->yield;
  const double origin = s->yield[i] - s->hardening[i] * s->yield[i] / law->stiffness;
  const double harder = (origin + s->hardening[i] * x - m) / (s->unloading - s->hardening[i]);
  const double softer = (s->reference[i] - after * x - m) / (s->unloading + after);
  const double further = (residual - m) / s->unloading;
  return x + fmax(0.0, fmax(fmin(harder, softer), further));
}

static void elastically(state_of *s, double deformation)
{
  const double before = s->force;
  s->force += s->unloading * (deformation - s->deformation);
  s->work += 0.5 * (before + s->force) * (deformation - s->deformation);
  s->deformation = deformation;
  s->tangent = s->unloading;
  s->bound = 0.0;
}

static void move(const ed_deteriorating *law, state_of *s, double deformation)
{
  if (s->failed != 0.0) { /* the force that was left goes in this step */
    s->work += 0.5 * s->force * (deformation - s->deformation);
    s->deformation = deformation;
    s->force = s->tangent = s->bound = 0.0;
    return;
  }
  if (deformation == s->deformation)
    return;
  const int i = deformation > s->deformation ? 0 : 1; /* the side that is moved to */
  const double sign = i == 0 ? 1.0 : -1.0;
  if (s->bound == -sign) {
    const double dissipated = s->work - 0.5 * s->force * s->force / s->unloading;
    const double share = deterioration(law, ED_DETERIORATE_UNLOADING, s->at_reversal, dissipated);
    if (share >= 1.0)
      s->failed = 1.0;
    /* never below the slope of a bound, which the path would then not meet */
    const double steepest = fmax(s->hardening[0], s->hardening[1]);
    s->unloading = fmax(s->unloading * (1.0 - share), steepest + STEEPER * law->stiffness);
    s->at_reversal = dissipated;
    s->bound = 0.0;
  }
  if (sign * s->force <= 0.0 && s->bound != sign) {
    const double zero = s->deformation - s->force / s->unloading;
    if (sign * (deformation - zero) <= 0.0) {
      elastically(s, deformation);
      return;
    }
    elastically(s, zero);
    s->force = 0.0;
    const double rate = law->side[i].rate;
    const double strength = rate * deterioration(law, ED_DETERIORATE_STRENGTH, s->at_crossing, s->work);
    const double capping = rate * deterioration(law, ED_DETERIORATE_CAPPING, s->at_crossing, s->work);
    if (strength >= 1.0 || capping >= 1.0) {
      s->failed = 1.0;
      s->deformation = deformation;
      s->tangent = 0.0;
      return;
    }
    const double residual = law->side[i].residual * law->side[i].yield, above = s->yield[i] - residual;
    s->yield[i] *= 1.0 - strength;
    s->hardening[i] *= 1.0 - strength;
    s->softening[i] *= above > 0.0 ? fmax(s->yield[i] - residual, 0.0) / above : 0.0;
    s->reference[i] *= 1.0 - capping;
    s->at_crossing = s->work;
  }
  const double meeting = sign * meets_bound(law, s, i);
  if (sign * (deformation - meeting) < 0.0) {
    elastically(s, deformation);
    return;
  }
  elastically(s, meeting);
  follow_bound(law, s, i, sign * deformation);
}

void ed_deteriorating_trial(const ed_deteriorating *law, const double *state, double deformation, double *force, double *tangent)
{
  state_of s;
  memcpy(&s, state, sizeof s);
  move(law, &s, deformation);
  *force = s.force;
  *tangent = s.tangent;
}

double ed_deteriorating_commit(const ed_deteriorating *law, double *state, double deformation)
{
  state_of s;
  memcpy(&s, state, sizeof s);
  const double before = s.work - ed_deteriorating_stored(state);
  move(law, &s, deformation);
  memcpy(state, &s, sizeof s);
  return s.work - ed_deteriorating_stored(state) - before;
}

double ed_deteriorating_stored(const double *state)
{
  state_of s;
  memcpy(&s, state, sizeof s);
  return 0.5 * s.force * s.force / s.unloading;
}

double ed_deteriorating_left(const ed_deteriorating *law, const double *state)
{
  state_of s;
  memcpy(&s, state, sizeof s);
  return s.failed != 0.0 ? 0.0 : fmin(s.yield[0] / law->side[0].yield, s.yield[1] / law->side[1].yield);
}
