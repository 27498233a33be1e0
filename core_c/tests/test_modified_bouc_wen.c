/* Modified Bouc-Wen. References: without softening and dashpot it is Bouc-Wen; the dashpot and the softened stiffness in closed form where z
 * has yielded; SUNDIALS at 1e-10 along steps that turn inside and pass their extremes; central differences; behind a brace the bare
 * device under its own deformation. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>

enum { WAYS = 6 };
static const double P[] = {3.0, 2.0, 0.8, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0, 0.7, 0.5};
/* h, u, v at the end: monotone, with a turn, with two, back and beyond the extremes */
static const double WAY[WAYS][3] = {{0.02, 0.03, 2.0}, {0.4, 0.5, -1.5}, {0.4, 0.3, -2.0}, {1.0, -1.2, 3.0},
                                   {0.3, -0.9, -0.2}, {2.0, 4.0, 0.7}};

static void check_plain(void)
{
  const double p[] = {0.0, 4.0, 1.0, 0.5, 0.1, 1.2, 0.3, 0.7, 1.5, 0.0, 1.0}, same[] = {2.0, 0.5, 0.1, 1.2, 0.3, 0.7, 1.5};
  rig modified = new_rig(ED_LAW_MODIFIED_BOUC_WEN, 11, p, 0.0), plain = new_rig(ED_LAW_BOUC_WEN, 7, same, 0.0);
  for (int i = 0; i < WAYS; i++)
    CHECK_NEAR(move(&modified, WAY[i][0], WAY[i][1], WAY[i][2]), move(&plain, WAY[i][0], WAY[i][1], WAY[i][2]), 1e-14);
  free_rig(&modified);
  free_rig(&plain);
}

static void check_yielded(void)
{
  rig r = new_rig(ED_LAW_MODIFIED_BOUC_WEN, 11, P, 0.0);
  move_to(&r, 40.0);
  for (int i = 0; i < 3; i++) { /* u_max = u/2 of the positive side alone; z = 1 */
    const double u = 40.0 + 0.1 * i, k = 3.0 * exp(-0.5 * u / 0.8) + 2.0, v = i ? 0.1 / 0.2 : 0.0;
    const double force = i ? move(&r, 0.2, u, v) : move(&r, 0.2, u, 0.0);
    CHECK_NEAR(force, k * (0.1 * u + 0.9 * 0.5) + 0.7 * sqrt(v), 1e-12);
  }
  free_rig(&r);
}

static void check_against_sundials(void)
{
  rig r = new_rig(ED_LAW_MODIFIED_BOUC_WEN, 11, P, 0.0);
  for (int i = 0; i < WAYS; i++) {
    double trial[3], force, slope[2];
    check_slopes(&r, WAY[i][0], WAY[i][1], WAY[i][2], 1e-5, 1e-5 / WAY[i][0], 1e-6);
    CHECK_STATUS(ed_damper_step(r.damper, ED_DAMPER_ODE, 1e-10, r.state, WAY[i][0], r.u, r.v, WAY[i][1], WAY[i][2], trial, &force, slope),
                 ED_OK);
    CHECK_NEAR(move(&r, WAY[i][0], WAY[i][1], WAY[i][2]), force, 1e-8);
    for (int j = 0; j < 3; j++)
      CHECK_NEAR(r.state[j], trial[j], 1e-8);
  }
  free_rig(&r);
}

/* Its force falls while it yields: the balance with the brace lies beyond where the brace would leave it alone. */
static void check_brace(void)
{
  const double p[] = {9.0, 0.5, 0.8, 0.5, 0.02, 1.0, 0.4, 0.6, 2.0, 0.0, 0.5}, brace = 25.0, u[] = {0.3, 0.8, 1.1, 0.2, -1.4, -0.6, 1.9};
  rig braced = new_rig(ED_LAW_MODIFIED_BOUC_WEN, 11, p, brace), bare = new_rig(ED_LAW_MODIFIED_BOUC_WEN, 11, p, 0.0);
  double before = 0.0;
  int falls = 0;
  for (int i = 0; i < 7; i++) {
    const double force = move_to(&braced, u[i]);
    CHECK_NEAR(move_to(&bare, u[i] - force / brace), force, 1e-7); /* balance to 1e-9 of the forces and brace k_b u */
    falls += i > 0 && i < 3 && force < before;
    before = force;
    check_slopes(&braced, 1.0, u[i] + 0.05, 0.05, 1e-4, 1e-4, 2e-4);
  }
  CHECK_INT(falls, 1);
  free_rig(&braced);
  free_rig(&bare);
}

int main(void)
{
  check_plain();
  check_yielded();
  check_against_sundials();
  check_brace();
  return checks_end("modified_bouc_wen");
}
