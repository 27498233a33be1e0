/* Ramberg-Osgood. The inverse law is explicit (deformation of a force), so every expected value is closed form: skeleton
 * u = F (1 + a |F|^(n-1)) in units of Fy and Fy/k, branches twice the skeleton about the last reversal (Masing). */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>

enum { PARAMETERS = 4, REMEMBERED = 64 };
static const double P[PARAMETERS] = {1.0, 1.0, 0.5, 6.0};
static const double SOLVED = 1e-12; /* Newton to rounding, at forces up to 3 */

static double skeleton(const double p[PARAMETERS], double force)
{
  return force * (1.0 + p[2] * pow(fabs(force), p[3] - 1.0));
}

static double branch(double u_r, double force_r, double force)
{
  return u_r + 2.0 * skeleton(P, 0.5 * (force - force_r));
}

static rig start(void)
{
  return new_rig(ED_LAW_RAMBERG_OSGOOD, PARAMETERS, P, 0.0);
}

static void check_skeleton(void)
{
  for (int i = 0; i < 5; i++) {
    const double p[PARAMETERS] = {1.0, 1.0, pow(10.0, i - 3), (const double[]){1.0001, 2.0, 5.5, 30.0, 300.0}[i]};
    rig device = new_rig(ED_LAW_RAMBERG_OSGOOD, PARAMETERS, p, 0.0);
    for (double force = 1e-6; force < 3.0; force *= 1.3) {
      double trial[LARGEST_DAMPER_STATE], got, slope[2];
      const double u = skeleton(p, force), tangent = 1.0 / (1.0 + p[3] * p[2] * pow(force, p[3] - 1.0));
      CHECK_STATUS(ed_damper_step(device.damper, ED_DAMPER_BEST, 1e-6, device.state, 1.0, device.u, 0.0, u, 0.0, trial, &got,
                                  slope),
                   ED_OK);
      CHECK_NEAR(slope[0], tangent, 1e-12 * tangent);
      CHECK_NEAR(move_to(&device, u), force, 1e-13 * force);
    }
    free_rig(&device);
    device = new_rig(ED_LAW_RAMBERG_OSGOOD, PARAMETERS, p, 0.0);
    CHECK_NEAR(move_to(&device, -skeleton(p, 2.0)), -2.0, 2e-13); /* at once from rest */
    free_rig(&device);
  }
}

/* Up to 1.2, down to -0.4, up to 0.7, down to 0.1: then every loop closes where it began, in turn. */
static void check_nested_loops(void)
{
  static const double turn[] = {1.2, -0.4, 0.7, 0.1};
  double u[4] = {skeleton(P, turn[0])};
  for (int i = 1; i < 4; i++)
    u[i] = branch(u[i - 1], turn[i - 1], turn[i]);
  rig device = start();
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(move_to(&device, u[i]), turn[i], SOLVED);
  CHECK_NEAR(move_to(&device, branch(u[3], turn[3], 0.5)), 0.5, SOLVED);
  CHECK_NEAR(move_to(&device, branch(u[3], turn[3], 0.69)), 0.69, SOLVED);
  /* past 0.7 the inner loop is closed: on with the branch from -0.4 */
  CHECK_NEAR(move_to(&device, branch(u[1], turn[1], 0.9)), 0.9, SOLVED);
  /* past 1.2 on with the skeleton */
  CHECK_NEAR(move_to(&device, skeleton(P, 1.5)), 1.5, SOLVED);
  /* and down past -1.5, with the other side of the skeleton */
  CHECK_NEAR(move_to(&device, branch(skeleton(P, 1.5), 1.5, -1.4)), -1.4, SOLVED);
  CHECK_NEAR(move_to(&device, -skeleton(P, 1.7)), -1.7, SOLVED);
  free_rig(&device);
  /* the same, all closed in one motion */
  device = start();
  for (int i = 0; i < 4; i++)
    (void)move_to(&device, u[i]);
  CHECK_NEAR(move_to(&device, skeleton(P, 1.5)), 1.5, SOLVED);
  free_rig(&device);
}

/* Shrinking reversals, more than are remembered: then outwards again through all of them. */
static void check_full_memory(void)
{
  enum { TURNS = REMEMBERED + 21 };
  double u[TURNS], force[TURNS];
  rig device = start();
  for (int i = 0; i < TURNS; i++) {
    u[i] = (i % 2 ? -4.0 : 4.0) * pow(0.97, i);
    force[i] = move_to(&device, u[i]);
    if (i >= 2)
      CHECK(fabs(force[i]) < fabs(force[i - 2]));
  }
  for (int i = REMEMBERED - 1; i >= 0; i--) /* those remembered close exactly */
    CHECK_NEAR(move_to(&device, u[i]), force[i], SOLVED);
  CHECK_NEAR(move_to(&device, skeleton(P, 2.5)), 2.5, SOLVED);
  free_rig(&device);
  /* inside the smallest loop remembered, forgotten ones do no work: the force is a function of the deformation */
  device = start();
  for (int i = 0; i <= REMEMBERED; i++)
    (void)move_to(&device, u[i]);
  const double inside = 0.3 * u[REMEMBERED];
  const double first = move_to(&device, inside);
  (void)move_to(&device, 0.5 * u[REMEMBERED]);
  CHECK_NEAR(move_to(&device, inside), first, SOLVED);
  free_rig(&device);
}

static void check_subdivision(void)
{
  numbers source = {3};
  rig coarse = start(), fine = start();
  for (int i = 0; i < 1000; i++) {
    const double h = pow(10.0, next_number(&source, -6.0, 8.0)), u0 = coarse.u, v0 = next_number(&source, -20.0, 20.0);
    const double u1 = next_number(&source, -4.0, 4.0) * pow(10.0, next_number(&source, -3.0, 0.0));
    const double v1 = next_number(&source, -20.0, 20.0);
    const double c2 = 3.0 * (u1 - u0) - 2.0 * v0 - v1, c3 = v0 + v1 - 2.0 * (u1 - u0);
    double force = 0.0;
    coarse.v = fine.v = v0 / h;
    for (int j = 1; j <= 5; j++) {
      const double s = 0.2 * j;
      force = move(&fine, 0.2 * h, u0 + s * (v0 + s * (c2 + s * c3)), (v0 + s * (2.0 * c2 + s * 3.0 * c3)) / h);
    }
    CHECK_NEAR(move(&coarse, h, u1, v1 / h), force, 1e-10); /* rounding of velocities, which move the turns */
    fine.u = u1;
    if (i % 50 == 0) {
      rig held = coarse;
      held.v = 0.0;
      const double stays = move_to(&held, u1);
      CHECK_NEAR(stays, force, 1e-10);
      CHECK_NEAR(move(&held, 1e8, u1, 0.0), stays, SOLVED);
    }
  }
  free_rig(&coarse);
  free_rig(&fine);
}

static void check_odd_and_slopes(void)
{
  numbers source = {29};
  rig device = start(), mirror = start();
  for (int i = 0; i < 1000; i++) {
    const double u = next_number(&source, -4.0, 4.0) * pow(10.0, next_number(&source, -2.0, 0.0));
    const double v = next_number(&source, -1000.0, 1000.0);
    /* the width of the differences against the smallest loops: tangents bend over about 1, the force is good to 1e-15 */
    check_slopes(&device, 0.01, u, v, 1e-6, 1e-4, 1e-5);
    const double force = move(&device, 0.01, u, v);
    CHECK(move(&mirror, 0.01, -u, -v) == -force);
  }
  free_rig(&device);
  free_rig(&mirror);
}

int main(void)
{
  check_skeleton();
  check_nested_loops();
  check_full_memory();
  check_subdivision();
  check_odd_and_slopes();
  check_refused(ED_LAW_RAMBERG_OSGOOD, PARAMETERS, (const double[]){1.0, 1.0, 0.5, 1.0}, "n = 1");
  check_refused(ED_LAW_RAMBERG_OSGOOD, PARAMETERS, (const double[]){1.0, 1.0, 0.0, 5.0}, "a = 0");
  rig device = start();
  double trial[LARGEST_DAMPER_STATE], force, slope[2];
  CHECK_STATUS(ed_damper_step(device.damper, ED_DAMPER_BEST, 1e-6, device.state, 1.0, 0.0, 0.0, 1e308, 0.0, trial, &force, slope),
               ED_E_NOT_FINITE);
  free_rig(&device);
  return checks_end("Ramberg-Osgood");
}
