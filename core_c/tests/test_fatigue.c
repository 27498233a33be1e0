/* Rainflow counting against the example of ASTM E1049-85, 5.4.4, and Miner's sum of cycles of one range. */
#include "checks.h"
#include "material/fatigue.h"

#include <math.h>

static double follow(const ed_steel *steel, double *state, int n, const double *turning, int pieces)
{
  double damage = 0.0, from = 0.0;
  for (int i = 0; i < n; i++) {
    for (int k = 1; k <= pieces; k++)
      damage = ed_fatigue_follow(steel, state, from + (turning[i] - from) * k / pieces);
    from = turning[i];
  }
  return damage;
}

static void check_example(int pieces)
{
  static const double turning[] = {-2, 1, -3, 5, -1, 3, -4, 4, -2};
  /* range: cycles, and half a cycle of 2 from the origin to where the example begins */
  static const double range[] = {2, 3, 4, 6, 8, 9}, cycles[] = {0.5, 0.5, 1.5, 0.5, 1.0, 0.5};
  for (double exponent = 1.0; exponent < 4.0; exponent += 1.0) {
    const ed_steel steel = {.fatigue_strain = 10.0, .fatigue_exponent = exponent};
    double state[ED_FATIGUE_STATE] = {0}, expected = 0.0;
    for (int i = 0; i < 6; i++)
      expected += cycles[i] * pow(range[i] / 10.0, exponent);
    CHECK_NEAR(follow(&steel, state, 9, turning, pieces), expected, 1e-13);
  }
}

/* n cycles between -a and a: the first quarter is half a cycle of a, the rest 2 n half cycles of 2 a but for the last quarter. */
static void check_miner(void)
{
  const ed_steel steel = {.fatigue_strain = 0.1, .fatigue_exponent = 2.0};
  double state[ED_FATIGUE_STATE] = {0};
  const double a = 0.01;
  for (int n = 0; n < 100; n++) {
    const double turning[] = {a, -a};
    const double damage = follow(&steel, state, 1, turning, 1);
    CHECK_NEAR(damage, 0.5 * 0.01 + 0.5 * 2 * n * 0.04, 1e-12);
    ed_fatigue_follow(&steel, state, -a);
  }
}

/* Ranges that narrow without end are closed where there is no room to keep them: each counts once, not less than as half a cycle. */
static void check_narrowing(void)
{
  const ed_steel steel = {.fatigue_strain = 0.1, .fatigue_exponent = 2.0};
  double state[ED_FATIGUE_STATE] = {0}, damage = 0.0, half = 0.0, before = 0.0;
  for (int i = 0; i < 200; i++) {
    const double strain = (i % 2 ? -0.02 : 0.02) / (1.0 + 0.05 * i);
    half += 0.5 * pow(fabs(strain - before) / 0.1, 2.0);
    before = strain;
    damage = ed_fatigue_follow(&steel, state, strain);
    CHECK(ed_fatigue_state_valid(state));
    CHECK(damage >= half * (1.0 - 1e-12) && damage <= 2.0 * half);
  }
}

int main(void)
{
  check_example(1);
  check_example(7);
  check_miner();
  check_narrowing();
  return checks_end("fatigue of fibres");
}
