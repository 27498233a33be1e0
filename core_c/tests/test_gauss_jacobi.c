/* Gauss-Jacobi rules on [0, 1]: moments t^power t^k, whose integral is 1 / (power + k + 1), exact up to k = 2n - 1 and not beyond; the
 * known points of Legendre's case (Abramowitz & Stegun, table 25.4). */
#include "checks.h"
#include "damper/gauss_jacobi.h"

#include <math.h>

enum { MOST = 8 };

static void check_rule(int n, double power)
{
  double x[MOST], w[MOST];
  ed_gauss_jacobi(n, power, x, w);
  for (int i = 0; i < n; i++) {
    CHECK(w[i] > 0.0);
    CHECK(x[i] > (i ? x[i - 1] : 0.0) && x[i] < 1.0);
  }
  for (int k = 0; k <= 2 * n; k++) {
    double sum = 0.0;
    for (int i = 0; i < n; i++)
      sum += w[i] * pow(x[i], k);
    const double expected = 1.0 / (power + k + 1.0);
    if (k < 2 * n)
      CHECK_NEAR(sum, expected, 2e-13 * expected); /* rounding; the first point may be near 0 */
    else
      CHECK(fabs(sum - expected) > 1e-11 * expected);
  }
}

int main(void)
{
  static const double powers[] = {-0.95, -0.626, -0.5, 0.0, 0.5, 1.0};
  for (int n = 2; n <= MOST; n++)
    for (int i = 0; i < (int)(sizeof powers / sizeof *powers); i++)
      check_rule(n, powers[i]);
  double x[3], w[3];
  ed_gauss_jacobi(3, 0.0, x, w);
  CHECK_NEAR(x[0], 0.5 - 0.5 * sqrt(0.6), 1e-15);
  CHECK_NEAR(x[1], 0.5, 1e-15);
  CHECK_NEAR(w[0], 5.0 / 18.0, 1e-15);
  CHECK_NEAR(w[1], 8.0 / 18.0, 1e-15);
  return checks_end("gauss_jacobi");
}
