/* Menegotto & Pinto (1973) with the curvature rule of Filippou, Popov & Bertero (1983), no isotropic hardening.
 *
 * A branch runs from a reversal point towards the asymptote of its direction. The classical rule forgets the branch it left,
 * so that a small unloading and reloading rises above the curve that would have been followed without it. Here the branches that
 * were left are remembered as long as a new one begins ahead of them: the response is the lowest of the new branch and those
 * remembered for its direction (the highest when loading downwards) and, where it meets one, continues on it.
 */
#include "material/menegotto_pinto.h"

#include <math.h>
#include <string.h>

enum { BRANCH = 5, DEPTH = 4 }; /* doubles of a branch; reversals inside reversals that are remembered */
typedef struct {
  double strain_r, stress_r; /* reversal point */
  double strain_0, stress_0; /* meeting point of the elastic line and the asymptote */
  double R;
} branch;

typedef struct {
  double count;
  branch left[DEPTH]; /* from the widest to the innermost */
} memory;

typedef struct {
  branch now;       /* being followed */
  memory up, down;  /* branches left while loading upwards, downwards */
  double direction; /* +1, -1; 0 while virgin */
  double strain_max, strain_min;
  double strain, stress;
} mp_state;

_Static_assert(sizeof(mp_state) == (BRANCH + 2 * (1 + DEPTH * BRANCH) + 5) * sizeof(double), "state is plain doubles");
_Static_assert(sizeof(mp_state) == ED_MENEGOTTO_PINTO_STATE * sizeof(double), "state fits");

static void follow(const ed_steel *steel, const branch *path, double strain, double *stress, double *tangent)
{
  const double b = steel->hardening;
  const double x = (strain - path->strain_r) / (path->strain_0 - path->strain_r);
  const double range = path->stress_0 - path->stress_r;
  /* x / (1 + |x|^R)^(1/R) and its slope, by the power of |x| or 1/|x|, whichever is below 1: nothing overflows.
   * Exponentials and logarithms are quicker than powers. */
  const double size = fabs(x);
  const double power = exp(-path->R * fabs(log(size)));
  const double root = exp(log1p(power) / path->R);
  const double curve = (size > 1.0 ? copysign(1.0, x) : x) / root;
  const double slope = (size > 1.0 ? power / size : 1.0) / (root * (1.0 + power));
  *stress = path->stress_r + range * (b * x + (1.0 - b) * curve);
  *tangent = range / (path->strain_0 - path->strain_r) * (b + (1.0 - b) * slope);
}

/* New branch from (strain, stress) in `direction`. */
static branch turn(const ed_steel *steel, const mp_state *state, double direction)
{
  const double yield_strain = steel->fy / steel->E;
  const double b = steel->hardening;
  branch path = {.strain_r = state->strain, .stress_r = state->stress, .R = steel->R0};
  /* elastic line through the reversal point meets stress = direction fy (1 - b) + b E strain */
  path.strain_0 =
      (direction * steel->fy * (1.0 - b) - state->stress + steel->E * state->strain) / (steel->E * (1.0 - b));
  const double shortest = 1e-12 * yield_strain; /* a turn on the asymptote itself leaves no elastic part */
  if (direction * (path.strain_0 - path.strain_r) < shortest)
    path.strain_0 = path.strain_r + direction * shortest;
  path.stress_0 = path.stress_r + steel->E * (path.strain_0 - path.strain_r);
  const double extreme = direction > 0.0 ? state->strain_max : state->strain_min;
  const double excursion = fabs((extreme - path.strain_0) / yield_strain);
  path.R = steel->R0 * (1.0 - steel->cR1 * excursion / (steel->cR2 + excursion));
  return path;
}

static memory *of(mp_state *state, double direction)
{
  return direction > 0.0 ? &state->up : &state->down;
}

/* Does the present point lie beyond the beginning of a branch, and on its inner side? */
static int ahead(const ed_steel *steel, const mp_state *state, double direction, const branch *path)
{
  double stress, tangent;
  if (direction * (state->strain - path->strain_r) <= 0.0)
    return 0;
  follow(steel, path, state->strain, &stress, &tangent);
  return direction * (state->stress - stress) <= 0.0;
}

/* State with the branch that leads to `strain`; works on a copy. */
static void prepare(const ed_steel *steel, mp_state *state, double strain)
{
  const double change = strain - state->strain;
  if (change == 0.0)
    return;
  const double direction = change > 0.0 ? 1.0 : -1.0;
  if (state->direction == 0.0) { /* virgin: both directions start at the origin */
    const double yield_strain = steel->fy / steel->E;
    state->now = (branch){0.0, 0.0, direction * yield_strain, direction * steel->fy, steel->R0};
    state->direction = direction;
    state->strain_max = yield_strain;
    state->strain_min = -yield_strain;
    return;
  }
  if (direction == state->direction)
    return;
  memory *leaving = of(state, state->direction), *entering = of(state, direction);
  if (leaving->count == DEPTH)
    leaving->count--; /* the wide ones matter: forget the innermost */
  leaving->left[(int)leaving->count++] = state->now;
  /* a return behind the beginning of a branch, or across it, erases it */
  while (entering->count > 0.0 && !ahead(steel, state, direction, &entering->left[(int)entering->count - 1]))
    entering->count--;
  state->now = turn(steel, state, direction);
  state->direction = direction;
}

/* Stress on the path, bounded by what is remembered. The return is the index of the governing branch, -1: the one followed. */
static int respond(const ed_steel *steel, mp_state *state, double strain, double *stress, double *tangent)
{
  if (state->direction == 0.0) {
    *stress = state->stress;
    *tangent = steel->E;
    return -1;
  }
  int governing = -1;
  const memory *bounds = of(state, state->direction);
  follow(steel, &state->now, strain, stress, tangent);
  for (int i = (int)bounds->count - 1; i >= 0; i--) {
    double bound, bound_tangent;
    follow(steel, &bounds->left[i], strain, &bound, &bound_tangent);
    if (state->direction * (*stress - bound) > 0.0) {
      *stress = bound;
      *tangent = bound_tangent;
      governing = i;
    }
  }
  return governing;
}

int ed_menegotto_pinto_valid(const double *committed)
{
  mp_state state;
  memcpy(&state, committed, sizeof state);
  return state.up.count >= 0.0 && state.up.count <= DEPTH && state.down.count >= 0.0 && state.down.count <= DEPTH;
}

void ed_menegotto_pinto_trial(const ed_steel *steel, const double *committed, double strain, double *stress,
                              double *tangent)
{
  mp_state state;
  memcpy(&state, committed, sizeof state);
  prepare(steel, &state, strain);
  respond(steel, &state, strain, stress, tangent);
}

double ed_menegotto_pinto_commit(const ed_steel *steel, double *committed, double strain)
{
  mp_state state;
  double stress, tangent;
  memcpy(&state, committed, sizeof state);
  prepare(steel, &state, strain);
  const int governing = respond(steel, &state, strain, &stress, &tangent);
  if (governing >= 0) { /* back on a curve that was left; nothing remains of the reversals inside it */
    memory *bounds = of(&state, state.direction);
    state.now = bounds->left[governing];
    bounds->count = governing;
  }
  const double work = 0.5 * (state.stress + stress) * (strain - state.strain);
  const double stored = ed_steel_stored(steel, stress) - ed_steel_stored(steel, state.stress);
  state.strain = strain;
  state.stress = stress;
  if (strain > state.strain_max)
    state.strain_max = strain;
  if (strain < state.strain_min)
    state.strain_min = strain;
  memcpy(committed, &state, sizeof state);
  return work - stored;
}
