/* Power-law dashpot in series with a spring. References: alpha = 1 is the linear Maxwell element, whose force under a cubic path
 * follows from integrals of powers; relaxation at rest, F' = -k (F/c)^(1/alpha), in closed form; the steady force c v^alpha; SUNDIALS at
 * 1e-10 through rest, with soft and stiff springs; the sum of many short steps, which are Taylor series, for one long one, which is not;
 * slopes against central differences. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>

/* Ten times what a part may err: of a step there are several, and what they err fades. */
static const double TOLERANCE = 1e-7;

static ed_damper *damper(double c, double alpha, double k, double brace)
{
  const double p[3] = {c, alpha, k};
  char message[256];
  int status;
  ed_damper *made = ed_damper_new(ED_LAW_MAXWELL_POWER, 3, p, brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return made;
}

/* int_0^h exp(-(h - s)/tau) v(s) ds of the Hermite cubic through both ends */
static double filtered(double h, double tau, double u0, double v0, double u1, double v1)
{
  const double mean = (u1 - u0) / h, c2 = (3.0 * mean - 2.0 * v0 - v1) / h, c3 = (v0 + v1 - 2.0 * mean) / (h * h);
  const double i0 = -tau * expm1(-h / tau), i1 = tau * (h - i0), i2 = tau * (h * h - 2.0 * i1);
  return v0 * i0 + 2.0 * c2 * i1 + 3.0 * c3 * i2;
}

static void check_linear(double h, double brace)
{
  const double c = 3.0, k = 8.0, spring = brace > 0.0 ? 1.0 / (1.0 / k + 1.0 / brace) : k, tau = c / spring;
  ed_damper *made = damper(c, 1.0, k, brace);
  const double u0 = 0.2, v0 = -0.7, u1 = 0.5, v1 = 1.3, start = 0.9;
  double trial, force, slope[2];
  CHECK_STATUS(ed_damper_step(made, 0, 1e-9, &start, h, u0, v0, u1, v1, &trial, &force, slope), ED_OK);
  const double expected = start * exp(-h / tau) + spring * filtered(h, tau, u0, v0, u1, v1);
  CHECK_NEAR(force, expected, TOLERANCE * spring);
  CHECK_NEAR(trial, expected, TOLERANCE * spring);
  CHECK_NEAR(slope[0], spring * filtered(h, tau, 0.0, 0.0, 1.0, 0.0), 1e-7 * spring);
  CHECK_NEAR(slope[1], spring * filtered(h, tau, 0.0, 0.0, 0.0, 1.0), 1e-7 * spring * h);
  ed_damper_free(made);
}

static void check_relaxation(double alpha, double h)
{
  const double c = 3.0, k = 8.0, start = 1.7, power = 1.0 / alpha;
  ed_damper *made = damper(c, alpha, k, 0.0);
  double trial, force, slope[2];
  /* with x = F/c: x' = -k/c x^p, so x^(1-p) changes by (p - 1) k/c h */
  const double left = pow(start / c, 1.0 - power) + (power - 1.0) * k / c * h;
  const double expected = left > 0.0 ? c * pow(left, 1.0 / (1.0 - power)) : 0.0;
  CHECK_STATUS(ed_damper_step(made, 0, 1e-9, &start, h, 0.3, 0.0, 0.3, 0.0, &trial, &force, slope), ED_OK);
  CHECK_NEAR(force, expected, TOLERANCE * start);
  CHECK(slope[0] >= -1e-6 * k && slope[0] <= (1.0 + 1e-6) * k);
  ed_damper_free(made);
}

/* Along a ramp of constant velocity for many relaxation times. */
static void check_steady(double alpha)
{
  const double c = 3.0, v = 0.4, h = 50.0, start = 0.0;
  ed_damper *made = damper(c, alpha, 8.0, 0.0);
  double trial, force, slope[2];
  CHECK_STATUS(ed_damper_step(made, 0, 1e-8, &start, h, 0.0, v, v * h, v, &trial, &force, slope), ED_OK);
  CHECK_NEAR(force, c * pow(v, alpha), TOLERANCE * c);
  ed_damper_free(made);
}

static const double WAY[][3] = {/* h, u, v */ {0.02, 0.03, 2.0}, {0.4, 0.5, -1.5},  {0.4, 0.3, -2.0},
                                {1.0, -1.2, 3.0},                {0.3, -0.9, -0.2}, {5.0, 1.0, 1.0}};

static void check_ways(double alpha, double k)
{
  const double p[3] = {3.0, alpha, k};
  rig whole = new_rig(ED_LAW_MAXWELL_POWER, 3, p, 0.0), pieces = whole;
  for (int i = 0; i < 6; i++) {
    enum { PIECES = 500 };
    const double h = WAY[i][0], u = WAY[i][1], v = WAY[i][2], u0 = whole.u, v0 = whole.v, mean = (u - u0) / h;
    double trial, by_sundials, slope[2], force = NAN;
    CHECK_STATUS(ed_damper_step(whole.damper, ED_DAMPER_ODE, 1e-10, whole.state, h, u0, v0, u, v, &trial, &by_sundials, slope), ED_OK);
    if (alpha < 1.0) /* above, the force through rest has an infinite slope, which differences do not show */
      check_slopes(&whole, h, u, v, 1e-4, 1e-4 / h, 1e-4 * k);
    const double long_step = move(&whole, h, u, v);
    for (int j = 1; j <= PIECES; j++) {
      const double s = h * j / PIECES, c2 = (3.0 * mean - 2.0 * v0 - v) / h, c3 = (v0 + v - 2.0 * mean) / (h * h);
      force = move(&pieces, h / PIECES, u0 + s * (v0 + s * (c2 + s * c3)), v0 + s * (2.0 * c2 + s * 3.0 * c3));
    }
    const double largest = 3.0 * pow(3.0, alpha);
    CHECK_NEAR(long_step, by_sundials, 5.0 * TOLERANCE * largest);
    CHECK_NEAR(long_step, force, 5.0 * TOLERANCE * largest);
    pieces.state[0] = whole.state[0];
    pieces.u = u;
    pieces.v = v;
  }
  free_rig(&whole);
}

/* Nothing moves, from rest: no force, and the slope of the spring where the dashpot is not loose at rest. */
static void check_nothing(double alpha, double slope_there)
{
  ed_damper *made = damper(3.0, alpha, 8.0, 0.0);
  double trial, force, slope[2], start = 0.0;
  CHECK_STATUS(ed_damper_step(made, 0, 1e-8, &start, 0.5, 0.3, 0.0, 0.3, 0.0, &trial, &force, slope), ED_OK);
  CHECK(force == 0.0);
  CHECK_NEAR(slope[0], slope_there, 1e-12);
  ed_damper_free(made);
}

static void check_refusals(void)
{
  static const double wrong[][3] = {{0.0, 0.5, 1.0}, {1.0, 0.0, 1.0}, {1.0, 2.5, 1.0}, {1.0, 0.5, -1.0}};
  static const char *const name[] = {"c =", "alpha", "alpha", "k ="};
  for (int i = 0; i < 4; i++) {
    char message[256] = "";
    int status;
    CHECK(ed_damper_new(ED_LAW_MAXWELL_POWER, 3, wrong[i], 0.0, 0.0, &status, message, sizeof message) == 0);
    CHECK_STATUS(status, ED_E_ARGUMENT);
    CHECK_CONTAINS(message, name[i]);
  }
}

int main(void)
{
  const double h[] = {0.01, 0.4, 5.0};
  for (int i = 0; i < 3; i++) {
    check_linear(h[i], 0.0);
    check_linear(h[i], 4.0);
    check_relaxation(0.15, h[i]);
    check_relaxation(0.3, h[i]);
    check_relaxation(0.5, h[i]);
    check_relaxation(1.4, h[i]);
    check_relaxation(2.0, h[i]);
  }
  static const double alpha[] = {0.15, 0.3, 0.5, 0.8, 1.0, 1.4, 2.0}, k[] = {2.0, 8.0, 300.0, 2e4};
  for (int i = 0; i < 7; i++)
    for (int j = 0; j < 4; j++)
      check_ways(alpha[i], k[j]);
  check_nothing(0.5, 8.0);
  check_nothing(1.5, 0.0);
  check_steady(0.3);
  check_steady(1.0);
  check_steady(1.7);
  check_refusals();
  return checks_end("maxwell_power");
}
