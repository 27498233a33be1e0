/* Fibres of the Menegotto-Pinto law in vectors, beside the law written out plainly: that evaluates every remembered branch at every
 * strain, by the C library's functions. And the bits of a processor with AVX beside those of one without. */
#define ED_NO_CLONES

#include "material/menegotto_pinto.h"

#include "base/lanes.h"
#include "checks.h"
#include "numbers.h"
#include "steels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The same source once more, as for a processor without AVX. */
#define ed_menegotto_pinto_place without_avx_place
#define ed_menegotto_pinto_set without_avx_set
#define ed_menegotto_pinto_initialise without_avx_initialise
#define ed_menegotto_pinto_valid without_avx_valid
#define ed_menegotto_pinto_stress without_avx_stress
#define ed_menegotto_pinto_trial without_avx_trial
#define ed_menegotto_pinto_commit without_avx_commit
#define respond respond_in_vectors
#define reverse reverse_in_vectors
#include "../src/material/menegotto_pinto.c"
#undef ed_menegotto_pinto_place
#undef ed_menegotto_pinto_set
#undef ed_menegotto_pinto_initialise
#undef ed_menegotto_pinto_valid
#undef ed_menegotto_pinto_stress
#undef ed_menegotto_pinto_trial
#undef ed_menegotto_pinto_commit
#undef respond
#undef reverse

/* ---- the law, plainly ---- */

enum { REMEMBERED = 4 };
typedef struct {
  double strain_r, stress_r; /* where it begins */
  double strain_0, stress_0; /* meeting point of the elastic line and the asymptote */
  double R;
} branch;

typedef struct {
  double count;
  branch left[REMEMBERED]; /* from the widest to the innermost */
} memory;

typedef struct {
  branch now;       /* being followed */
  memory up, down;  /* branches left while loading upwards, downwards */
  double direction; /* +1, -1; 0 while virgin */
  double strain_max, strain_min;
  double strain, stress;
  int forgot;       /* has left more branches than it remembers */
} mp_state;


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
  return direction * (state->stress - stress) <= 2e-12 * steel->fy; /* on it counts as inside */
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
  if (leaving->count == REMEMBERED) {
    leaving->count--; /* the wide ones matter: forget the innermost */
    state->forgot = 1;
  }
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

static double advance(const ed_steel *steel, mp_state *state, double strain, double *stress, double *tangent)
{
  prepare(steel, state, strain);
  const int governing = respond(steel, state, strain, stress, tangent);
  if (governing >= 0) {
    memory *bounds = of(state, state->direction);
    state->now = bounds->left[governing];
    bounds->count = governing;
  }
  const double work = 0.5 * (state->stress + *stress) * (strain - state->strain);
  const double stored = ed_steel_stored(steel, *stress) - ed_steel_stored(steel, state->stress);
  state->strain = strain;
  state->stress = *stress;
  state->strain_max = fmax(state->strain_max, strain);
  state->strain_min = fmin(state->strain_min, strain);
  return work - stored;
}

/* ---- side by side ---- */

enum { FIBRES = 40, STATE = FIBRES * ED_MENEGOTTO_PINTO_STATE };
static const double E = 2.1e11, FY = 275e6, YIELD = 275e6 / 2.1e11;

typedef struct {
  ed_steel steel[FIBRES];
  ed_menegotto_pinto law;
  double block[FIBRES * ED_MENEGOTTO_PINTO_ARRAYS], state[STATE], other[STATE], strain[FIBRES];
  mp_state plain[FIBRES];
} fibres;

static void set_up(fibres *f, int plain_turns)
{
  memset(f, 0, sizeof *f);
  ed_menegotto_pinto_place(&f->law, FIBRES, f->block);
  f->law.plain_turns = plain_turns;
  for (int i = 0; i < FIBRES; i++) {
    f->steel[i] = menegotto_pinto_steel(E, FY * (1.0 + 0.02 * i), 0.01 * (i % 4));
    f->steel[i].R0 = 3.0 + i % 7 * 3.0;
    ed_menegotto_pinto_set(&f->law, i, &f->steel[i]);
  }
  ed_menegotto_pinto_initialise(&f->law, f->state);
  ed_menegotto_pinto_initialise(&f->law, f->other);
}

/* A path of a fibre: waves of many sizes on a slow one, so that reversals lie within reversals. */
static double path(int fibre, int step, double size)
{
  const double t = 0.011 * step * (1.0 + 0.05 * fibre);
  return size * YIELD * (3.0 * sin(0.4 * t) + sin(2.3 * t + fibre) + 0.3 * sin(9.0 * t) + 0.05 * sin(41.0 * t));
}

/* Farthest from its tangent, in yield stresses, that a stress gets where each fibre moves by some part of the reach of a trial. */
static double nonlinearity(const fibres *f, const double *stress, const double *tangent, double reach, numbers *source)
{
  double strain[FIBRES], moved[FIBRES], there[FIBRES], ignored[FIBRES], ignored_reach, worst = 0.0;
  for (int i = 0; i < FIBRES; i++) {
    moved[i] = (i % 2 ? next_number(source, -1.0, 1.0) : i % 4 - 1.0) * reach;
    strain[i] = f->strain[i] + moved[i];
  }
  ed_menegotto_pinto_trial(&f->law, f->state, 0, FIBRES, strain, there, ignored, &ignored_reach);
  for (int i = 0; i < FIBRES; i++)
    worst = fmax(worst, fabs(there[i] - stress[i] - tangent[i] * moved[i]) / f->steel[i].fy);
  return worst;
}

/* Responses at strains on both sides of the committed ones, then the commit. Two things part the two: powers and exponentials, 2e-14,
 * with exponents up to 21 in the innermost; and a branch's line, in which 4e-15 is left out. */
static void check_beside_plain(double size, int plain_turns)
{
  static fibres f;
  numbers source = {29};
  set_up(&f, plain_turns);
  double worst = 0.0, worst_tangent = 0.0, farthest = 0.0, longest = 0.0;
  long turns = 0, remembered = 0;
  for (int step = 1; step <= 4000; step++) {
    double stress[FIBRES], tangent[FIBRES], other_stress[FIBRES], other_tangent[FIBRES], dissipated[FIBRES], other[FIBRES];
    double reach, other_reach;
    for (int trial = 0; trial < 3; trial++) {
      for (int i = 0; i < FIBRES; i++)
        f.strain[i] = path(i, step, size) + (trial < 2 ? next_number(&source, -0.1, 0.1) * YIELD : 0.0);
      ed_menegotto_pinto_trial(&f.law, f.state, 0, FIBRES, f.strain, stress, tangent, &reach);
      without_avx_trial(&f.law, f.other, 0, FIBRES, f.strain, other_stress, other_tangent, &other_reach);
      CHECK_SAME(&reach, &other_reach, 1);
      farthest = fmax(farthest, nonlinearity(&f, stress, tangent, reach, &source));
      longest = fmax(longest, reach);
      CHECK_SAME(stress, other_stress, FIBRES);
      CHECK_SAME(tangent, other_tangent, FIBRES);
      for (int i = 0; i < FIBRES; i++) {
        mp_state copy = f.plain[i];
        if (!plain_turns && copy.forgot)
          continue;
        double expected, expected_tangent;
        prepare(&f.steel[i], &copy, f.strain[i]);
        turns += copy.direction != f.plain[i].direction;
        remembered += of(&copy, copy.direction)->count > 0.0;
        respond(&f.steel[i], &copy, f.strain[i], &expected, &expected_tangent);
        worst = fmax(worst, fabs(stress[i] - expected));
        /* where two branches meet within rounding either tangent is right */
        if (fabs(stress[i] - expected) < 1e-15 * FY)
          worst_tangent = fmax(worst_tangent, fabs(tangent[i] - expected_tangent));
      }
    }
    ed_menegotto_pinto_commit(&f.law, f.state, 0, FIBRES, f.strain, stress, dissipated);
    without_avx_commit(&f.law, f.other, 0, FIBRES, f.strain, other_stress, other);
    CHECK_SAME(dissipated, other, FIBRES);
    for (int i = 0; i < FIBRES; i++) {
      double expected, ignored;
      const double work = advance(&f.steel[i], &f.plain[i], f.strain[i], &expected, &ignored);
      if (!plain_turns && f.plain[i].forgot)
        continue; /* with windows there are fewer branches, and others are forgotten */
      CHECK_NEAR(ed_menegotto_pinto_stress(f.state, i), expected, 1e-11 * FY);
      CHECK_NEAR(dissipated[i], work, 1e-11 * FY * YIELD);
    }
  }
  CHECK_SAME(f.state, f.other, STATE);
  CHECK(worst < 1e-11 * FY);
  CHECK(farthest < 1.5e-12); /* 1e-12, and powers good to 2e-14 on both sides */
  CHECK(longest > 1e-7 * YIELD);
  CHECK(turns > 10000 && remembered > 100000); /* the path is what it was meant to be */
  printf("size %g%s: stress %.1e fy, tangent %.1e E, %ld turns, %ld with a memory; reach up to %.1e yield strains, to %.1e fy\n", size,
         plain_turns ? ", plain turns" : "", worst / FY, worst_tangent / E, turns, remembered, longest / YIELD, farthest);
}

int main(void)
{
  for (int plain_turns = 0; plain_turns < 2; plain_turns++) {
    check_beside_plain(0.1, plain_turns); /* elastic but for the curve's bend */
    check_beside_plain(0.4, plain_turns);
    check_beside_plain(2.0, plain_turns);
  }
  return checks_end("Menegotto-Pinto fibres in vectors");
}
