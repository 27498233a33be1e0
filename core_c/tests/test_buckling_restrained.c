/* Buckling-restrained brace against its manufacturer's values and closed forms. The core is tested in its own strain: with KF = L_wp / L_y
 * the brace is a spring E A_sc / L_wp with L_wp = L_y, so that a deformation is a strain of the core times L_y. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>

/* A brace of 5 m with 3.4 m of yielding core: 3000 mm2 of 260 MPa, omega and beta at 1 % and 2 %. */
enum { N = 14 };
static const double BRACE[N] = {3e-3, 260e6, 200e9, 5.0, 3.4, 1.3, 0.004, 1.1, 0.01, 1.25, 1.04, 0.02, 1.45, 1.12};
static const double YIELD = 780e3, STIFFNESS = 1.3 * 200e9 * 3e-3 / 5.0;

/* The protocol's cycles in strains of the core, by the deformation that the brace has at them with the force it has then. */
static double force_at_strain(rig *brace, double strain)
{
  double u = brace->u, force = 0.0;
  for (int i = 0; i < 60; i++) { /* u = F / K + plastic, strain = F / (E A) + plastic / L_y: contracts by the share of the ends */
    rig trial = *brace;
    force = move_to(&trial, u);
    const double next = 3.4 * (strain - force / (200e9 * 3e-3)) + force / STIFFNESS;
    if (fabs(next - u) < 1e-15)
      break;
    u = next;
  }
  return move_to(brace, u);
}

static void check_protocol(void)
{
  const double early = (0.005 - 260e6 / 200e9) / (0.01 - 260e6 / 200e9), c1 = 1.25 * 1.04, c2 = 1.45 * 1.12;
  const double reached[2][4] = {{1.0 + 0.25 * early, 1.25, 1.35, 1.45}, {1.0 + (c1 - 1.0) * early, c1, 0.5 * (c1 + c2), c2}};
  rig brace = new_rig(ED_LAW_BUCKLING_RESTRAINED, N, BRACE, 0.0);
  double last[2] = {0.0, 0.0};
  for (int step = 1; step <= 4; step++)
    for (int cycle = 0; cycle < 2; cycle++)
      for (int side = 0; side < 2; side++) {
        const double force = force_at_strain(&brace, (side ? -1.0 : 1.0) * 0.005 * step);
        CHECK(fabs(force) > last[side]); /* hardens from cycle to cycle */
        last[side] = fabs(force);
        if (cycle == 1) /* what is given at 1 % and 2 %, and between that and F_ysc at first yielding */
          CHECK_NEAR(last[side], reached[side][step - 1] * YIELD, 1e-8 * YIELD); /* of the balance above: 1e-15 m K = 1e-9 Fy */
      }
  free_rig(&brace);
}

/* Without isotropic hardening (beta = 1, omega of kinematic hardening alone) it is the elastic-plastic law. */
static void check_kinematic(void)
{
  const double b = 0.02, k = 200e9 * 3e-3 / 3.4, h = b * k / (1.0 - b), strain = 0.02;
  /* F = Fy + H p, strain = F / (E A) + p / L_y */
  const double p = 3.4 * (strain - YIELD / 600e6) / (1.0 + h * 3.4 / 600e6), omega = 1.0 + h * p / YIELD;
  const double values[] = {3e-3, 260e6, 200e9, 3.4, 3.4, 1.0, b, 1.0, strain, omega, 1.0};
  rig brace = new_rig(ED_LAW_BUCKLING_RESTRAINED, 11, values, 0.0);
  rig plain = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, (const double[]){k, YIELD, b}, 0.0);
  numbers source = {3};
  for (int i = 0; i < 500; i++) {
    const double u = next_number(&source, -0.1, 0.1);
    CHECK_NEAR(move_to(&brace, u), move_to(&plain, u), 1e-9 * YIELD); /* forces to 20 Fy, isotropic hardening to rounding */
  }
  free_rig(&brace);
  free_rig(&plain);
}

/* First loading: up to yield K, then at once the slope of the first segment. Far beyond the table only alpha K is left. */
static void check_slopes_of_parts(void)
{
  rig brace = new_rig(ED_LAW_BUCKLING_RESTRAINED, N, BRACE, 0.0);
  const double yields = YIELD / STIFFNESS;
  CHECK_NEAR(move_to(&brace, 0.7 * yields), 0.7 * YIELD, 1e-12 * YIELD);
  CHECK_NEAR(move_to(&brace, yields), YIELD, 1e-12 * YIELD);
  (void)move_to(&brace, 3.0); /* a path of 3 m, beyond that of the protocol */
  const double far = move_to(&brace, 3.1), further = move_to(&brace, 3.2);
  CHECK_NEAR((further - far) / 0.1, 0.004 * STIFFNESS, 1e-9 * STIFFNESS);
  const double back = move_to(&brace, 3.2 - yields);
  CHECK_NEAR(further - back, YIELD, 1e-9 * YIELD); /* elastic unloading */
  free_rig(&brace);
}

/* A path in one step or in many, past several ends of segments. */
static void check_subdivision(void)
{
  rig coarse = new_rig(ED_LAW_BUCKLING_RESTRAINED, N, BRACE, 0.0), fine = new_rig(ED_LAW_BUCKLING_RESTRAINED, N, BRACE, 0.0);
  numbers source = {7};
  for (int i = 0; i < 200; i++) {
    const double from = coarse.u, to = next_number(&source, -0.2, 0.2);
    double force = 0.0;
    for (int j = 1; j <= 9; j++)
      force = move_to(&fine, from + (to - from) * j / 9.0);
    CHECK_NEAR(move_to(&coarse, to), force, 1e-9 * YIELD);
  }
  free_rig(&coarse);
  free_rig(&fine);
}

static void check_random_slopes(void)
{
  rig brace = new_rig(ED_LAW_BUCKLING_RESTRAINED, N, BRACE, 0.0);
  numbers source = {23};
  for (int i = 0; i < 400; i++) {
    const double u = next_number(&source, -0.05, 0.05), v = next_number(&source, -20.0, 20.0);
    check_slopes(&brace, 0.01, u, v, 1e-8, 1e-6, 1e-6 * STIFFNESS);
    (void)move(&brace, 0.01, u, v);
  }
  free_rig(&brace);
}

static void refuses(int at, double value, const char *text)
{
  double values[N];
  for (int i = 0; i < N; i++)
    values[i] = i == at ? value : BRACE[i];
  check_refused(ED_LAW_BUCKLING_RESTRAINED, N, values, text);
}

int main(void)
{
  check_protocol();
  check_kinematic();
  check_slopes_of_parts();
  check_subdivision();
  check_random_slopes();
  refuses(0, -1.0, "A_sc = -1");
  refuses(4, 6.0, "L_y = 6 is not allowed: at most L_wp = 5");
  refuses(5, 0.9, "KF = 0.9");
  refuses(5, 1.5, "L_wp / L_y = 1.47059");
  refuses(6, 0.1, "alpha = 0.1 is not allowed: at most 0.0");
  refuses(7, 0.9, "R_y = 0.9");
  refuses(8, 0.001, "strain1 = 0.001");
  refuses(9, 0.99, "omega1 = 0.99");
  refuses(10, 0.5, "beta1 = 0.5");
  refuses(11, 0.01, "strains ascend");
  refuses(11, 0.0101, "omega2 = 1.45 is not allowed: from the point before");
  refuses(8, 2.0, "strain1 = 2 is not allowed: greater than 0 and less than 1");
  refuses(12, 1.0, "omega2 = 1 is not allowed: at least omega1 = ");
  check_refused(ED_LAW_BUCKLING_RESTRAINED, N - 1, BRACE, "R_y, then strain, omega, beta of each of 1 to 16");
  return checks_end("buckling-restrained brace");
}
