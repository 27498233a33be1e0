/* The exact step of Prony branches against the same functions in long double: phi_k(-z) = sum (-z)^j / (j + k)! where the series
 * does not cancel, else the recursion from expl. */
#include "checks.h"
#include "damper/relaxation.h"

#include <float.h>
#include <math.h>

enum { MOST = 64 };

static void phi(long double z, long double value[4])
{
  if (z < 2.0L) {
    long double term = 1.0L / 6.0L, sum = 0.0L; /* phi_3 */
    for (int j = 0; j < 60; j++, term *= -z / (j + 3.0L))
      sum += term;
    value[3] = sum;
    value[2] = 0.5L - z * value[3];
    value[1] = 1.0L - z * value[2];
    value[0] = 1.0L - z * value[1];
    return;
  }
  value[0] = expl(-z);
  value[1] = (1.0L - value[0]) / z;
  value[2] = (1.0L - value[1]) / z;
  value[3] = (0.5L - value[2]) / z;
}

/* All of n branches at rates that grow by `ratio`. */
static void check_gains(int n, double h, double slowest, double ratio)
{
  double rate[MOST] = {0.0}, stiffness[MOST] = {0.0}, start[MOST] = {0.0}, end[MOST], first[MOST], second[MOST], third[MOST];
  const double v[3] = {0.7, -1.3, 2.1};
  for (int i = 0; i < n; i++) {
    rate[i] = slowest * pow(ratio, i);
    stiffness[i] = 1.0 + 0.1 * i;
    start[i] = 3.0 - i;
  }
  ed_relax(n, h, v, rate, stiffness, start, end, (double *const[3]){first, second, third});
  for (int i = 0; i < n; i++) {
    long double value[4];
    phi((long double)(rate[i] * h), value);
    const double scale = stiffness[i] * h, g[3] = {scale * (double)value[1], scale * (double)value[2], scale * (double)value[3]};
    /* a recursion from phi_1 to phi_3 loses a factor of up to 10 near z = 1 */
    CHECK_NEAR(first[i], g[0], 8.0 * DBL_EPSILON * g[0]);
    CHECK_NEAR(second[i], g[1], 8.0 * DBL_EPSILON * g[1]);
    CHECK_NEAR(third[i], g[2], 20.0 * DBL_EPSILON * g[2]);
    const double size = (double)value[0] * fabs(start[i]) + g[0] * 0.7 + g[1] * 1.3 + g[2] * 2.1;
    const double q = (double)value[0] * start[i] + g[0] * v[0] + g[1] * v[1] + g[2] * v[2];
    CHECK_NEAR(end[i], q, 40.0 * DBL_EPSILON * size);
  }
}

/* The exponential alone, relative: a branch that is only held. */
static void check_decay(void)
{
  const double v[3] = {0.0}, stiffness = 1.0, start = 1.0;
  double end, gain[3];
  for (double z = 1e-8; z < 660.0; z *= 1.003) { /* beyond, forces count as nothing */
    ed_relax(1, z, v, &stiffness, &stiffness, &start, &end, (double *const[3]){gain, gain + 1, gain + 2});
    const double expected = (double)expl(-(long double)z);
    CHECK_NEAR(end, expected, 4.0 * DBL_EPSILON * expected);
  }
}

/* A branch gives the same bits whatever the others are: several are computed at a time, the last ones singly. */
static void check_company(void)
{
  double rate[MOST], stiffness[MOST], start[MOST], all[MOST], gain[3][MOST];
  const double v[3] = {0.3, 0.5, -0.2};
  for (int i = 0; i < MOST; i++) {
    rate[i] = 1e-3 * pow(1.4, i);
    stiffness[i] = 2.0;
    start[i] = 0.1 * i;
  }
  ed_relax(MOST, 0.01, v, rate, stiffness, start, all, (double *const[3]){gain[0], gain[1], gain[2]});
  for (int i = 0; i < MOST; i++) {
    double alone, ignored[3];
    ed_relax(1, 0.01, v, rate + i, stiffness + i, start + i, &alone, (double *const[3]){ignored, ignored + 1, ignored + 2});
    CHECK_SAME(&alone, all + i, 1);
  }
}

/* Held branches end at zero, not at the smallest denormal number. */
static void check_nothing_left(void)
{
  const double v[3] = {0.0}, rate = 1.0, stiffness = 1.0;
  double state = 1e-280, end, gain[3];
  for (int i = 0; i < 100; i++, state = end)
    ed_relax(1, 0.4, v, &rate, &stiffness, &state, &end, (double *const[3]){gain, gain + 1, gain + 2});
  CHECK(state == 0.0);
}

int main(void)
{
  check_gains(64, 1.0, 1e-3, 1.15);  /* z from 1e-3 to 7: both ways and the change between them */
  check_gains(64, 1.0, 0.98, 1.0006);
  check_gains(61, 1e-3, 1e-300, 1e10);
  check_gains(40, 1e-3, 1e-8, 3.0);
  check_gains(63, 1e8, 1e-9, 3.0);   /* z up to 1e28 */
  for (int n = 1; n <= 9; n++)
    check_gains(n, 0.02, 0.3, 9.0);
  check_decay();
  check_company();
  check_nothing_left();
  return checks_end("relaxation");
}
