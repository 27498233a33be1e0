/* What effects remember from one test of a specimen to the next, and what a rest changes of it. */
#include "checks.h"
#include "edcore.h"

#include <math.h>

enum { N = 300, TESTS = 3 };
static const double MGMM[] = {0.515e6, 15.1e3, 0.107e6, 21e3, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
static double t[TESTS][N], u[TESTS][N], v[TESTS][N], expected[N];

/* Sines that grow and fall, from rest to rest at zero. */
static void tests(ed_test test[TESTS], double rest)
{
  for (int k = 0; k < TESTS; k++) {
    const double h = 0.01, T = (N - 1) * h, w = 5.0 + k, a = (3.0 + k) * 1e-3;
    for (int i = 0; i < N; i++) {
      const double s = t[k][i] = i * h, window = pow(sin(M_PI * s / T), 2.0), slope = M_PI / T * sin(2.0 * M_PI * s / T);
      u[k][i] = a * window * sin(w * s);
      v[k][i] = a * (window * w * cos(w * s) + slope * sin(w * s));
    }
    u[k][N - 1] = v[k][N - 1] = 0.0;
    test[k] = (ed_test){.n = N, .time = t[k], .u = u[k], .v = v[k], .rest = rest};
  }
}

/* The second of two tests by the formulas, from what the first has left and a rest has changed: of a spring alone, as factors and forces
 * depend on k u of a Kelvin damper. s, M, a, x, q: at the end of the first. */
static void check_rests(void)
{
  enum { PATH, ELASTIC, MAXIMUM, DAMAGE, ENVELOPE, NETWORK, HEAT, PRESLIDING, KINDS };
  const double k = 8e6, kelvin[] = {k, 0.0}, rest = 12.0, r = 0.35;
  static const struct {
    int form, n;
    double p[4];
  } one[KINDS] = {{ED_EFFECT_MULLINS_PATH, 4, {0.3, 0.05, 1.0, 0.35}}, {ED_EFFECT_MULLINS_ELASTIC, 4, {2e6, 0.05, 0.6, 0.35}},
                  {ED_EFFECT_MULLINS_MAXIMUM, 4, {0.3, 2e-3, 0.4, 0.35}},   {ED_EFFECT_MULLINS_DAMAGE, 4, {0.3, 4e-3, 1.3, 0.35}},
                  {ED_EFFECT_PAYNE_WHOLE, 4, {0.3, 2e-3, 1.0, 10.0}},  {ED_EFFECT_PAYNE_NETWORK, 3, {0.3, 5e-3, 20.0}},
                  {ED_EFFECT_SELF_HEATING_RATE, 2, {1e-3, 15.0}},      {ED_EFFECT_FRICTION_PRESLIDING, 3, {5e3, 1e-3, 1.0}}};
  static double found[2 * N];
  ed_test test[TESTS];
  ed_campaign_end end;
  tests(test, rest);
  for (int i = 0; i < KINDS; i++) {
    const double *p = one[i].p;
    int status;
    char message[256];
    ed_damper *damper = ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, kelvin, 0.0, 0.0, &status, message, sizeof message);
    CHECK_STATUS(ed_damper_add_effect(damper, one[i].form, ED_PLACE_WHOLE, one[i].n, p, message, sizeof message), ED_OK);
    const ed_damper *const given = damper;
    CHECK_STATUS(ed_damper_campaign(1, &given, 2, test, ED_DAMPER_BEST, 1e-6, 1, found, NULL, &end), ED_OK);
    double left = 1.0, far = 0.0, largest = 0.0, envelope = 0.0, network = 0.0, heat = 0.0, before = 0.0;
    for (int j = 0; j < 2; j++) {
      if (j == 1) {
        left += r * (1.0 - left);
        const double slow = exp(-pow(far / 0.05, 0.6));
        far = 0.05 * pow(-log(slow + r * (1.0 - slow)), 1.0 / 0.6);
        largest *= 1.0 - r;
        envelope *= exp(-rest / 10.0);
        network *= exp(-rest / 20.0);
        heat *= exp(-rest / 15.0);
        before = 0.0;
      }
      for (int m = 1; m < N; m++) {
        const double h = t[j][m] - t[j][m - 1], x = u[j][m], way = x - u[j][m - 1];
        left *= exp(-fabs(way) / 0.05);
        far += fabs(way);
        largest = fmax(largest, fabs(x));
        envelope = fmax(fabs(x), envelope * exp(-h / 10.0));
        const double breaks = fabs(way) / (h * 5e-3), steady = breaks / (breaks + 1.0 / 20.0);
        network = steady + (network - steady) * exp(-(breaks + 1.0 / 20.0) * h);
        const double power = envelope / 2e-3, factor[KINDS] = {
            [PATH] = 1.0 + 0.3 * left,
            [ELASTIC] = 1.0 + 2e6 / k * exp(-pow(far / 0.05, 0.6)),
            [MAXIMUM] = 1.0 - 0.3 * erf((largest * largest - x * x) / (4e-6 + 0.4 * largest * largest)),
            [DAMAGE] = 1.0 - 0.3 * (1.0 - exp(-pow(largest / 4e-3, 1.3))),
            [ENVELOPE] = 1.0 - 0.3 * power / (1.0 + power),
            [NETWORK] = 1.0 - 0.3 * network,
            [HEAT] = exp(-heat),
        };
        const double expected_force = factor[i] * k * x;
        heat = heat * exp(-h / 15.0) + 1e-3 * 0.5 * (before + expected_force) * way;
        before = expected_force;
        if (i != PRESLIDING)
          CHECK_NEAR(found[j * N + m], expected_force, 1e-11 * k * 4e-3); /* rounding over 600 steps */
      }
    }
    if (i == PRESLIDING) {
      int done;
      CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_BEST, 1e-6, N, t[1], u[1], v[1], expected, &done), ED_OK);
      CHECK_SAME(found + N, expected, N);
    }
    ed_damper_free(damper);
  }
}

/* What stands for the springs of an MGMM keeps its extremes too: a factor of both sides is one inside. */
static void check_sides_carried(void)
{
  static double sides[3 * N], inside[3 * N];
  const double p[] = {0.3, 0.1, 0.7, 0.4};
  ed_test test[TESTS];
  ed_campaign_end end;
  int status;
  char message[256];
  tests(test, 30.0);
  ed_damper *both = ed_damper_new(ED_LAW_MGMM, 12, MGMM, 0.0, 0.0, &status, message, sizeof message);
  ed_damper *all = ed_damper_new(ED_LAW_MGMM, 12, MGMM, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(ed_damper_add_effect(both, ED_EFFECT_MULLINS_PATH, ED_PLACE_SPRINGS, 4, p, message, sizeof message), ED_OK);
  CHECK_STATUS(ed_damper_add_effect(both, ED_EFFECT_MULLINS_PATH, ED_PLACE_DASHPOTS, 4, p, message, sizeof message), ED_OK);
  CHECK_STATUS(ed_damper_add_effect(all, ED_EFFECT_MULLINS_PATH, ED_PLACE_INSIDE, 4, p, message, sizeof message), ED_OK);
  const ed_damper *const one = both, *const other = all;
  for (int method = ED_DAMPER_BEST; method <= ED_DAMPER_ODE; method++) {
    CHECK_STATUS(ed_damper_campaign(1, &one, 3, test, method, 1e-8, 1, sides, NULL, &end), ED_OK);
    CHECK_STATUS(ed_damper_campaign(1, &other, 3, test, method, 1e-8, 1, inside, NULL, &end), ED_OK);
    const int n = test[0].n + test[1].n + test[2].n;
    for (int i = 0; i < n; i++)
      CHECK_NEAR(sides[i], inside[i], 1e-12 * 100e3);
  }
  ed_damper_free(both);
  ed_damper_free(all);
}

int main(void)
{
  check_rests();
  check_sides_carried();
  return checks_end("rests between tests");
}
