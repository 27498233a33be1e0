/* Powers and exponentials of many numbers against those of the C library in long double. */
#include "base/power_exp.h"
#include "checks.h"
#include "numbers.h"

#include <math.h>

enum { N = 3 * ED_POWER_BLOCK };

static void check_against_library(void)
{
  numbers source = {11};
  for (int k = 0; k < 20000; k++) {
    double base[N], rise[N], got[N];
    const double power = next_number(&source, -1.0, 2.0);
    for (int i = 0; i < N; i++) {
      base[i] = exp(next_number(&source, -20.0, 20.0));
      rise[i] = next_number(&source, -40.0, 40.0);
    }
    ed_power_exp(N, power, base, rise, got);
    for (int i = 0; i < N; i++) {
      const double expected = (double)expl((long double)power * logl(base[i]) + rise[i]);
      CHECK_NEAR(got[i], expected, 2e-14 * expected); /* rounding of exponents up to 80: 80 x 1.1e-16, and of what makes them */
    }
  }
}

/* Round numbers, both sides of where the exponent changes, and what lies outside. */
static void check_ends(void)
{
  const double base[] = {1.0, 1.0, M_SQRT1_2, nextafter(M_SQRT1_2, 0.0), 4.0, 0.0, 1e300, 1e-310};
  const double rise[] = {0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 900.0, 0.0};
  const double expected[] = {1.0, M_E, M_SQRT1_2, M_SQRT1_2, 4.0, 1e-300, exp(700.0), 1e-300};
  double got[8];
  ed_power_exp(8, 1.0, base, rise, got);
  for (int i = 0; i < 8; i++)
    CHECK_NEAR(got[i], expected[i], 2e-13 * expected[i]); /* of an exponent of 700 */
  CHECK(got[0] == 1.0);
}

int main(void)
{
  check_against_library();
  check_ends();
  return checks_end("power_exp");
}
