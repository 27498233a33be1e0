/* Dampers in series with a rig that has stiffness and play: closed forms, braces, an explicit integration, energy, refusals. */
#include "checks.h"
#include "edcore.h"
#include "in_series.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 40001 };
static const double MGMM[] = {0.515e6, 15.1e3, 0.107e6, 21e3, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
static double t[MOST], u[MOST], v[MOST], force[MOST], own[MOST];

/* amplitude sin(omega t + phase) in n steps of h. */
static void sine(int n, double h, double amplitude, double omega, double phase)
{
  for (int i = 0; i <= n; i++) {
    t[i] = i * h;
    u[i] = amplitude * sin(omega * t[i] + phase);
    v[i] = amplitude * omega * cos(omega * t[i] + phase);
  }
}

static ed_damper *make(int law, int n, const double *parameters, double brace)
{
  int status;
  char message[256];
  ed_damper *made = ed_damper_new(law, n, parameters, brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return made;
}

static void run(int law, int n_parameters, const double *parameters, int n, const double *factor, const double *added,
                double stiffness, double within, double play)
{
  int done;
  ed_damper *damper = make(law, n_parameters, parameters, 0.0);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, n + 1, t, u, v, factor, added, NULL, &(ed_rig){stiffness, 1.0, 0.0, 1.0, within, play, 0.0}, force, own, &done), ED_OK);
  CHECK_INT(done, n + 1);
  ed_damper_free(damper);
}

static double beyond(double e, double gap)
{
  return fabs(e) > gap ? copysign(fabs(e) - gap, e) : 0.0;
}

/* Steady vibration: the complex stiffness k* K / (k* + K). Error over the amplitude of the force with n steps a period. */
static double steady_error(int law, int n_parameters, const double *p, double complex own_stiffness, int n)
{
  const double omega = 6.0, K = 40.0, amplitude = 0.3;
  const double complex together = own_stiffness * K / (own_stiffness + K);
  double worst = 0.0;
  sine(12 * n, 2.0 * M_PI / omega / n, amplitude, omega, 0.0);
  run(law, n_parameters, p, 12 * n, NULL, NULL, K, 0.0, 0.0);
  for (int i = 11 * n; i <= 12 * n; i++) {
    const double complex turned = amplitude * cexp(I * omega * t[i]);
    worst = fmax(worst, fabs(force[i] - cimag(together * turned)));
    CHECK_NEAR(own[i], u[i] - force[i] / K, 1e-12);
  }
  return worst / (amplitude * cabs(together));
}

static void check_complex_stiffness(void)
{
  const double kelvin[] = {5.0, 0.7}, zener[] = {2.0, 8.0, 0.6};
  const double complex of_kelvin = 5.0 + 6.0 * 0.7 * I, of_zener = 2.0 + 1.0 / (1.0 / 8.0 + 1.0 / (6.0 * 0.6 * I));
  double coarse = steady_error(ED_LAW_KELVIN_VOIGT, 2, kelvin, of_kelvin, 100);
  double fine = steady_error(ED_LAW_KELVIN_VOIGT, 2, kelvin, of_kelvin, 200);
  CHECK(fine < 5e-5);
  CHECK_NEAR(log2(coarse / fine), 2.0, 0.1); /* a bare dashpot sees the rate of the rig at the end of a step */
  coarse = steady_error(ED_LAW_ZENER, 3, zener, of_zener, 100);
  fine = steady_error(ED_LAW_ZENER, 3, zener, of_zener, 200);
  CHECK(fine < 4e-7);
  CHECK_NEAR(log2(coarse / fine), 3.0, 0.1);
}

/* Without play it is a brace, of another method (collocation of order 3, or the spring of the law): largest difference over largest force. */
static double brace_difference(int law, int n_parameters, const double *p, double phase, int n)
{
  const double K = 60e6;
  static double braced[MOST];
  double worst = 0.0, largest = 0.0;
  int done;
  sine(n, 1.5 / n, 8e-3, 7.0, phase); /* 1.5 s */
  ed_damper *with_brace = make(law, n_parameters, p, K);
  CHECK_STATUS(ed_damper_history(with_brace, ED_DAMPER_BEST, 1e-8, n + 1, t, u, v, braced, &done), ED_OK);
  ed_damper_free(with_brace);
  run(law, n_parameters, p, n, NULL, NULL, K, 0.0, 0.0);
  for (int i = 1; i <= n; i++) { /* the first force with a brace is that after a jump of the velocity within 1e-9 of a step */
    worst = fmax(worst, fabs(force[i] - braced[i]));
    largest = fmax(largest, fabs(braced[i]));
  }
  return worst / largest;
}

static void check_braces(void)
{
  static const double zener[] = {5e6, 8e6, 0.8e6}, plastic[] = {50e6, 100e3, 0.03};
  static const double power[] = {300e3, 0.35, 40e6};
  static const struct {
    int law, n;
    const double *p;
    double phase, order, fine; /* order at least; difference with 1600 steps at most */
  } each[] = {{ED_LAW_ZENER, 3, zener, 0.4, 2.2, 5e-8},
              {ED_LAW_MGMM, 12, MGMM, 0.4, 0.8, 2e-4}, /* the power of the velocity is steep where the damper turns */
              {ED_LAW_ELASTIC_PLASTIC, 3, plastic, 0.4, 1.5, 1e-5}, /* a turn inside a step is met only nearly */
              {ED_LAW_MAXWELL_POWER, 3, power, 0.0, 2.2, 2e-7}}; /* the brace joins its spring; it hardly comes to rest, so from zero */
  for (int i = 0; i < 4; i++) {
    const double coarse = brace_difference(each[i].law, each[i].n, each[i].p, each[i].phase, 200);
    const double fine = brace_difference(each[i].law, each[i].n, each[i].p, each[i].phase, 1600);
    CHECK(fine < each[i].fine);
    CHECK(log2(coarse / fine) / 3.0 > each[i].order);
  }
}

/* A spring k: factor k u_d + added and the rig make F = deadzone(u + added / (factor k), play/2) / (1/(factor k) + 1/K). */
static void check_elastic(void)
{
  enum { N = 500 };
  const double k = 8e6, K = 30e6, play = 2e-3, spring[] = {k, 0.0};
  static double factor[N + 1], added[N + 1];
  for (int with_effect = 0; with_effect < 2; with_effect++) {
    int free_samples = 0;
    sine(N, 0.01, 6e-3, 5.0, 1.0);
    for (int i = 0; i <= N; i++) {
      factor[i] = 1.0 - 0.3 * sin(0.5 * t[i]);
      added[i] = 2e3 * cos(3.0 * t[i]);
    }
    run(ED_LAW_KELVIN_VOIGT, 2, spring, N, with_effect ? factor : NULL, with_effect ? added : NULL, K, 0.0, play);
    for (int i = 0; i <= N; i++) {
      const double f = with_effect ? factor[i] : 1.0, a = with_effect ? added[i] : 0.0;
      const double expected = beyond(u[i] + a / (f * k), 0.5 * play) / (1.0 / (f * k) + 1.0 / K);
      CHECK_NEAR(force[i], expected, 1e-7 * 6e-3 * k); /* the balance is kept to 1e-8 */
      CHECK_NEAR(own[i], (force[i] - a) / (f * k), 1e-7 * 6e-3);
      free_samples += expected == 0.0 && force[i] == 0.0;
    }
    CHECK(free_samples > 30);
  }
}

/* A spring k and a joint, soft up to a force and stiffer beyond: one straight line after the other, the same force in both. */
static void check_closing_joint(void)
{
  enum { N = 400 };
  const double k = 8e6, soft = 20e6, stiff = 60e6, half = 0.4e-3, spring[] = {k, 0.0};
  int closed = 0, open = 0;
  sine(N, 0.01, 6e-3, 5.0, 0.3);
  run(ED_LAW_KELVIN_VOIGT, 2, spring, N, NULL, NULL, stiff, soft, 2.0 * half);
  for (int i = 0; i <= N; i++) {
    const double before = u[i] / (1.0 / k + 1.0 / soft), closing = soft * half;
    const double over = fabs(u[i]) - closing / k - half; /* way left to spring and closed joint */
    const double expected = over > 0.0 ? copysign(closing + over / (1.0 / k + 1.0 / stiff), u[i]) : before;
    CHECK_NEAR(force[i], expected, 1e-7 * 6e-3 * k);
    over > 0.0 ? closed++ : open++;
  }
  CHECK(closed > 100 && open > 20);
}

/* MGMM with play in steady cycles: the rig gives back what it takes, and carries what its stretch says. */
static void check_energy(void)
{
  enum { N = 2000, CYCLES = 8 };
  const double K = 40e6, play = 1.5e-3;
  double rig = 0.0, damper = 0.0;
  sine(CYCLES * N, 1.0 / N, 8e-3, 2.0 * M_PI, 0.0);
  run(ED_LAW_MGMM, 12, MGMM, CYCLES * N, NULL, NULL, K, 0.0, play);
  for (int i = 0; i <= CYCLES * N; i++)
    CHECK_NEAR(force[i], K * beyond(u[i] - own[i], 0.5 * play), 1e-15 * K);
  for (int i = (CYCLES - 1) * N; i < CYCLES * N; i++) {
    const double mean = 0.5 * (force[i] + force[i + 1]);
    damper += mean * (own[i + 1] - own[i]);
    rig += mean * (u[i + 1] - own[i + 1] - u[i] + own[i]);
  }
  CHECK(damper > 200.0);                 /* J; about 40 kN by 8 mm */
  CHECK_NEAR(rig, 0.0, 1e-4 * damper);   /* trapezoidal rule where the pins meet or part inside a step */
}

/* Maxwell: within the play u_d rests, so e' = v; beyond, K e' = k (v - e') - F / lambda. Heun's method in steps of 2.5 us. */
static double maxwell_error(int n)
{
  const double c0 = 1.5e6, lambda = 0.05, k = c0 / lambda, K = 50e6, gap = 1e-3, p[] = {c0, lambda};
  const double omega = 9.0, amplitude = 7e-3, duration = 1.6, h = 2.5e-6;
  const int parts = (int)(duration / n / h + 0.5);
  double e = 0.0, worst = 0.0, largest = 0.0;
  int idle = 0;
  sine(n, duration / n, amplitude, omega, 0.0);
  run(ED_LAW_MAXWELL, 2, p, n, NULL, NULL, K, 0.0, 2.0 * gap);
  for (int i = 0; i < n; i++) {
    for (int j = 0; j < parts; j++) {
      double rate[2], at = e;
      for (int stage = 0; stage < 2; stage++) {
        const double now = amplitude * omega * cos(omega * (t[i] + (j + stage) * h));
        rate[stage] = fabs(at) < gap ? now : (k * now - K * beyond(at, gap) / lambda) / (k + K);
        at = e + h * rate[0];
      }
      e += 0.5 * h * (rate[0] + rate[1]);
    }
    if (fabs(e) < 0.95 * gap) { /* a first-order step where the pins meet may be off by a little */
      CHECK(force[i + 1] == 0.0);
      idle++;
    }
    worst = fmax(worst, fabs(force[i + 1] - K * beyond(e, gap)));
    largest = fmax(largest, fabs(force[i + 1]));
  }
  CHECK(idle > n / 50 && largest > 50e3);
  return worst / largest;
}

static void check_play(void)
{
  /* with steps in parts where pins meet or part 5.9e-4 and 3.5e-5, without 8.1e-4 and 4.1e-5 */
  CHECK(maxwell_error(200) < 7e-4);
  CHECK(maxwell_error(1600) < 3.8e-5);
}

/* At rest where the pins just meet, moved by about the last digit of the stretch: no force, and no search for one. */
static void check_rest(void)
{
  enum { N = 200 };
  for (int k = 0; k < 50; k++) {
    const double gap = 4e-5 * (1.0 + 0.017 * k);
    for (int i = 0; i <= N; i++) {
      t[i] = 0.0075 * i;
      u[i] = -gap;
      v[i] = 1e-12 * sin(1.7 * i * i);
    }
    run(ED_LAW_MGMM, 12, MGMM, N, NULL, NULL, 119e6, 0.0, 2.0 * gap);
    for (int i = 0; i <= N; i++)
      CHECK_NEAR(force[i], 0.0, 1e-6);
  }
}

/* A spring beside a Zener model is a stiffer k0, whatever the rig: the same to the tolerance of the balance. */
static void check_spring_beside(void)
{
  enum { N = 400 };
  static const double zener[] = {2e6, 3e6, 2e5}, stiffer[] = {3.5e6, 3e6, 2e5};
  static double spring[N + 1], expected[N + 1], expected_own[N + 1];
  int done;
  for (int i = 0; i <= N; i++)
    spring[i] = 1.5e6;
  sine(N, 0.01, 5e-3, 6.0, 0.2);
  ed_damper *damper = make(ED_LAW_ZENER, 3, zener, 0.0), *other = make(ED_LAW_ZENER, 3, stiffer, 0.0);
  for (int i = 0; i < 3; i++) {
    const double play = i == 1 ? 1e-3 : 0.0, within = i == 2 ? 1e6 : 0.0, bend = i == 2 ? 1e6 : 0.0;
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, spring, &(ed_rig){2e7, 1.0, bend, 1.0, within, play, 0.0}, force, own, &done), ED_OK);
    CHECK_STATUS(history_in_series(other, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){2e7, 1.0, bend, 1.0, within, play, 0.0}, expected, expected_own, &done),
                 ED_OK);
    for (int j = 0; j <= N; j++) {
      CHECK_NEAR(force[j], expected[j], 1e-7 * 3e4);
      CHECK_NEAR(own[j], expected_own[j], 1e-7 * 5e-3);
    }
  }
  ed_damper_free(damper);
  ed_damper_free(other);
}

/* A damper whose relaxation ends at once, at the slow beginning too: as one a thousand times slower, of which a step sees nothing either. */
static void check_no_relaxation(void)
{
  enum { N = 400 };
  static double expected[N + 1];
  double p[12];
  memcpy(p, MGMM, sizeof p);
  sine(N, 0.01, 8e-3, 5.0, 0.3);
  for (int i = 0; i < 2; i++) {
    p[0] = p[1] / (i ? 1e-12 : 1e-9);
    run(ED_LAW_MGMM, 12, p, N, NULL, NULL, 390e6, 108e6, 4.7e-4);
    if (i == 0)
      memcpy(expected, force, sizeof expected);
  }
  for (int i = 0; i <= N; i++)
    CHECK_NEAR(force[i], expected[i], 1e-6 * 6e4);
}

/* What is refused leaves the results as they were, and the damper too. */
static void check_refusals(void)
{
  enum { N = 50 };
  double factor[N + 1], added[N + 1], spring[N + 1], before[N + 1], before_own[N + 1];
  int done;
  sine(N, 0.01, 5e-3, 6.0, 0.2);
  for (int i = 0; i <= N; i++) {
    factor[i] = 1.0;
    added[i] = spring[i] = 0.0;
  }
  ed_damper *damper = make(ED_LAW_MGMM, 12, MGMM, 0.0);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, factor, added, NULL, &(ed_rig){4e7, 1.0, 0.0, 1.0, 0.0, 1e-3, 0.0}, before, before_own, &done), ED_OK);
  static const double wrong[][3] = {{0.0, 0.0, 0.0},   {-1.0, 0.0, 0.0}, {NAN, 0.0, 0.0},      {INFINITY, 0.0, 0.0}, {1e7, -1e-9, 0.0},
                                    {1e7, NAN, 0.0},   {1e7, INFINITY, 0.0}, {1e7, 0.0, -1.0}, {1e7, 0.0, NAN}};
  force[0] = own[0] = 77.0;
  for (int i = 0; i < 9; i++)
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){wrong[i][0], 1.0, 0.0, 1.0, wrong[i][2], wrong[i][1], 0.0}, force, own, &done),
                 ED_E_ARGUMENT);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, 0, t, u, v, NULL, NULL, NULL, &(ed_rig){1e7, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0}, force, own, &done), ED_E_ARGUMENT);
  double *const place[] = {&t[7], &u[8], &v[9], &factor[10], &added[11], &spring[12], &factor[13], &t[14], &spring[15]};
  const double bad[] = {NAN, INFINITY, NAN, NAN, NAN, NAN, -0.1, t[13], -1.0};
  for (int i = 0; i < 9; i++) {
    const double good = *place[i];
    *place[i] = bad[i];
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, factor, added, spring, &(ed_rig){1e7, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0}, force, own, &done),
                 i < 6 ? ED_E_NOT_FINITE : ED_E_ARGUMENT);
    CHECK_INT(done, 7 + i);
    *place[i] = good;
  }
  CHECK(force[0] == 77.0 && own[0] == 77.0);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){4e7, 1.0, 0.0, 1.0, 0.0, 1e-3, 0.0}, force, own, &done), ED_OK);
  CHECK_SAME(force, before, N + 1);
  CHECK_SAME(own, before_own, N + 1);
  u[20] = 1e308; /* overflows on the way */
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){4e7, 1.0, 0.0, 1.0, 0.0, 1e-3, 0.0}, force, own, &done), ED_E_NOT_FINITE);
  CHECK_INT(done, 20);
  ed_damper_free(damper);
}

/* A spring k behind a contact of Hertz: k (u - e) = K e |sqrt(b) e|^(1/2), that force, at every sample. */
static void check_contact(void)
{
  enum { N = 500 };
  const double k = 8e6, K = 30e6, bend = 1e8, spring[] = {k, 0.0};
  int done, both = 0;
  sine(N, 0.01, 6e-3, 5.0, 1.0);
  ed_damper *damper = make(ED_LAW_KELVIN_VOIGT, 2, spring, 0.0);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){K, 1.0, bend, 1.5, 0.0, 0.0, 0.0}, force, own, &done), ED_OK);
  for (int i = 0; i <= N; i++) {
    const double e = u[i] - own[i];
    CHECK_NEAR(force[i], K * e * sqrt(sqrt(bend) * fabs(e)), 1e-9 * 6e-3 * k);
    CHECK_NEAR(force[i], k * own[i], 1e-7 * 6e-3 * k); /* the balance is kept to 1e-8 */
    both |= force[i] > 1e4 ? 1 : force[i] < -1e4 ? 2 : 0;
  }
  CHECK_INT(both, 3);
  static const double wrong[][3] = {{0.9, 1e8, 0.0}, {NAN, 1e8, 0.0}, {1.5, 0.0, 0.0}, {1.5, 1e8, 1e-3}}; /* power, bend, play */
  for (int i = 0; i < 4; i++)
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){K, 1.0, wrong[i][1], wrong[i][0], 0.0, wrong[i][2], 0.0}, force,
                                             own, &done),
                 ED_E_ARGUMENT);
  ed_damper_free(damper);
}

/* A spring k behind a rig of K that is `back` times as stiff where it is pushed together: two springs in series to each side. */
static void check_sides(void)
{
  enum { N = 500 };
  const double k = 8e6, K = 30e6, back = 0.4, spring[] = {k, 0.0};
  int done, both = 0;
  sine(N, 0.01, 6e-3, 5.0, 1.0);
  ed_damper *damper = make(ED_LAW_KELVIN_VOIGT, 2, spring, 0.0);
  ed_rig rig = {K, back, 0.0, 1.0, 0.0, 0.0, 0.0};
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &rig, force, own, &done), ED_OK);
  for (int i = 0; i <= N; i++) {
    const double side = u[i] < 0.0 ? back * K : K;
    CHECK_NEAR(force[i], k * side / (k + side) * u[i], 1e-7 * 6e-3 * k); /* the balance is kept to 1e-8 */
    both |= force[i] > 1e4 ? 1 : force[i] < -1e4 ? 2 : 0;
  }
  CHECK_INT(both, 3);
  static const double wrong[] = {0.0, -1.0, NAN, INFINITY};
  for (int i = 0; i < 4; i++) {
    rig.back = wrong[i];
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &rig, force, own, &done), ED_E_ARGUMENT);
  }
  ed_damper_free(damper);
}

/* A Zener model behind a spring K and a dashpot C side by side: the complex stiffness of the rig is K + i omega C. */
static double damped_error(int n)
{
  enum { PERIODS = 12 };
  static const double zener[] = {20.0, 30.0, 2.0};
  const double omega = 6.0, K = 40.0, C = 1.5, amplitude = 0.3, tau = zener[2] / zener[1];
  const double complex rig = K + I * omega * C, law = zener[0] + zener[1] * I * omega * tau / (1.0 + I * omega * tau);
  const double complex together = law * rig / (law + rig);
  double worst = 0.0;
  int done;
  sine(PERIODS * n, 2.0 * M_PI / omega / n, amplitude, omega, 0.0);
  ed_damper *damper = make(ED_LAW_ZENER, 3, zener, 0.0);
  CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, PERIODS * n + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){K, 1.0, 0.0, 1.0, 0.0, 0.0, C}, force, own, &done), ED_OK);
  for (int i = (PERIODS - 1) * n; i <= PERIODS * n; i++) { /* the rate of the rig is off by (omega h)^2/3 = 1.3e-3 at 100 steps a period */
    const double complex turned = amplitude * cexp(I * omega * t[i]);
    worst = fmax(worst, fabs(force[i] - cimag(together * turned)));
    CHECK_NEAR(own[i], cimag(rig / (law + rig) * turned), 2e-4 * amplitude * (100.0 / n) * (100.0 / n));
  }
  ed_damper_free(damper);
  return worst / (amplitude * cabs(together));
}

static void check_damped(void)
{
  const double coarse = damped_error(100), fine = damped_error(200);
  CHECK(fine < 5e-5);
  CHECK_NEAR(log2(coarse / fine), 2.0, 0.1); /* the rate of the rig at the end of a step */
  int done;
  ed_damper *damper = make(ED_LAW_MGMM, 12, MGMM, 0.0);
  static const double wrong[] = {-1.0, NAN, INFINITY};
  for (int i = 0; i < 3; i++)
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, 101, t, u, v, NULL, NULL, NULL, &(ed_rig){4e7, 1.0, 0.0, 1.0, 0.0, 0.0, wrong[i]}, force, own, &done),
                 ED_E_ARGUMENT);
  ed_damper_free(damper);
}

/* The work done on damper and rig over a closed loop of the MGMM is that in the damper and C e'^2 of the rig's dashpot, behind play too. */
static void check_damped_energy(void)
{
  enum { N = 20000 };
  const double C = 2e5, h = 1e-4;
  int done;
  sine(N, h, 8e-3, 2.0 * M_PI, 0.0); /* two periods of 1 s */
  ed_damper *damper = make(ED_LAW_MGMM, 12, MGMM, 0.0);
  for (int i = 0; i < 2; i++) {
    const double play = i ? 1e-3 : 0.0;
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_BEST, 1e-6, N + 1, t, u, v, NULL, NULL, NULL, &(ed_rig){4e7, 1.0, 0.0, 1.0, 0.0, play, C}, force, own, &done), ED_OK);
    double all = 0.0, damped = 0.0, inside = 0.0;
    for (int j = N / 2; j < N; j++) {
      const double mean = 0.5 * (force[j] + force[j + 1]), e = u[j + 1] - own[j + 1] - u[j] + own[j];
      all += mean * (u[j + 1] - u[j]);
      inside += mean * (own[j + 1] - own[j]);
      damped += C * e * e / h;
    }
    CHECK(damped > 1e-2 * all);
    CHECK_NEAR(all - inside, damped, 2e-3 * damped); /* first order where the rig turns a corner */
  }
  ed_damper_free(damper);
}

int main(void)
{
  check_complex_stiffness();
  check_damped();
  check_damped_energy();
  check_braces();
  check_elastic();
  check_closing_joint();
  check_contact();
  check_sides();
  check_energy();
  check_play();
  check_rest();
  check_spring_beside();
  check_no_relaxation();
  check_refusals();
  return checks_end("dampers in series with a rig");
}
