/* Menegotto-Pinto steel: the published curve on the first loading and after a reversal (Menegotto & Pinto 1973;
 * Filippou, Popov & Bertero 1983), and what any path has to keep. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "steels.h"

#include <math.h>
#include <string.h>

static const double E = 2.1e11, FY = 275e6, B = 0.01, YIELD = 275e6 / 2.1e11;
static const double ROUNDING = 1e-11; /* powers with exponents up to 20 */

static double curve(double x, double R) /* normalised */
{
  return B * x + (1.0 - B) * x / pow(1.0 + pow(fabs(x), R), 1.0 / R);
}

static void check_first_loading(const ed_steel *steel)
{
  double state[LARGEST_STEEL_STATE];
  ed_steel_initialise(steel, state);
  for (int i = -200; i <= 200; i++) {
    const double x = 0.05 * i;
    CHECK_NEAR(steel_stress(steel, state, x * YIELD), FY * curve(x, steel->R0), ROUNDING * FY);
  }
  CHECK_NEAR(steel_tangent(steel, state, 0.0), E, 1e-12 * E);
}

static void check_first_reversal(const ed_steel *steel, double top)
{
  double state[LARGEST_STEEL_STATE];
  ed_steel_initialise(steel, state);
  ed_steel_commit(steel, state, top * YIELD);
  const double stress_r = FY * curve(top, steel->R0);
  /* where the elastic line through the reversal meets the lower asymptote, in units of the yield point */
  const double s_r = stress_r / FY, e_0 = (-(1.0 - B) - s_r + top) / (1.0 - B), s_0 = s_r + e_0 - top;
  const double excursion = fabs(-1.0 - e_0); /* no compression so far: the extreme is the yield strain */
  const double R = steel->R0 * (1.0 - steel->cR1 * excursion / (steel->cR2 + excursion));
  for (int i = 1; i <= 200; i++) {
    const double e = top - 0.1 * i;
    const double expected = s_r + (s_0 - s_r) * curve((e - top) / (e_0 - top), R);
    CHECK_NEAR(steel_stress(steel, state, e * YIELD), FY * expected, ROUNDING * 10.0 * FY);
  }
  CHECK_NEAR(steel_tangent(steel, state, (top - 1e-7) * YIELD), E, 1e-6 * E);
}

static void check_mirror(const ed_steel *steel)
{
  numbers source = {3};
  double up[LARGEST_STEEL_STATE], down[LARGEST_STEEL_STATE];
  ed_steel_initialise(steel, up);
  ed_steel_initialise(steel, down);
  for (int i = 0; i < 300; i++) {
    const double strain = next_number(&source, -8.0, 8.0) * YIELD;
    CHECK(steel_stress(steel, up, strain) == -steel_stress(steel, down, -strain));
    CHECK(ed_steel_commit(steel, up, strain) == ed_steel_commit(steel, down, -strain));
  }
}

/* Random histories of large and small turns: monotone, tangent correct, trials leave no trace. */
static void check_random_paths(const ed_steel *steel)
{
  numbers source = {11};
  double state[LARGEST_STEEL_STATE], strain = 0.0;
  ed_steel_initialise(steel, state);
  for (int i = 0; i < 1500; i++) {
    const double size = i % 4 == 0 ? 8.0 : 0.5;
    const double h = 1e-6 * YIELD;
    double before[LARGEST_STEEL_STATE];
    memcpy(before, state, sizeof before);
    double last = steel_stress(steel, state, strain);
    const double next = i % 4 == 0 ? next_number(&source, -size, size) * YIELD
                                   : strain + next_number(&source, -size, size) * YIELD;
    int kinks = 0;
    for (int k = 1; k <= 10; k++) {
      const double e = strain + (next - strain) * k / 10.0, stress = steel_stress(steel, state, e);
      CHECK((stress - last) * (next - strain) >= 0.0); /* stress follows strain */
      last = stress;
      if (fabs(e - strain) < 2.0 * h)
        continue;
      const double ahead = (steel_stress(steel, state, e + h) - stress) / h;
      const double behind = (stress - steel_stress(steel, state, e - h)) / h;
      const double tangent = steel_tangent(steel, state, e);
      CHECK(tangent >= 0.0 && tangent <= E * (1.0 + 1e-9));
      /* differences err by h times the curvature, at most 20 E / yield strain, and rounding of fy / h */
      const int smooth = fabs(ahead - behind) < 1e-4 * E;
      kinks += !smooth; /* the response returns to the curve that was left */
      if (smooth)
        CHECK_NEAR(tangent, 0.5 * (ahead + behind), 1e-4 * E);
    }
    CHECK(kinks <= 1);
    CHECK(memcmp(before, state, sizeof before) == 0);
    ed_steel_commit(steel, state, next);
    CHECK_NEAR(steel_stress(steel, state, next), last, ROUNDING * 10.0 * FY);
    strain = next;
  }
}

static double difference(const ed_steel *steel, const double *state, const double *other, double strain)
{
  return steel_stress(steel, state, strain) - steel_stress(steel, other, strain);
}

/* Small unloadings from a branch: the response is never beyond what the uninterrupted branch would have given. */
static void check_no_overshoot(const ed_steel *steel, double direction, double start)
{
  double plain[LARGEST_STEEL_STATE], disturbed[LARGEST_STEEL_STATE];
  ed_steel_initialise(steel, plain);
  ed_steel_commit(steel, plain, start * YIELD);
  ed_steel_commit(steel, plain, (start + 0.5 * direction) * YIELD);
  memcpy(disturbed, plain, sizeof plain);
  double at = start + 0.5 * direction, furthest = 0.0;
  for (int i = 0; i < 30; i++) {
    const double back = i % 3 == 0 ? 0.05 : i % 3 == 1 ? 0.6 : 0.2;
    ed_steel_commit(steel, disturbed, (at - direction * back) * YIELD);
    if (i % 5 == 4) { /* a reversal inside the reversal */
      ed_steel_commit(steel, disturbed, (at - direction * 0.5 * back) * YIELD);
      ed_steel_commit(steel, disturbed, (at - direction * 0.8 * back) * YIELD);
    }
    for (int k = 0; k < 6; k++) {
      const double e = at + direction * (-0.5 * back + 0.12 * back * k);
      const double over = direction * difference(steel, disturbed, plain, e * YIELD);
      if (e * direction >= (start + 0.5 * direction) * direction)
        furthest = fmax(furthest, over);
    }
    at += 0.4 * direction;
    furthest = fmax(furthest, direction * difference(steel, disturbed, plain, at * YIELD));
    ed_steel_commit(steel, disturbed, at * YIELD);
  }
  CHECK_NEAR(furthest, 0.0, ROUNDING * 10.0 * FY);
  /* and back on the branch at its end */
  const double far = (at + 5.0 * direction) * YIELD;
  CHECK_NEAR(steel_stress(steel, disturbed, far), steel_stress(steel, plain, far), 0.01 * FY);
}

static void check_energy(const ed_steel *steel)
{
  static const double turns[] = {0.0, 6.0, -3.0, 2.0, 1.5, 2.5, -8.0, 0.0};
  double total[2];
  for (int fine = 0; fine < 2; fine++) {
    double state[LARGEST_STEEL_STATE], work = 0.0, dissipated = 0.0;
    ed_steel_initialise(steel, state);
    for (size_t i = 1; i < sizeof turns / sizeof *turns; i++)
      walk(steel, state, turns[i - 1] * YIELD, turns[i] * YIELD, fine ? 4000 : 1000, &work, &dissipated);
    const double stored = ed_steel_stored(steel, steel_stress(steel, state, 0.0));
    CHECK_NEAR(dissipated + stored, work, 1e-10 * work); /* one rule for both: rounding only */
    total[fine] = dissipated;
  }
  CHECK_NEAR(total[0], total[1], 1e-4 * total[1]); /* trapezoids: second order in a step of 0.01 */
}

/* The stress depends on the turning points alone, not on the number of steps between them. */
static void check_steps_do_not_matter(const ed_steel *steel)
{
  static const double turns[] = {0.0, 4.0, -2.0, 3.0, 2.7, 5.0, 1.0, 1.2, -6.0, -5.0, -7.0, 0.0};
  double coarse[LARGEST_STEEL_STATE], fine[LARGEST_STEEL_STATE], work = 0.0, dissipated = 0.0;
  ed_steel_initialise(steel, coarse);
  ed_steel_initialise(steel, fine);
  for (size_t i = 1; i < sizeof turns / sizeof *turns; i++) {
    ed_steel_commit(steel, coarse, turns[i] * YIELD);
    walk(steel, fine, turns[i - 1] * YIELD, turns[i] * YIELD, 50, &work, &dissipated);
    const double at = turns[i] * YIELD;
    CHECK_NEAR(steel_stress(steel, fine, at), steel_stress(steel, coarse, at), ROUNDING * 10.0 * FY);
  }
}

int main(void)
{
  const ed_steel steel = menegotto_pinto_steel(E, FY, B);
  check_first_loading(&steel);
  check_first_reversal(&steel, 0.5);
  check_first_reversal(&steel, 4.0);
  check_mirror(&steel);
  check_random_paths(&steel);
  check_no_overshoot(&steel, 1.0, 0.0);
  check_no_overshoot(&steel, -1.0, 0.0);
  check_no_overshoot(&steel, -1.0, 5.0);
  check_no_overshoot(&steel, 1.0, -5.0);
  check_energy(&steel);
  check_steps_do_not_matter(&steel);
  return checks_end("Menegotto-Pinto steel");
}
