/* Campaigns: to the last bit what single calls give; one specimen from test to test against one long test; failures and refusals. */
#include "checks.h"
#include "edcore.h"
#include "in_series.h"

#include <math.h>
#include <string.h>

enum { N = 300, TESTS = 4, SETS = 3, ALL = TESTS * N, LAWS = 4 };
static const double MGMM[] = {0.515e6, 15.1e3, 0.107e6, 21e3, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
static const double MODIFIED[] = {30e6, 20e6, 5e-3, 1e-3, 0.05, 1.0, 0.5, 0.5, 1.5, 50e3, 0.5};
static const double BOUC_WEN[] = {100e3, 2e-3, 0.05, 1.0, 0.5, 0.5, 1.5};
static double t[TESTS][N], u[TESTS][N], v[TESTS][N], factor[N], added[N], spring[N];
static double force[SETS][TESTS][N], own[SETS][TESTS][N], expected[N], expected_own[N];
static const ed_rig RIG = {80e6, 0.7, 1e4, 1.0, 0.0, 5e-4, 1e4};
static const struct {
  int law, n;
  const double *p;
  double brace;
} LAW[LAWS] = {{ED_LAW_MGMM, 12, MGMM, 0.0}, {ED_LAW_BOUC_WEN, 7, BOUC_WEN, 60e6}, {ED_LAW_MODIFIED_BOUC_WEN, 11, MODIFIED, 0.0},
               {ED_LAW_MODIFIED_BOUC_WEN, 11, MODIFIED, 60e6}};

static ed_damper *make(int i, double scale)
{
  double p[12];
  int status;
  char message[256];
  memcpy(p, LAW[i].p, (size_t)LAW[i].n * sizeof *p);
  p[0] *= scale;
  ed_damper *made = ed_damper_new(LAW[i].law, LAW[i].n, p, LAW[i].brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return made;
}

/* From rest to rest at zero, but the last test: it begins and ends in motion. */
static void motions(void)
{
  for (int k = 0; k < TESTS; k++)
    for (int i = 0; i < N; i++) {
      const double h = 0.01, T = (N - 1) * h, w = 5.0 + k, a = (3.0 + k) * 1e-3, s = t[k][i] = i * h;
      const double window = k == TESTS - 1 ? 1.0 : pow(sin(M_PI * s / T), 2.0), slope = k == TESTS - 1 ? 0.0 : M_PI / T * sin(2.0 * M_PI * s / T);
      u[k][i] = a * window * sin(w * s + (k == TESTS - 1));
      v[k][i] = a * (window * w * cos(w * s + (k == TESTS - 1)) + slope * sin(w * s));
    }
  for (int k = 0; k < TESTS - 1; k++)
    u[k][0] = u[k][N - 1] = v[k][0] = v[k][N - 1] = 0.0;
  for (int i = 0; i < N; i++) {
    factor[i] = 1.0 - 1e-3 * i;
    added[i] = 10.0 * i;
    spring[i] = 1e5;
  }
}

static void tests(ed_test test[TESTS])
{
  for (int k = 0; k < TESTS; k++)
    test[k] = (ed_test){.n = N - 10 * k, .time = t[k], .u = u[k], .v = v[k], .rest = 30.0};
}

/* Tests without rig, and with one and everything beside the damper. */
static void check_single_calls(int method)
{
  ed_test test[TESTS];
  ed_campaign_end end[SETS];
  tests(test);
  test[1].rig = test[3].rig = &RIG;
  test[1].factor = factor, test[1].added = added, test[1].spring = spring;
  test[2].factor = factor, test[2].added = added, test[2].spring = spring;
  for (int i = 0; i < LAWS; i++) {
    const double fineness = method == ED_DAMPER_FIXED ? 1e-3 : 1e-6;
    ed_damper *damper[SETS];
    for (int s = 0; s < SETS; s++)
      damper[s] = make(i, 1.0 + 0.1 * s);
    double *all = &force[0][0][0], *deformations = &own[0][0][0];
    CHECK_STATUS(ed_damper_campaign(SETS, (const ed_damper *const *)damper, TESTS, test, method, fineness, 0, all, deformations, end), ED_OK);
    for (int s = 0; s < SETS; s++) {
      CHECK_STATUS(end[s].status, ED_OK);
      for (int k = 0; k < TESTS; k++) {
        const ed_test *one = &test[k];
        int done;
        if (one->rig)
          CHECK_STATUS(history_in_series(damper[s], method, fineness, one->n, one->time, one->u, one->v, one->factor, one->added,
                                                   one->spring, one->rig, expected, expected_own, &done), ED_OK);
        else
          CHECK_STATUS(ed_damper_history(damper[s], method, fineness, one->n, one->time, one->u, one->v, expected, &done), ED_OK);
        for (int j = 0; !one->rig && j < one->n; j++) {
          expected_own[j] = one->u[j];
          if (one->factor)
            expected[j] = factor[j] * expected[j] + added[j] + spring[j] * one->u[j];
        }
        CHECK_SAME(all, expected, one->n);
        CHECK_SAME(deformations, expected_own, one->n);
        all += one->n;
        deformations += one->n;
      }
    }
    /* without deformations, and the last damper alone */
    const size_t each = (size_t)(all - &force[0][0][0]) / SETS;
    static double again[ALL];
    CHECK_STATUS(ed_damper_campaign(1, (const ed_damper *const *)&damper[SETS - 1], TESTS, test, method, fineness, 0, again, NULL, end), ED_OK);
    CHECK_SAME(again, all - each, (int)each);
    for (int s = 0; s < SETS; s++)
      ed_damper_free(damper[s]);
  }
}

/* Three tests and two rests as one long test; each begins and ends at rest at zero, so that nothing is left of what the law itself
 * relaxes but exp(-30 s / 0.03 s). */
static void check_carry(const ed_rig *rig, double brace)
{
  static const struct {
    int form, n, placement;
    double p[4];
  } EFFECT[] = {{ED_EFFECT_PAYNE_WHOLE, 4, 0, {0.3, 5e-3, 1.0, 50.0}},     {ED_EFFECT_SELF_HEATING_RATE, 2, 0, {1e-4, 100.0}},
                   {ED_EFFECT_MULLINS_PATH, 4, 0, {0.3, 0.1, 0.8}},                {ED_EFFECT_MULLINS_MAXIMUM, 4, 0, {0.3, 5e-3, 0.1}},
                   {ED_EFFECT_DEGRADATION_ENERGY, 3, 0, {0.3, 1e3, 0.8}},          {ED_EFFECT_PAYNE_NETWORK, 3, 0, {0.3, 5e-3, 20.0}},
                   {ED_EFFECT_RELAXATION_BRANCH_MAXWELL, 2, 0, {1e6, 20.0}},
                   {ED_EFFECT_MULLINS_PATH, 4, ED_PLACE_SPRINGS, {0.2, 0.2, 1.0}}, {ED_EFFECT_MULLINS_DAMAGE, 4, ED_PLACE_DASHPOTS, {0.2, 3e-3, 1.0}},
                   {ED_EFFECT_MULLINS_DAMAGE, 4, 1, {0.3, 5e-3, 2.0}}};
  enum { CARRIED = 3, LONG = CARRIED * N };
  static double long_t[LONG], long_u[LONG], long_v[LONG], long_force[LONG], long_own[LONG], apart[2][ALL], deformation[ALL];
  ed_test test[TESTS];
  int status, done;
  char message[256];
  ed_campaign_end end;
  tests(test);
  double from = 0.0;
  for (int k = 0; k < CARRIED; k++) {
    test[k].n = N;
    test[k].rest = 20.0 + k;
    test[k].rig = rig;
    from += k ? long_t[k * N - 1] - from + test[k].rest : 0.0;
    for (int i = 0; i < N; i++) {
      long_t[k * N + i] = from + t[k][i];
      long_u[k * N + i] = u[k][i];
      long_v[k * N + i] = v[k][i];
    }
  }
  ed_damper *damper = ed_damper_new(ED_LAW_MGMM, 12, MGMM, brace, 0.0, &status, message, sizeof message);
  for (int i = 0; i < (brace > 0.0 ? 9 : 10); i++)
    CHECK_STATUS(ed_damper_add_effect(damper, EFFECT[i].form, EFFECT[i].placement, EFFECT[i].n, EFFECT[i].p, message, sizeof message), ED_OK);
  if (rig)
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, LONG, long_t, long_u, long_v, NULL, NULL, NULL, rig, long_force, long_own, &done), ED_OK);
  else
    CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_BEST, 1e-6, LONG, long_t, long_u, long_v, long_force, &done), ED_OK);
  const ed_damper *const one = damper;
  for (int carry = 0; carry < 2; carry++)
    CHECK_STATUS(ed_damper_campaign(1, &one, CARRIED, test, ED_DAMPER_BEST, 1e-6, carry, apart[carry], deformation, &end), ED_OK);
  CHECK_STATUS(end.status, ED_OK);
  double largest = 0.0, changed = 0.0;
  for (int i = 0; i < LONG; i++)
    largest = fmax(largest, fabs(long_force[i]));
  for (int i = 0; i < LONG; i++) { /* behind a brace or rig the damper ends a test off zero, and the long one sees it go back */
    CHECK_NEAR(apart[1][i], long_force[i], (rig || brace > 0.0 ? 5e-3 : 1e-11) * largest);
    changed = fmax(changed, fabs(apart[1][i] - apart[0][i]));
  }
  CHECK_SAME(apart[0], apart[1], N); /* the first test has none before it */
  CHECK(changed > 0.1 * largest);
  ed_damper_free(damper);
}

/* Extremes that soften go on; what relaxes or yields begins anew. */
static void check_extremes(void)
{
  static double again[2 * N], single[N];
  ed_test test[TESTS], both[2];
  ed_campaign_end end;
  tests(test);
  both[0] = test[3];
  both[1] = test[1];
  for (int method = ED_DAMPER_BEST; method <= ED_DAMPER_FIXED; method++)
    for (int i = 0; i < LAWS; i++) {
      int done;
      if (method == ED_DAMPER_ODE && i == 1)
        continue;
      const double fineness = method == ED_DAMPER_FIXED ? 1e-3 : 1e-7;
      ed_damper *damper = make(i, 1.0);
      const ed_damper *const one = damper;
      CHECK_STATUS(ed_damper_campaign(1, &one, 2, both, method, fineness, 1, again, NULL, &end), ED_OK);
      CHECK_STATUS(end.status, ED_OK);
      if (i == 0) {
        double prior_extremes[4] = {0.0};
        for (int k = 0; k < both[0].n; k++) {
          prior_extremes[0] = fmax(prior_extremes[0], u[3][k]), prior_extremes[1] = fmin(prior_extremes[1], u[3][k]);
          prior_extremes[2] = fmax(prior_extremes[2], v[3][k]), prior_extremes[3] = fmin(prior_extremes[3], v[3][k]);
        }
        CHECK_STATUS(ed_damper_set_prior_extremes(damper, prior_extremes), ED_OK);
      }
      CHECK_STATUS(ed_damper_history(damper, method, fineness, both[1].n, t[1], u[1], v[1], single, &done), ED_OK);
      double largest = 0.0, apart = 0.0;
      for (int k = 0; k < both[1].n; k++) {
        largest = fmax(largest, fabs(single[k]));
        apart = fmax(apart, fabs(single[k] - again[both[0].n + k]));
      }
      if (i == 0)
        CHECK(apart < 3e-3 * largest); /* extremes lie between samples */
      else if (i == 1)
        CHECK(apart == 0.0);
      else
        CHECK(apart > 0.05 * largest);
      ed_damper_free(damper);
    }
}

static void check_failures(void)
{
  enum { BAD = 1 };
  ed_test test[TESTS];
  ed_campaign_end end[SETS];
  ed_damper *damper[SETS];
  int status;
  char message[256];
  tests(test);
  static double far[N];
  memcpy(far, u[2], sizeof far);
  far[7] = 1e200;
  test[2].u = far;
  for (int s = 0; s < SETS; s++) { /* twice 1e200 is finite, 1e300 times not */
    const double p[] = {s == BAD ? 1e300 : 2.0, 0.0};
    damper[s] = ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, p, 0.0, 0.0, &status, message, sizeof message);
  }
  double *all = &force[0][0][0];
  const ed_damper *const *given = (const ed_damper *const *)damper;
  CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 0, all, &own[0][0][0], end), ED_OK);
  const int each = 4 * N - 60, at = 2 * N - 10 + 7;
  for (int s = 0; s < SETS; s++) {
    CHECK_STATUS(end[s].status, s == BAD ? ED_E_NOT_FINITE : ED_OK);
    CHECK_INT(end[s].test, s == BAD ? 2 : 0);
    CHECK_INT(end[s].sample, s == BAD ? 7 : 0);
    for (int i = 0; i < each; i++)
      CHECK(isfinite(all[s * each + i]) == (s != BAD || i < at));
  }
  CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_FIXED, 0.0, 0, all, NULL, end), ED_OK);
  for (int s = 0; s < SETS; s++)
    CHECK_STATUS(end[s].status, ED_E_ARGUMENT);
  /* tests that are not allowed */
  test[2].u = u[2];
  far[7] = NAN;
  test[1].v = far;
  CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 0, all, NULL, end), ED_E_NOT_FINITE);
  for (int s = 0; s < SETS; s++)
    CHECK(end[s].status == ED_E_NOT_FINITE && end[s].test == 1 && end[s].sample == 7);
  test[1].v = v[1];
  static const double rests[] = {0.0, -1.0, NAN, INFINITY};
  for (int i = 0; i < 4; i++) {
    test[3].rest = rests[i];
    CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 1, all, NULL, end), ED_E_ARGUMENT);
    CHECK_INT(end[0].test, 3);
    CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 0, all, NULL, end), ED_OK);
  }
  ed_rig wrong = RIG;
  wrong.stiffness = -1.0;
  test[0].rig = &wrong;
  CHECK_STATUS(ed_damper_campaign(SETS, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 0, all, NULL, end), ED_E_ARGUMENT);
  CHECK_STATUS(ed_damper_campaign(0, given, TESTS, test, ED_DAMPER_BEST, 1e-6, 0, all, NULL, end), ED_E_ARGUMENT);
  CHECK_STATUS(ed_damper_campaign(SETS, given, 0, test, ED_DAMPER_BEST, 1e-6, 0, all, NULL, end), ED_E_ARGUMENT);
  for (int s = 0; s < SETS; s++)
    ed_damper_free(damper[s]);
}

/* Dampers of a test in place of the campaign's, with effects alone carried; another law in their place. */
static void check_dampers_of_tests(void)
{
  const double path[] = {0.3, 0.2, 1.0}; /* 1 - 0.3 (1 - exp(-s/0.2)) */
  ed_test test[TESTS];
  ed_campaign_end end[SETS];
  ed_damper *cold[SETS], *warm[SETS], *viscous;
  int status, done;
  char message[256];
  double way = 0.0;
  tests(test);
  for (int s = 0; s < SETS; s++) {
    cold[s] = make(0, 1.0 + 0.1 * s);
    warm[s] = make(0, 0.8 + 0.1 * s);
  }
  test[1].damper = (const ed_damper *const *)warm;
  CHECK_STATUS(ed_damper_campaign(SETS, (const ed_damper *const *)cold, 2, test, ED_DAMPER_BEST, 1e-6, ED_CARRY_EFFECTS,
                                  &force[0][0][0], NULL, end), ED_OK);
  for (int s = 0; s < SETS; s++) {
    const double *all = &force[0][0][0] + (size_t)s * (size_t)(test[0].n + test[1].n);
    CHECK_STATUS(end[s].status, ED_OK);
    for (int k = 0; k < 2; k++) {
      CHECK_STATUS(ed_damper_history(k ? warm[s] : cold[s], ED_DAMPER_BEST, 1e-6, test[k].n, t[k], u[k], v[k], expected, &done), ED_OK);
      CHECK(memcmp(all + (k ? test[0].n : 0), expected, (size_t)test[k].n * sizeof *expected) == 0);
    }
    CHECK_STATUS(ed_damper_add_effect(cold[s], ED_EFFECT_DEGRADATION_PATH, 0, 3, path, message, sizeof message), ED_OK);
    CHECK_STATUS(ed_damper_add_effect(warm[s], ED_EFFECT_DEGRADATION_PATH, 0, 3, path, message, sizeof message), ED_OK);
  }
  CHECK_STATUS(ed_damper_campaign(1, (const ed_damper *const *)cold, 2, test, ED_DAMPER_BEST, 1e-6, ED_CARRY_EFFECTS,
                                  &force[0][0][0], NULL, end), ED_OK);
  for (int i = 1; i < test[0].n; i++)
    way += fabs(u[0][i] - u[0][i - 1]);
  ed_damper *plain = make(0, 0.8);
  CHECK_STATUS(ed_damper_history(plain, ED_DAMPER_BEST, 1e-6, test[1].n, t[1], u[1], v[1], expected, &done), ED_OK);
  for (int i = 0; i < test[1].n; i++) {
    way += i ? fabs(u[1][i] - u[1][i - 1]) : 0.0;
    /* sums in another order */
    CHECK_NEAR(*(&force[0][0][0] + test[0].n + i), (1.0 - 0.3 * (1.0 - exp(-way / 0.2))) * expected[i], 1e-9 * 1e5);
  }
  const double c = 1e5;
  viscous = ed_damper_new(ED_LAW_VISCOUS, 1, &c, 0.0, 0.0, &status, message, sizeof message);
  test[1].damper = (const ed_damper *const *)&viscous;
  CHECK_STATUS(ed_damper_campaign(1, (const ed_damper *const *)cold, 2, test, ED_DAMPER_BEST, 1e-6, ED_CARRY_NOTHING, &force[0][0][0],
                                  NULL, end), ED_OK);
  CHECK_STATUS(end[0].status, ED_E_ARGUMENT);
  CHECK(end[0].test == 1 && isnan((&force[0][0][0])[test[0].n]));
  for (int s = 0; s < SETS; s++) {
    ed_damper_free(cold[s]);
    ed_damper_free(warm[s]);
  }
  ed_damper_free(plain);
  ed_damper_free(viscous);
}

/* Sets that differ in nothing but effects, with others between them: as each of them alone, whatever goes on from test to test. */
static void check_shared_law(const ed_rig *rig)
{
  enum { DAMPERS = 6 };
  static const struct {
    int form, placement, n;
    double p[4], scale; /* of the law */
  } EACH[DAMPERS] = {{ED_EFFECT_MULLINS_PATH, ED_PLACE_WHOLE, 4, {0.3, 0.1, 1.0, 0.5}, 1.0},
                     {ED_EFFECT_DEGRADATION_PATH, ED_PLACE_WHOLE, 3, {0.3, 0.2, 0.6}, 1.2},
                     {ED_EFFECT_SELF_HEATING_RATE, ED_PLACE_WHOLE, 2, {1e-5, 50.0}, 1.0},
                     {ED_EFFECT_MULLINS_PATH, ED_PLACE_SPRINGS, 4, {0.2, 0.1, 1.0, 0.2}, 1.0},
                     {ED_EFFECT_HARDENING_POWER, ED_PLACE_WHOLE, 3, {1e5, 3.0, 5e-3}, 1.2},
                     {ED_EFFECT_PAYNE_NETWORK, ED_PLACE_INSIDE, 3, {0.3, 0.05, 2.0}, 1.0}};
  static const int carries[] = {ED_CARRY_NOTHING, ED_CARRY_EFFECTS, ED_CARRY_ALL};
  static double every[DAMPERS][ALL], alone[ALL];
  ed_test test[TESTS];
  ed_campaign_end end[DAMPERS];
  ed_damper *damper[DAMPERS];
  char message[256];
  tests(test);
  test[2].rig = rig;
  for (int i = 0; i < DAMPERS; i++) {
    damper[i] = make(0, EACH[i].scale);
    CHECK_STATUS(ed_damper_add_effect(damper[i], EACH[i].form, EACH[i].placement, EACH[i].n, EACH[i].p, message, sizeof message), ED_OK);
  }
  size_t samples = 0;
  for (int k = 0; k < TESTS; k++)
    samples += (size_t)test[k].n;
  for (int c = 0; c < 3; c++) {
    CHECK_STATUS(ed_damper_campaign(DAMPERS, (const ed_damper *const *)damper, TESTS, test, ED_DAMPER_FIXED, 1e-3, carries[c], &every[0][0],
                                    NULL, end), ED_OK);
    for (int i = 0; i < DAMPERS; i++) {
      CHECK_STATUS(end[i].status, ED_OK);
      CHECK_STATUS(ed_damper_campaign(1, (const ed_damper *const *)&damper[i], TESTS, test, ED_DAMPER_FIXED, 1e-3, carries[c], alone, NULL,
                                      end), ED_OK);
      CHECK_SAME(&every[0][0] + (size_t)i * samples, alone, (int)samples);
    }
  }
  for (int i = 0; i < DAMPERS; i++)
    ed_damper_free(damper[i]);
}

int main(void)
{
  motions();
  check_single_calls(ED_DAMPER_BEST);
  check_single_calls(ED_DAMPER_FIXED);
  check_carry(NULL, 0.0);
  check_carry(NULL, 60e6);
  check_carry(&(ed_rig){80e6, 0.7, 1e4, 1.0, 0.0, 0.0, 1e4}, 0.0); /* pins with play would not go back by themselves */
  check_extremes();
  check_failures();
  check_dampers_of_tests();
  check_shared_law(NULL);
  check_shared_law(&RIG);
  return checks_end("campaigns of dampers");
}
