/* Dampers in fixed steps. References: SUNDIALS at 1e-11 (another method, ARKODE's of order 3), central differences, the exact steps
 * where a law has one, and a rig whose stiffness joins that of the brace. */
#include "checks.h"
#include "edcore.h"
#include "in_series.h"

#include <math.h>
#include <string.h>

enum { PARAMETERS = 11, C = 9, ALPHA_D = 10, MOST = 2001 };
static const double P[PARAMETERS] = {30e6, 20e6, 5e-3, 1e-3, 0.05, 1.0, 0.5, 0.5, 1.5, 50e3, 0.5};
static const double BRACE = 60e6, YIELD = 1e-3;
static double t[MOST], u[MOST], v[MOST], force[MOST], expected[MOST], own[MOST];

/* n samples of two sines that begin at rest. */
static void motion(int n, double h)
{
  for (int i = 0; i < n; i++) {
    t[i] = i * h;
    u[i] = 6e-3 * (1.0 - cos(5.0 * t[i])) + 2e-3 * (1.0 - cos(13.0 * t[i]));
    v[i] = 30e-3 * sin(5.0 * t[i]) + 26e-3 * sin(13.0 * t[i]);
  }
}

static ed_damper *make(double c, double alpha, double brace)
{
  double p[PARAMETERS];
  int status;
  char message[256];
  memcpy(p, P, sizeof p);
  p[C] = c;
  p[ALPHA_D] = alpha;
  ed_damper *made = ed_damper_new(ED_LAW_MODIFIED_BOUC_WEN, PARAMETERS, p, brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return made;
}

/* rms over the largest expected. */
static double apart(int n)
{
  double sum = 0.0, largest = 0.0;
  for (int i = 0; i < n; i++) {
    sum += (force[i] - expected[i]) * (force[i] - expected[i]);
    largest = fmax(largest, fabs(expected[i]));
  }
  return sqrt(sum / n) / largest;
}

static void run(const ed_damper *damper, double length, int n)
{
  int done;
  CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_FIXED, length, n, t, u, v, force, &done), ED_OK);
  CHECK_INT(done, n);
}

/* A length so large that the samples decide of the sub-steps. */
static void check_order(void)
{
  enum { STEPS = 4, N = 200 };
  static const double dashpot[][2] = {{50e3, 1.0}, {20e3, 0.7}, {50e3, 0.5}, {50e3, 1.6}, {500e3, 0.5}, {5e3, 0.3}};
  for (int i = 0; i < 6; i++) {
    ed_damper *damper = make(dashpot[i][0], dashpot[i][1], BRACE);
    double error[STEPS];
    for (int k = 0; k < STEPS; k++) {
      int done;
      const int n = (N << k) + 1;
      motion(n, 0.02 / (1 << k));
      CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_ODE, 1e-11, n, t, u, v, expected, &done), ED_OK);
      run(damper, 1.0, n);
      error[k] = apart(n);
    }
    CHECK(error[0] < 3e-3);
    CHECK_NEAR(log2(error[0] / error[STEPS - 1]) / (STEPS - 1), 2.0, 0.2);
    ed_damper_free(damper);
  }
}

/* The power-law dashpot with spring against its step in parts (1e-8): order, stiff springs, slopes by differences. */
static void check_maxwell_power(void)
{
  enum { STEPS = 4, N = 200 };
  static const double law[][3] = {{300e3, 0.35, 40e6}, {1e6, 1.0, 40e6}, {3e6, 1.7, 40e6}, {300e3, 0.35, 1e12}, {3e6, 1.7, 1e12}, {300e3, 0.15, 1e9}};
  for (int i = 0; i < 6; i++) {
    int done, status;
    char message[256];
    ed_damper *damper = ed_damper_new(ED_LAW_MAXWELL_POWER, 3, law[i], i % 2 ? 1e13 : 0.0, 0.0, &status, message, sizeof message);
    double error[STEPS];
    for (int k = 0; k < STEPS; k++) {
      const int n = (N << k) + 1;
      motion(n, 0.02 / (1 << k));
      CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_BEST, 1e-6, n, t, u, v, expected, &done), ED_OK);
      run(damper, 1.0, n);
      error[k] = apart(n);
    }
    CHECK(error[0] < 1e-2); /* the stiff ones: forces change in a fraction of a step about turns */
    if (i < 3)
      CHECK_NEAR(log2(error[0] / error[STEPS - 1]) / (STEPS - 1), 2.0, 0.2);
    double from = 0.0, speed = 0.0, state = 0.0, trial, one, slope[2], side[2], other, unused[2];
    for (int k = 0; i < 3 && k < 30; k++) {
      const double h = 0.02, to = 8e-3 * sin(0.9 * (k + 1)), last = 0.1 * cos(1.7 * k);
      CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_FIXED, 1.0, &state, h, from, speed, to, last, &trial, &one, slope), ED_OK);
      for (int j = 0; j < 2; j++) {
        const double d = j ? 1e-7 : 1e-9;
        for (int m = 0; m < 2; m++)
          ed_damper_step(damper, ED_DAMPER_FIXED, 1.0, &state, h, from, speed, to + (j ? 0.0 : m ? -d : d), last + (j ? (m ? -d : d) : 0.0),
                         &other, &side[m], unused);
        /* the turns, where pieces end, move with the path: that counts as error of the method alone */
        CHECK_NEAR(slope[j], (side[0] - side[1]) / (2.0 * d), 5e-3 * (j ? h : 1.0) * 40e6);
      }
      state = trial;
      from = to;
      speed = last;
    }
    ed_damper_free(damper);
  }
}

/* Samples far apart: the length makes up for it. */
static void check_length(void)
{
  enum { N = 200 };
  int done;
  motion(N, 0.04);
  ed_damper *damper = make(50e3, 0.5, BRACE);
  CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_ODE, 1e-11, N, t, u, v, expected, &done), ED_OK);
  run(damper, 8.0 * YIELD, N);
  CHECK(apart(N) > 2e-3);
  run(damper, YIELD, N);
  CHECK(apart(N) < 5e-4);
  ed_damper_free(damper);
}

/* A stiff brace leaves the dashpot alone, whose force follows a power of the velocity that is flat or steep at rest: nothing overshoots,
 * and what comes is as without brace. */
static void check_stiff(void)
{
  enum { N = 1000 };
  motion(N, 0.01);
  for (int i = 0; i < 4; i++) {
    int done;
    const double alpha = i % 2 ? 0.4 : 1.5;
    ed_damper *braced = make(200e3, alpha, i < 2 ? 1e9 : 1e12), *rigid = make(200e3, alpha, 0.0);
    double largest = 0.0;
    CHECK_STATUS(ed_damper_history(rigid, ED_DAMPER_BEST, 1e-6, N, t, u, v, expected, &done), ED_OK);
    for (int k = 0; k < N; k++)
      largest = fmax(largest, fabs(expected[k]));
    if (i < 2) /* the brace takes a little of the motion */
      CHECK_STATUS(ed_damper_history(braced, ED_DAMPER_ODE, 1e-9, N, t, u, v, expected, &done), ED_OK);
    run(braced, YIELD, N);
    for (int k = 0; k < N; k++)
      CHECK(fabs(force[k]) < 1.001 * largest);
    CHECK(apart(N) < 1e-3);
    ed_damper_free(braced);
    ed_damper_free(rigid);
  }
}

/* The same input gives the same, whatever went before; the slopes are those of the step, where no extreme was left behind in it. */
static void check_step(void)
{
  ed_damper *damper = make(50e3, 0.7, BRACE);
  double state[4], trial[2][4], one[2], slope[2][2];
  CHECK_INT(ed_damper_state_size(damper), 4);
  ed_damper_start(damper, state);
  double from = 0.0, speed = 0.05;
  for (int i = 0; i < 30; i++) {
    const double h = 0.02, to = 8e-3 * sin(0.9 * (i + 1)), last = 0.1 * cos(1.7 * i);
    for (int k = 0; k < 2; k++)
      CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_FIXED, YIELD, state, h, from, speed, to, last, trial[k], &one[k], slope[k]), ED_OK);
    CHECK_SAME(trial[1], trial[0], 4);
    CHECK_SAME(&one[1], &one[0], 1);
    CHECK_SAME(slope[1], slope[0], 2);
    for (int j = 0; j < 2; j++) {
      const double d = j ? 1e-6 : 1e-8;
      double side[2], other[4], unused[2];
      for (int k = 0; k < 2; k++)
        ed_damper_step(damper, ED_DAMPER_FIXED, YIELD, state, h, from, speed, to + (j ? 0.0 : k ? -d : d),
                       last + (j ? (k ? -d : d) : 0.0), other, &side[k], unused);
      /* differences meet other numbers of sub-steps now and then */
      CHECK_NEAR(slope[0][j], (side[0] - side[1]) / (2.0 * d), 0.15 * (j ? h : 1.0) * BRACE);
    }
    memcpy(state, trial[0], sizeof state);
    from = to;
    speed = last;
  }
  ed_damper_free(damper);
}

/* In series with a rig of stiffness K the brace is one of 1/(1/K + 1/BRACE). */
static void check_rig(void)
{
  enum { N = 2000 };
  const double K = 80e6;
  motion(N, 0.004);
  for (int i = 0; i < 3; i++) {
    int done;
    const double alpha = 0.5 + 0.5 * i;
    ed_damper *damper = make(50e3, alpha, BRACE), *joined = make(50e3, alpha, 1.0 / (1.0 / K + 1.0 / BRACE));
    CHECK_STATUS(ed_damper_history(joined, ED_DAMPER_ODE, 1e-10, N, t, u, v, expected, &done), ED_OK);
    ed_rig rig = {K, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0};
    CHECK_STATUS(history_in_series(damper, ED_DAMPER_FIXED, 0.25 * YIELD, N, t, u, v, NULL, NULL, NULL, &rig, force, own, &done), ED_OK);
    CHECK(apart(N) < 5e-4); /* 3e-4 of them of the rig, whose stretch is a parabola over a sample */
    for (int k = 0; k < N; k++)
      CHECK_NEAR(own[k], u[k] - force[k] / K, 1e-9);
    static const ed_rig others[] = {{80e6, 1.0, 0.0, 1.0, 0.0, 1e-3, 0.0}, {80e6, 0.6, 1e5, 1.0, 1e5, 1e-3, 1e4}, {80e6, 1.0, 1e4, 1.5, 0.0, 0.0, 0.0}};
    for (int k = 0; k < 3; k++) { /* against SUNDIALS inside the same rig */
      CHECK_STATUS(history_in_series(damper, ED_DAMPER_ODE, 1e-6, 200, t, u, v, NULL, NULL, NULL, &others[k], expected, own, &done), ED_OK);
      CHECK_STATUS(history_in_series(damper, ED_DAMPER_FIXED, 0.25 * YIELD, 200, t, u, v, NULL, NULL, NULL, &others[k], force, own, &done), ED_OK);
      CHECK(apart(200) < 2e-3);
    }
    ed_damper_free(damper);
    ed_damper_free(joined);
  }
}

/* Over closed loops work is lost, as much as by SUNDIALS to a thousandth. */
static void check_energy(void)
{
  enum { N = 2001 };
  for (int i = 0; i < N; i++) {
    t[i] = 2e-3 * i;
    u[i] = 6e-3 * sin(M_PI * t[i]);
    v[i] = 6e-3 * M_PI * cos(M_PI * t[i]);
  }
  int done;
  double work[2] = {0.0};
  ed_damper *damper = make(50e3, 0.5, BRACE);
  CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_ODE, 1e-9, N, t, u, v, expected, &done), ED_OK);
  run(damper, YIELD, N);
  for (int i = N / 2; i < N - 1; i++) {
    work[0] += 0.5 * (force[i] + force[i + 1]) * (u[i + 1] - u[i]);
    work[1] += 0.5 * (expected[i] + expected[i + 1]) * (u[i + 1] - u[i]);
  }
  CHECK(work[0] > 0.0);
  CHECK_NEAR(work[0], work[1], 1e-3 * work[1]);
  ed_damper_free(damper);
}

/* Laws with exact steps take those, to the last bit. */
static void check_exact(void)
{
  enum { N = 300 };
  int done, status;
  char message[256];
  static const double bouc_wen[] = {100e3, 2e-3, 0.05, 1.0, 0.5, 0.5, 1.5};
  motion(N, 0.02);
  for (int i = 0; i < 2; i++) {
    ed_damper *damper = ed_damper_new(ED_LAW_BOUC_WEN, 7, bouc_wen, i ? BRACE : 0.0, 0.0, &status, message, sizeof message);
    CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_BEST, 1e-6, N, t, u, v, expected, &done), ED_OK);
    run(damper, YIELD, N);
    CHECK_SAME(force, expected, N);
    ed_damper_free(damper);
  }
}

static void check_refusals(void)
{
  static const double wrong[] = {0.0, -1e-3, NAN, INFINITY};
  int done;
  ed_damper *damper = make(50e3, 0.5, BRACE);
  for (int i = 0; i < 4; i++)
    CHECK_STATUS(ed_damper_history(damper, ED_DAMPER_FIXED, wrong[i], 10, t, u, v, force, &done), ED_E_ARGUMENT);
  ed_damper_free(damper);
}

int main(void)
{
  check_order();
  check_maxwell_power();
  check_length();
  check_stiff();
  check_step();
  check_rig();
  check_energy();
  check_exact();
  check_refusals();
  return checks_end("dampers in fixed steps");
}
