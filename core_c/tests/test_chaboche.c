/* Steel with combined hardening. First loading is closed form (Voce 1955, Armstrong & Frederick 1966); loops and random ways are compared in
 * tests/verification/test_verify_steel_law.py. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>

enum { PARAMETERS = 8 };
static const double P[PARAMETERS] = {10.0, 2.0, 8.0, 6.0, 0.5, 0.4, 0.6, 0.3}, SOFTENING[PARAMETERS] = {10.0, 2.0, 8.0, 6.0, 0.5, 0.0, -0.9, 0.7};

static double first_loading(const double *p, double plastic, double *tangent)
{
  const double linear = p[5] == 0.0;
  const double hardening = p[6] * p[7] * exp(-p[7] * plastic) + p[2] * exp(-p[3] * plastic) + p[4] * exp(-p[5] * plastic);
  *tangent = p[0] * hardening / (p[0] + hardening);
  return p[1] + p[6] * (1.0 - exp(-p[7] * plastic)) + p[2] / p[3] * (1.0 - exp(-p[3] * plastic)) +
         (linear ? p[4] * plastic : p[4] / p[5] * (1.0 - exp(-p[5] * plastic)));
}

static void check_first_loading(const double *p)
{
  for (int side = -1; side <= 1; side += 2) {
    rig device = new_rig(ED_LAW_CHABOCHE, PARAMETERS, p, 0.0);
    for (double plastic = 1e-9; plastic < 30.0; plastic *= 2.7) {
      double tangent, trial[LARGEST_DAMPER_STATE], got, slope[2];
      const double force = first_loading(p, plastic, &tangent), u = side * (force / p[0] + plastic);
      CHECK_STATUS(ed_damper_step(device.damper, ED_DAMPER_BEST, 1e-6, device.state, 1.0, device.u, 0.0, u, 0.0, trial, &got, slope), ED_OK);
      CHECK_NEAR(slope[0], tangent, 1e-11 * p[0]);
      CHECK_NEAR(move_to(&device, u), side * force, 1e-12 * force);
    }
    free_rig(&device);
  }
}

/* Of steps that end anywhere, some of which turn in between. */
static void check_random_slopes(const double *p)
{
  rig device = new_rig(ED_LAW_CHABOCHE, PARAMETERS, p, 0.0);
  numbers random = {11};
  for (int i = 0; i < 400; i++) {
    const double u = next_number(&random, -2.0, 2.0), v = next_number(&random, -300.0, 300.0);
    check_slopes(&device, 0.01, u, v, 1e-6, 1e-4, 1e-5);
    (void)move(&device, 0.01, u, v);
  }
  free_rig(&device);
}

int main(void)
{
  check_first_loading(P);
  check_first_loading(SOFTENING);
  check_random_slopes(P);
  check_random_slopes(SOFTENING);
  check_refused(ED_LAW_CHABOCHE, PARAMETERS, (const double[]){10.0, 2.0, 8.0, 6.0, 0.5, 0.4, -2.0, 0.3}, "Q = -2");
  check_refused(ED_LAW_CHABOCHE, PARAMETERS, (const double[]){10.0, 2.0, 8.0, 6.0, 0.5, 0.4, -1.0, 10.0}, "b = 10");
  return checks_end("chaboche");
}
