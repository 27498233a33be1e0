/* Gauss-Lobatto rules on [0, 1]: exact for polynomials of degree 2n-3, not for 2n-2; symmetric; the known points of
 * small n (Abramowitz & Stegun, table 25.6). */
#include "base/quadrature.h"
#include "checks.h"

#include <math.h>

/* The weights are sums of order 1 of a few terms: rounding only. */
static const double ROUNDING = 4e-15;

static double integral(int n, const double *point, const double *weight, int degree)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += weight[i] * pow(point[i], degree);
  return sum;
}

/* Error of the rule for a polynomial of degree 2n-2 with leading coefficient 1, from the remainder of the rule:
 * n (n-1)^3 [(n-2)!]^4 / ((2n-1) [(2n-2)!]^3) f^(2n-2) on an interval of length 1. */
static double next_error(int n)
{
  const double logarithm = log(n) + 3.0 * log(n - 1) + 4.0 * lgamma(n - 1) - log(2 * n - 1) - 2.0 * lgamma(2 * n - 1);
  return exp(logarithm);
}

static void check_rule(int n)
{
  double x[ED_MAX_RULE], w[ED_MAX_RULE];
  ed_gauss_lobatto(n, x, w);
  CHECK(x[0] == 0.0 && x[n - 1] == 1.0);
  for (int i = 0; i < n; i++) {
    CHECK(w[i] > 0.0);
    CHECK(i == 0 || x[i] > x[i - 1]);
    CHECK_NEAR(x[i] + x[n - 1 - i], 1.0, ROUNDING);
    CHECK_NEAR(w[i], w[n - 1 - i], ROUNDING);
  }
  CHECK_NEAR(w[0], 1.0 / (n * (n - 1)), ROUNDING);
  for (int degree = 0; degree <= 2 * n - 3; degree++)
    CHECK_NEAR(integral(n, x, w, degree), 1.0 / (degree + 1), ROUNDING);
  const double beyond = integral(n, x, w, 2 * n - 2) - 1.0 / (2 * n - 1);
  CHECK_NEAR(beyond, next_error(n), ROUNDING);
}

int main(void)
{
  for (int n = 2; n <= ED_MAX_RULE; n++)
    check_rule(n);
  double x[ED_MAX_RULE], w[ED_MAX_RULE];
  ed_gauss_lobatto(3, x, w);
  CHECK_NEAR(x[1], 0.5, ROUNDING);
  CHECK_NEAR(w[1], 2.0 / 3.0, ROUNDING);
  ed_gauss_lobatto(4, x, w);
  CHECK_NEAR(x[1], 0.5 - 0.5 / sqrt(5.0), ROUNDING);
  CHECK_NEAR(w[1], 5.0 / 12.0, ROUNDING);
  ed_gauss_lobatto(5, x, w);
  CHECK_NEAR(x[1], 0.5 - 0.5 * sqrt(3.0 / 7.0), ROUNDING);
  CHECK_NEAR(w[1], 49.0 / 180.0, ROUNDING);
  CHECK_NEAR(w[2], 16.0 / 45.0, ROUNDING);
  return checks_end("quadrature");
}
