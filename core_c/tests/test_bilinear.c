/* Elastic and bilinear steel. Closed form of linear kinematic hardening along any path: the stress moves with E
 * between the lines b E strain +- (1 - b) fy. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "steels.h"

#include <math.h>
#include <string.h>

static const double E = 2.1e11, FY = 275e6, YIELD = 275e6 / 2.1e11;
static const double ROUNDING = 1e-13; /* of fy times the largest strain ratio, 20 */

static double between_lines(double b, double stress, double change, double strain)
{
  const double high = b * E * strain + (1.0 - b) * FY, low = b * E * strain - (1.0 - b) * FY;
  return fmax(low, fmin(high, stress + E * change));
}

static void check_closed_form(double b)
{
  const ed_steel steel = bilinear_steel(E, FY, b);
  numbers source = {7};
  double state[LARGEST_STEEL_STATE] = {0}, strain = 0.0, stress = 0.0;
  for (int i = 0; i < 2000; i++) {
    const double next = next_number(&source, -20.0, 20.0) * YIELD * (i % 3 == 0 ? 1.0 : 0.1);
    double got, tangent, before[LARGEST_STEEL_STATE];
    memcpy(before, state, sizeof before);
    const int elastic = ed_steel_trial(&steel, state, next, &got, &tangent);
    const double expected = between_lines(b, stress, next - strain, next);
    CHECK_NEAR(got, expected, ROUNDING * 20.0 * FY);
    CHECK(memcmp(before, state, sizeof before) == 0);
    const int inside = fabs(stress + E * (next - strain) - b * E * next) < (1.0 - b) * FY;
    CHECK_INT(elastic, inside);
    CHECK(tangent == (inside ? E : b * E));
    const double dissipated = ed_steel_commit(&steel, state, next);
    if (20.0 * b < 1.0 - b) /* beyond, the back stress exceeds fy and flow can give energy back */
      CHECK(dissipated >= 0.0);
    CHECK(elastic ? dissipated == 0.0 : dissipated != 0.0);
    /* a commit does not move the stress */
    CHECK_NEAR(steel_stress(&steel, state, next), expected, ROUNDING * 20.0 * FY);
    strain = next;
    stress = expected;
  }
}

static void check_energy(double b)
{
  const ed_steel steel = bilinear_steel(E, FY, b);
  static const double turns[] = {0.0, 6.0, -3.0, 2.0, 1.5, 2.5, -8.0, 0.0};
  enum { N = 2000 };
  double state[LARGEST_STEEL_STATE] = {0}, work = 0.0, dissipated = 0.0;
  for (size_t i = 1; i < sizeof turns / sizeof *turns; i++)
    walk(&steel, state, turns[i - 1] * YIELD, turns[i] * YIELD, N, &work, &dissipated);
  const double stored = ed_steel_stored(&steel, steel_stress(&steel, state, 0.0));
  CHECK(dissipated > 0.5 * work);
  /* a trapezoid across a yield point errs by at most E h^2 / 8; five of them, h up to 10.5 yield strains / N */
  const double h = 10.5 * YIELD / N;
  CHECK_NEAR(dissipated + stored, work, 5.0 * E * h * h / 8.0);
}

static void check_big_steps(void)
{
  /* one step from rest beyond yield: dissipated energy does not depend on the number of steps */
  for (int i = 0; i < 2; i++) {
    const double b = i ? 0.05 : 0.0;
    const ed_steel steel = bilinear_steel(E, FY, b);
    double state[LARGEST_STEEL_STATE] = {0}, many[LARGEST_STEEL_STATE] = {0}, work = 0.0, in_steps = 0.0;
    const double at_once = ed_steel_commit(&steel, state, 9.0 * YIELD);
    walk(&steel, many, 0.0, 9.0 * YIELD, 77, &work, &in_steps);
    CHECK_NEAR(in_steps, at_once, 1e-12 * at_once);
    /* area under the curve beyond yield, less the growth of the recoverable part */
    const double end = FY + b * E * 8.0 * YIELD;
    const double expected = 0.5 * (FY + end) * 8.0 * YIELD - 0.5 * (end * end - FY * FY) / E;
    CHECK_NEAR(at_once, expected, 1e-12 * expected);
  }
}

int main(void)
{
  check_closed_form(0.0);
  check_closed_form(0.02);
  check_closed_form(0.3);
  check_energy(0.0);
  check_energy(0.02);
  check_big_steps();
  const ed_steel elastic = elastic_steel(E);
  double state[LARGEST_STEEL_STATE] = {0};
  CHECK(steel_stress(&elastic, state, 100.0 * YIELD) == E * 100.0 * YIELD);
  CHECK(steel_tangent(&elastic, state, -100.0 * YIELD) == E);
  CHECK(ed_steel_commit(&elastic, state, 100.0 * YIELD) == 0.0);
  CHECK(steel_stress(&elastic, state, 0.0) == 0.0);
  CHECK_NEAR(ed_steel_stored(&elastic, 3e6), 0.5 * 9e12 / E, 1e-12);
  return checks_end("elastic and bilinear steel");
}
