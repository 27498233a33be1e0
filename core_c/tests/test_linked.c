/* Histories of a linear structure with dampers as links: a free mass that a link alone holds. */
#include "checks.h"
#include "edcore.h"

#include <math.h>

enum { N = 400 };
static const double H = 0.01, MASS = 2.0, OMEGA = 5.0;
static double ground[N], pushed[(N - 1) * 2], state[2 * N * 2], force[2 * N];

/* q'' = -g - f/m from sample to sample, g and f linear: q1 = q + h v + h^2 (2 a0 + a1)/6, v1 = v + h (a0 + a1)/2. */
static ed_linked_test free_mass(const double a[4], double of_links[2][2])
{
  double of_ground[2][2];
  for (int end = 0; end < 2; end++) {
    of_ground[end][0] = -(end ? 1.0 : 2.0) * H * H / 6.0;
    of_ground[end][1] = -0.5 * H;
    for (int i = 0; i < 2; i++)
      of_links[end][i] = of_ground[end][i] / MASS;
  }
  for (int i = 0; i < N - 1; i++)
    for (int j = 0; j < 2; j++)
      pushed[2 * i + j] = of_ground[0][j] * ground[i] + of_ground[1][j] * ground[i + 1];
  return (ed_linked_test){N, H, pushed, a, {of_links[0], of_links[1]}};
}

static int run(int law, int n, const double *p, int effect, int n_parameters, const double *parameters, int tests, int carry)
{
  static const double a[4] = {1.0, 0.01, 0.0, 1.0}, seen[4] = {1.0, 0.0, 0.0, 1.0};
  double of_links[2][2];
  char message[256];
  int status;
  ed_damper *damper = ed_damper_new(law, n, p, 0.0, 0.0, &status, message, sizeof message);
  if (n_parameters)
    CHECK_STATUS(ed_damper_add_effect(damper, effect, ED_PLACE_WHOLE, n_parameters, parameters, message, sizeof message), ED_OK);
  const ed_damper *const given = damper;
  const ed_linked_test one = free_mass(a, of_links), both[2] = {one, one};
  ed_campaign_end end;
  status = ed_linked_history(2, 1, &given, seen, tests, both, carry, 1e6, ED_DAMPER_BEST, 1e-6, state, force, &end);
  CHECK_INT(end.status, status);
  ed_damper_free(damper);
  return status;
}

/* Chopra, Dynamics of Structures, 4.3: q = -g/w^2 (1 - cos w t) under a step of acceleration. */
static void check_spring(void)
{
  const double k = MASS * OMEGA * OMEGA, spring[] = {k, 0.0};
  for (int i = 0; i < N; i++)
    ground[i] = 1.0;
  CHECK_STATUS(run(ED_LAW_KELVIN_VOIGT, 2, spring, 0, 0, NULL, 1, ED_CARRY_NOTHING), ED_OK);
  for (int i = 0; i < N; i++) {
    const double exact = -(1.0 - cos(OMEGA * H * i)) / (OMEGA * OMEGA);
    /* the force is linear in a step: the period is off by (w h)^2 / 24 = 1e-4 of it, over 20 rad of phase */
    CHECK_NEAR(state[2 * i], exact, 3e-3 / (OMEGA * OMEGA));
    CHECK_NEAR(force[i], k * state[2 * i], 1e-8 * k);
  }
}

/* What yields at F under a larger m g goes on with the acceleration g - F/m. */
static void check_yielding(void)
{
  const double law[] = {4e3, 1.5, 0.0};
  CHECK_STATUS(run(ED_LAW_ELASTIC_PLASTIC, 3, law, 0, 0, NULL, 1, ED_CARRY_NOTHING), ED_OK);
  for (int i = N / 2; i < N; i++) {
    CHECK_NEAR(force[i], -1.5, 1e-9);
    CHECK_NEAR((state[2 * i + 1] - state[2 * i - 1]) / H, -(1.0 - 1.5 / MASS), 1e-9);
  }
}

/* What has broken in one test is broken in the next of the same specimen alone. */
static void check_carry(void)
{
  const double spring[] = {60.0, 0.0}, damage[] = {0.6, 0.02, 2.0, 0.0};
  CHECK_STATUS(run(ED_LAW_KELVIN_VOIGT, 2, spring, ED_EFFECT_MULLINS_DAMAGE, 4, damage, 2, ED_CARRY_EFFECTS), ED_OK);
  /* after far more than 0.02 m 0.4 of the stiffness is left, from the first step of the second test on */
  CHECK_NEAR(force[N + 1], 0.4 * 60.0 * state[2 * (N + 1)], 1e-6 * fabs(force[N + 1]));
  CHECK_STATUS(run(ED_LAW_KELVIN_VOIGT, 2, spring, ED_EFFECT_MULLINS_DAMAGE, 4, damage, 2, ED_CARRY_NOTHING), ED_OK);
  CHECK_NEAR(force[N + 1], 60.0 * state[2 * (N + 1)], 1e-4 * fabs(force[N + 1]));
  CHECK_SAME(force + N, force, N);
}

static void check_refusals(void)
{
  ed_linked_test test = {.n = 1, .h = H};
  ed_campaign_end end;
  CHECK_STATUS(ed_linked_history(2, 0, NULL, NULL, 1, &test, 0, 0.0, ED_DAMPER_BEST, 1e-6, state, force, &end), ED_E_ARGUMENT);
  test = (ed_linked_test){.n = N, .h = 0.0};
  CHECK_STATUS(ed_linked_history(2, 0, NULL, NULL, 1, &test, 0, 0.0, ED_DAMPER_BEST, 1e-6, state, force, &end), ED_E_ARGUMENT);
  test.h = H;
  CHECK_STATUS(ed_linked_history(2, 0, NULL, NULL, 1, &test, 1, 0.0, ED_DAMPER_BEST, 1e-6, state, force, &end), ED_E_ARGUMENT);
  ground[3] = NAN;
  const double spring[] = {50.0, 0.0};
  CHECK(run(ED_LAW_KELVIN_VOIGT, 2, spring, 0, 0, NULL, 1, ED_CARRY_NOTHING) != ED_OK);
}

int main(void)
{
  check_spring();
  check_yielding();
  check_carry();
  check_refusals();
  return checks_end("linked histories");
}
