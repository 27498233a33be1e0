/* Elastic-plastic and friction devices. Closed form of linear kinematic hardening along any path: the force moves with k between
 * the lines b k u +- (1 - b) Fy. Numbers in units of Fy and of the yield deformation. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>

static const double ROUNDING = 1e-13; /* of Fy times the largest ratio of deformation, 10 */

static double between_lines(double b, double force, double change, double u)
{
  return fmax(b * u - (1.0 - b), fmin(b * u + (1.0 - b), force + change));
}

static void check_closed_form(double b)
{
  rig device = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){1.0, 1.0, b}, 0.0);
  numbers source = {11};
  double force = 0.0, u = 0.0;
  for (int i = 0; i < 2000; i++) {
    const double next = next_number(&source, -10.0, 10.0) * (i % 3 == 0 ? 1.0 : 0.1);
    force = between_lines(b, force, next - u, next);
    u = next;
    CHECK_NEAR(move_to(&device, next), force, 10.0 * ROUNDING);
  }
  free_rig(&device);
}

/* u = 27 s (1 - s)^2 on the unit interval rises to 4 at s = 1/3 and is back at 0 at the end: v(0) = 27, v(1) = 0. */
static void check_turn_inside(void)
{
  const double b = 0.1;
  rig device = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){1.0, 1.0, b}, 0.0);
  device.v = 27.0;
  /* loaded to 4: F = 0.9 + 0.4 = 1.3; back by 4: 1.3 - 4 < lower line -0.9 */
  CHECK_NEAR(move(&device, 1.0, 0.0, 0.0), -0.9, ROUNDING);
  free_rig(&device);
  device = new_rig(ED_LAW_FRICTION, 3, (const double[]){0.5, 2.0, 1.0}, 0.0); /* mu N = 1 */
  device.v = 1.25 * 27.0 / 4.0; /* to 1.25 and back: slips 0.25 */
  CHECK_NEAR(move(&device, 1.0, 0.0, 0.0), -0.25, ROUNDING);
  /* dF/dv: the turn moves by 4/27 per unit of the first velocity; to the last velocity by h s^2 (s - 1) = -2/27, which the
   * plastic deformation follows with (1 - b), b = 0 */
  rig again = new_rig(ED_LAW_FRICTION, 3, (const double[]){0.5, 2.0, 1.0}, 0.0);
  again.v = device.v = 1.25 * 27.0 / 4.0;
  double trial[LARGEST_DAMPER_STATE], force, slope[2];
  CHECK_STATUS(ed_damper_step(again.damper, ED_DAMPER_BEST, 1e-6, again.state, 1.0, 0.0, again.v, 0.0, 0.0, trial, &force, slope),
               ED_OK);
  CHECK_NEAR(slope[1], 2.0 / 27.0, ROUNDING);
  CHECK_NEAR(slope[0], 1.0 - (3.0 / 9.0 - 2.0 / 27.0), ROUNDING); /* elastic at the end, less the way of the turn, 3 s^2 - 2 s^3 */
  free_rig(&again);
  free_rig(&device);
}

/* A path in one step or in many gives the same; steps from microseconds to years too, and none at all. */
static void check_subdivision(double b)
{
  const double p[] = {1.0, 1.0, b};
  numbers source = {5};
  rig coarse = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, p, 0.0), fine = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, p, 0.0);
  for (int i = 0; i < 300; i++) {
    const double h = pow(10.0, next_number(&source, -6.0, 8.0)), u0 = coarse.u, v0 = next_number(&source, -30.0, 30.0);
    const double u1 = next_number(&source, -3.0, 3.0), v1 = next_number(&source, -30.0, 30.0);
    const double c2 = 3.0 * (u1 - u0) - 2.0 * v0 - v1, c3 = v0 + v1 - 2.0 * (u1 - u0);
    double force = 0.0;
    coarse.v = fine.v = v0 / h;
    for (int j = 1; j <= 7; j++) {
      const double s = j / 7.0;
      force = move(&fine, h / 7.0, u0 + s * (v0 + s * (c2 + s * c3)), (v0 + s * (2.0 * c2 + s * 3.0 * c3)) / h);
    }
    CHECK_NEAR(move(&coarse, h, u1, v1 / h), force, 1e-11); /* rounding of velocities, which move the turns */
    fine.u = u1;
    rig held = coarse;
    held.v = 0.0;
    const double stays = move(&held, 1e8, u1, 0.0);
    CHECK_NEAR(stays, force, 1e-11);
    CHECK_NEAR(move(&held, 1e-9, u1, 0.0), stays, 10.0 * ROUNDING);
  }
  free_rig(&coarse);
  free_rig(&fine);
}

static void check_random_slopes(void)
{
  rig device = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){1.0, 1.0, 0.05}, 0.0);
  numbers source = {23};
  for (int i = 0; i < 500; i++) {
    const double u = next_number(&source, -4.0, 4.0), v = next_number(&source, -2000.0, 2000.0);
    check_slopes(&device, 0.01, u, v, 1e-6, 1e-4, 1e-6);
    (void)move(&device, 0.01, u, v);
  }
  free_rig(&device);
}

int main(void)
{
  check_closed_form(0.0);
  check_closed_form(0.02);
  check_closed_form(0.3);
  check_turn_inside();
  check_subdivision(0.0);
  check_subdivision(0.1);
  check_random_slopes();
  check_refused(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){1.0, 1.0, 1.0}, "b = 1");
  check_refused(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){1.0, 0.0, 0.0}, "Fy = 0");
  check_refused(ED_LAW_FRICTION, 3, (const double[]){0.3, -2.0, 1.0}, "N = -2");
  return checks_end("elastic-plastic and friction devices");
}
