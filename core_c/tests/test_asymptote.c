/* The law with asymptotes, against its closed form (thesis Eqs. 2.65-2.66) between given reversals. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>
#include <string.h>

enum { PARAMETERS = 7, F0 = 0, K1, K2, K3, KAPPA, SHAPE, C };
static const double PLAIN[PARAMETERS] = {1.0, 0.5, 0.0, 0.0, 3.0, 1.0, 0.0};
static const double CURVED[PARAMETERS] = {1.0, 0.5, -0.1, 0.02, 3.0, 1.7, 0.0}; /* its asymptotes rise everywhere */
static const double FALLING[PARAMETERS] = {1.0, 0.5, -0.3, 0.04, 3.0, 1.7, 0.0}; /* fall where 1.0566 < |u| < 3.9434 */
static const double ROUNDING = 1e-13;

static double asymptote(const double *p, double sign, double u)
{
  return sign * p[F0] + u * (p[K1] + fabs(u) * (p[K2] + fabs(u) * p[K3]));
}

/* As printed, from the reversal (u_r, force_r) to u. */
static double printed(const double *p, double u_r, double force_r, double u)
{
  const double sign = u > u_r ? 1.0 : -1.0, e0 = asymptote(p, sign, u_r) - force_r;
  const double ratio = p[KAPPA] * (asymptote(p, sign, u) - asymptote(p, sign, u_r)) / e0, m = p[SHAPE] - 1.0;
  return asymptote(p, sign, u) - e0 * (m > 0.0 ? pow(1.0 + m * ratio, -1.0 / m) : exp(-ratio));
}

static void check_closed_form(const double *p)
{
  rig device = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, p, 0.0);
  numbers source = {17};
  double u = 0.0, force = 0.0;
  for (int i = 0; i < 1000; i++) {
    const double next = u + ((i % 2 ? -6.0 : 6.0) - u) * next_number(&source, 0.0, 0.9);
    const double halfway = printed(p, u, force, 0.5 * (u + next));
    force = printed(p, u, force, next);
    CHECK_NEAR(move_to(&device, 0.5 * (u + next)), halfway, 10.0 * ROUNDING);
    CHECK_NEAR(move_to(&device, next), force, 10.0 * ROUNDING);
    u = next;
  }
  free_rig(&device);
}

/* n near 1 runs into n = 1; the asymptote is reached and kept; unloading from it begins with (1 + kappa) k1. */
static void check_limits(void)
{
  double almost[PARAMETERS];
  memcpy(almost, PLAIN, sizeof almost);
  almost[SHAPE] = 1.0 + 1e-9;
  rig plain = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, PLAIN, 0.0), near = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, almost, 0.0);
  for (int i = 0; i < 20; i++) {
    const double u = 2.0 * cos(i * i);
    CHECK_NEAR(move_to(&near, u), move_to(&plain, u), 1e-8);
  }
  CHECK_NEAR(move_to(&plain, 1000.0), 501.0, 501.0 * ROUNDING);
  CHECK_NEAR(move_to(&plain, 1001.0), 501.5, 501.0 * ROUNDING); /* e0 = 0 to rounding */
  CHECK_NEAR(move(&plain, 1e8, 1001.0, 0.0), 501.5, 501.0 * ROUNDING);
  const double small = 1e-5;
  CHECK_NEAR(move_to(&plain, 1001.0 - small), 501.5 - 4.0 * 0.5 * small, 4.0 * small * small + 501.0 * ROUNDING);
  CHECK_NEAR(move_to(&plain, 1001.0), printed(PLAIN, 1001.0 - small, 501.5 - 2.0 * small, 1001.0), 1e-8);
  CHECK_NEAR(move_to(&plain, -1000.0), -501.0, 501.0 * ROUNDING);
  free_rig(&plain);
  free_rig(&near);
}

/* Where the asymptote falls, the force goes on approaching it with the way: P(2) = 1 - 1.2 + 0.32 = 0.12 after its top. */
static void check_falling_asymptote(void)
{
  const double m = FALLING[SHAPE] - 1.0, top = (0.6 - sqrt(0.36 - 0.24)) / 0.24;
  rig device = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, FALLING, 0.0);
  CHECK_NEAR(move_to(&device, 0.9), printed(FALLING, 0.0, 0.0, 0.9), ROUNDING); /* as printed before the top */
  const double way = 2.0 * asymptote(FALLING, 0.0, top) - asymptote(FALLING, 0.0, 2.0);
  CHECK_NEAR(move_to(&device, 2.0), asymptote(FALLING, 1.0, 2.0) - pow(1.0 + m * FALLING[KAPPA] * way, -1.0 / m), ROUNDING);
  for (double u = 2.0; u < 8.0; u += 0.5) { /* never past its asymptote */
    const double force = move_to(&device, u);
    CHECK(force < asymptote(FALLING, 1.0, u) && force > asymptote(FALLING, -1.0, u));
  }
  free_rig(&device);
  static const double always[PARAMETERS] = {1.0, -0.5, 0.0, 0.0, 3.0, 1.7, 0.0}; /* falls from the beginning */
  device = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, always, 0.0);
  CHECK_NEAR(move_to(&device, 2.0), -1.0 + 1.0 - pow(1.0 + m * 3.0, -1.0 / m), ROUNDING);
  free_rig(&device);
}

/* A motion with stops is one motion: rounding at a stop must not pass for a turn, after which the law would begin anew. Steps of
 * any length that end in a stop, or sway to it through velocities that rounding leaves. */
static void check_stops(const double *p)
{
  numbers source = {41};
  for (int i = 0; i < 300; i++) {
    rig device = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, p, 0.0);
    const double start = next_number(&source, -3.0, 0.0), end = next_number(&source, 0.5, 3.0);
    const double force = printed(p, 0.0, 0.0, start);
    double u = start;
    (void)move_to(&device, start);
    while (u < end) {
      const double h = pow(10.0, next_number(&source, -6.0, 8.0));
      u = fmin(end, u + next_number(&source, 0.001, 0.3));
      if (fabs(u) < 0.05)
        u = 0.0;
      const double mean = (u - device.u) / h;
      if (i % 2)
        device.v = mean * next_number(&source, 0.0, 1.5); /* monotone, as 0 <= v <= 3 times the mean (Fritsch and Carlson) */
      (void)move(&device, h, u, 0.0);
      CHECK_NEAR(move(&device, h, u, 0.0), printed(p, start, force, u), 1e-12);
    }
    free_rig(&device);
  }
}

static void check_subdivision(const double *p)
{
  numbers source = {3};
  rig coarse = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, p, 0.0), fine = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, p, 0.0);
  for (int i = 0; i < 500; i++) {
    const double h = pow(10.0, next_number(&source, -6.0, 8.0)), u0 = coarse.u, v0 = next_number(&source, -10.0, 10.0);
    const double u1 = next_number(&source, -4.0, 4.0), v1 = next_number(&source, -10.0, 10.0);
    const double c2 = 3.0 * (u1 - u0) - 2.0 * v0 - v1, c3 = v0 + v1 - 2.0 * (u1 - u0);
    double force = 0.0;
    coarse.v = fine.v = v0 / h;
    for (int j = 1; j <= 5; j++) {
      const double s = 0.2 * j;
      force = move(&fine, 0.2 * h, u0 + s * (v0 + s * (c2 + s * c3)), (v0 + s * (2.0 * c2 + s * 3.0 * c3)) / h);
    }
    CHECK_NEAR(move(&coarse, h, u1, v1 / h), force, 1e-11); /* rounding of velocities, which move the turns */
    fine.u = u1;
    rig held = coarse, going = coarse; /* a rest in between is no reversal */
    held.v = going.v = 0.0;
    (void)move(&held, 1e8, u1, 0.0);
    (void)move(&held, 1e-6, u1, 0.0);
    const double on = u1 + (v1 > 0.0 ? 0.3 : -0.3);
    CHECK_NEAR(move_to(&held, on), move_to(&going, on), 1e-12);
  }
  free_rig(&coarse);
  free_rig(&fine);
}

static void check_odd_and_slopes(const double *p, double c)
{
  double with_dashpot[PARAMETERS];
  memcpy(with_dashpot, p, sizeof with_dashpot);
  with_dashpot[C] = c;
  rig device = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, with_dashpot, 0.0);
  rig mirror = new_rig(ED_LAW_ASYMPTOTE, PARAMETERS, with_dashpot, 0.0);
  numbers source = {31};
  for (int i = 0; i < 1000; i++) {
    const double u = next_number(&source, -4.0, 4.0), v = next_number(&source, -1000.0, 1000.0);
    check_slopes(&device, 0.01, u, v, 1e-6, 1e-4, 2e-5);
    const double force = move(&device, 0.01, u, v);
    CHECK(move(&mirror, 0.01, -u, -v) == -force);
  }
  free_rig(&device);
  free_rig(&mirror);
}

int main(void)
{
  check_closed_form(PLAIN);
  check_closed_form(CURVED);
  check_limits();
  check_falling_asymptote();
  check_stops(PLAIN);
  check_stops(CURVED);
  check_subdivision(PLAIN);
  check_subdivision(CURVED);
  check_subdivision(FALLING);
  check_odd_and_slopes(PLAIN, 0.0);
  check_odd_and_slopes(CURVED, 0.01);
  check_odd_and_slopes(FALLING, 0.02);
  check_refused(ED_LAW_ASYMPTOTE, PARAMETERS, (const double[]){0.0, 1.0, 0.0, 0.0, 3.0, 1.0, 0.0}, "f0 = 0");
  check_refused(ED_LAW_ASYMPTOTE, PARAMETERS, (const double[]){1.0, 0.0, 0.0, 0.0, 3.0, 1.0, 0.0}, "must not all be 0");
  check_refused(ED_LAW_ASYMPTOTE, PARAMETERS, (const double[]){1.0, 1.0, 0.0, 0.0, 3.0, 0.5, 0.0}, "n = 0.5");
  return checks_end("law with asymptotes");
}
