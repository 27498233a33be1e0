/* Moments of the MGMM's terms: what they make of a relaxation time must be what the law itself does with it, by its exact steps and by
 * SUNDIALS, and closed forms where the terms are polynomials. Parameters: Table 4.2 in kN, mm, s. */
#include "checks.h"
#include "edcore.h"

#include <math.h>
#include <stddef.h>

enum { K1, C1, K0, C_NL, ALPHA, K_A, K_B, U_REF, C_A, C_B, V_REF, CONSISTENT, N_PARAMETERS };
static const double TABLE_4_2[N_PARAMETERS] = {0.515, 0.0151, 0.107, 1.585, 0.374, 3.741, 3.613, 7.966, 0.902, 0.190, 13.468, 0.0};
static const double PEAK = 40.0; /* force under 50 % strain, kN */
enum { N = 400, ROW = ED_MOMENTS };

typedef struct {
  double t[N], u[N], v[N];
} motion;

static ed_damper *new_damper(const double *p, double tau, double alpha)
{
  double own[N_PARAMETERS];
  char message[256];
  int status;
  for (int i = 0; i < N_PARAMETERS; i++)
    own[i] = p[i];
  own[K1] = own[C1] / tau;
  own[ALPHA] = alpha;
  ed_damper *damper = ed_damper_new(ED_LAW_MGMM, N_PARAMETERS, own, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return damper;
}

/* Two sines that grow, so that extremes do; begun away from zero and on the move. */
static void shake(motion *m, double step)
{
  for (int i = 0; i < N; i++) {
    const double t = step * i, w1 = 2.0 * M_PI * 1.3, w2 = 2.0 * M_PI * 4.1, a = 1.5 + 0.8 * t, b = 0.4;
    m->t[i] = t;
    m->u[i] = a * sin(w1 * t + 0.7) + b * sin(w2 * t);
    m->v[i] = a * w1 * cos(w1 * t + 0.7) + 0.8 * sin(w1 * t + 0.7) + b * w2 * cos(w2 * t);
  }
}

/* exp(-(1 - x) time) for x from 0 to 1 as a series of T_k(2 x - 1): exp(-time/2) times I_0(time/2), then 2 I_k(time/2) (Abramowitz &
 * Stegun 9.6.34); the Bessel functions by their series (9.6.10). */
static void fading_series(double time, double coefficient[ROW])
{
  for (int k = 0; k < ROW; k++) {
    const double half = 0.25 * time;
    double term = pow(half, k) / tgamma(k + 1.0), sum = 0.0;
    for (int j = 1; j < 40; j++) {
      sum += term;
      term *= half * half / (j * (k + (double)j));
    }
    coefficient[k] = exp(-0.5 * time) * (k ? 2.0 : 1.0) * sum;
  }
}

typedef struct {
  double spring[N * ROW], dashpot[N * ROW], power[N * ROW], held;
} moments;

static void moments_of(const ed_damper *damper, const motion *m, moments *of)
{
  int done;
  CHECK_STATUS(ed_mgmm_moments(damper, N, m->t, m->u, m->v, of->spring, of->dashpot, of->power, &of->held, &done), ED_OK);
  CHECK(done == N);
}

/* Force of the law with another tau, from the moments and the constant dashpot c1 v, as c1 times that of 1 in `plain`. */
static void force_by_moments(const moments *of, const moments *plain, const motion *m, double tau, double *force)
{
  const double k0 = TABLE_4_2[K0], c1 = TABLE_4_2[C1], c_nl = TABLE_4_2[C_NL];
  double coefficient[ROW], relaxing = of->held, dashpot = 0.0;
  force[0] = k0 * m->u[0] + relaxing;
  for (int i = 1; i < N; i++) {
    const double time = (m->t[i] - m->t[i - 1]) / tau;
    fading_series(time, coefficient);
    double made = 0.0, made_by_dashpot = 0.0;
    for (int k = 0; k < ROW; k++) {
      const int at = ROW * (i - 1) + k;
      made += coefficient[k] * (of->spring[at] + of->dashpot[at] + c_nl * of->power[at]);
      made_by_dashpot += coefficient[k] * plain->dashpot[at];
    }
    relaxing = exp(-time) * relaxing + time * made;
    dashpot = exp(-time) * dashpot + time * made_by_dashpot;
    force[i] = k0 * m->u[i] + relaxing + c1 * dashpot;
  }
}

static void check_against_the_law(double step, double alpha)
{
  static motion m;
  static moments of, plain;
  static double got[N], exact[N], stepped[N];
  shake(&m, step);
  double constant[N_PARAMETERS];
  for (int i = 0; i < N_PARAMETERS; i++)
    constant[i] = TABLE_4_2[i];
  constant[C_A] = 0.0;
  constant[C_B] = 1.0;
  const double shortest = 2.0 * step; /* h / tau = 1/2 */
  ed_damper *damper = new_damper(TABLE_4_2, shortest, alpha), *other = new_damper(constant, shortest, alpha);
  moments_of(damper, &m, &of);
  moments_of(other, &m, &plain);
  ed_damper_free(damper);
  ed_damper_free(other);
  for (double tau = shortest; tau < 20.0 * shortest; tau *= 2.3) {
    int done;
    ed_damper *law = new_damper(TABLE_4_2, tau, alpha);
    force_by_moments(&of, &plain, &m, tau, got);
    CHECK_STATUS(ed_damper_history(law, ED_DAMPER_BEST, 1e-9, N, m.t, m.u, m.v, exact, &done), ED_OK);
    CHECK_STATUS(ed_damper_history(law, ED_DAMPER_ODE, 1e-9, N, m.t, m.u, m.v, stepped, &done), ED_OK);
    for (int i = 0; i < N; i++) {
      CHECK_NEAR(got[i], exact[i], 3e-8 * PEAK);  /* both by rules of 1e-8 */
      CHECK_NEAR(got[i], stepped[i], 2e-6 * PEAK); /* steps of SUNDIALS near the steep power at rest */
    }
    ed_damper_free(law);
  }
}

/* Without softening and with alpha = 1 all terms are polynomials: Gauss' rule of five points over sixteenths of the step has them to
 * 1e-13. The law remembers more than what comes, so that it counts all of the step as one. */
static void check_polynomials(void)
{
  static const double point[5] = {0.0, 0.53846931010568309, -0.53846931010568309, 0.90617984593866399, -0.90617984593866399};
  static const double weight[5] = {0.28444444444444444, 0.23931433524968324, 0.23931433524968324, 0.11846344252809454, 0.11846344252809454};
  const double p[N_PARAMETERS] = {1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 2.0, 1.0, 0.0, 3.0, 1.0, 0.0};
  const double t[2] = {0.0, 0.1}, u[2] = {0.3, -0.4}, v[2] = {2.0, -5.0};
  const double h = 0.1, c2 = (3.0 * (u[1] - u[0]) / h - 2.0 * v[0] - v[1]) / h, c3 = (v[0] + v[1] - 2.0 * (u[1] - u[0]) / h) / (h * h);
  double spring[ROW], dashpot[ROW], power[ROW], held;
  int done;
  ed_damper *damper = new_damper(p, 1.0, 1.0);
  const double been[4] = {9.0, -9.0, 99.0, -99.0};
  CHECK_STATUS(ed_damper_been(damper, been), ED_OK);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, u, v, spring, dashpot, power, &held, &done), ED_OK);
  CHECK_NEAR(held, 2.0 * 0.3, 1e-15);
  for (int k = 0; k < ROW; k++) {
    double of_u = 0.0, of_v = 0.0;
    for (int i = 0; i < 5 * 16; i++) {
      const double x = (i / 5 + 0.5 * (1.0 + point[i % 5])) / 16.0, s = h * x;
      const double term = weight[i % 5] / 16.0 * cos(k * acos(2.0 * x - 1.0));
      of_u += term * (u[0] + s * (v[0] + s * (c2 + s * c3)));
      of_v += term * (v[0] + s * (2.0 * c2 + s * 3.0 * c3));
    }
    CHECK_NEAR(spring[k], 2.0 * of_u, 1e-13);
    CHECK_NEAR(dashpot[k], 3.0 * of_v, 1e-12);
    CHECK_NEAR(power[k], of_v, 1e-10);
  }
  /* one alone */
  double again[ROW];
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, u, v, NULL, NULL, again, &held, &done), ED_OK);
  for (int k = 0; k < ROW; k++)
    CHECK(again[k] == power[k]);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, u, v, NULL, again, NULL, &held, &done), ED_OK);
  for (int k = 0; k < ROW; k++)
    CHECK(again[k] == dashpot[k]);
  ed_damper_free(damper);
}

static void check_refusals(void)
{
  const double t[2] = {0.0, 0.1}, u[2] = {0.0, 1.0}, v[2] = {0.0, NAN}, back[2] = {0.1, 0.0};
  const double voigt[2] = {1.0, 1.0};
  double spring[ROW], dashpot[ROW], held;
  char message[256];
  int done, status;
  ed_damper *damper = new_damper(TABLE_4_2, 0.03, 0.374);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, u, v, spring, dashpot, NULL, &held, &done), ED_E_NOT_FINITE);
  CHECK(done == 1);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, back, u, u, spring, dashpot, NULL, &held, &done), ED_E_ARGUMENT);
  const double far[2] = {0.0, 1e308}, fast[2] = {0.0, -1e308}; /* finite, but not the cubic between */
  double power[ROW];
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, far, fast, spring, dashpot, NULL, &held, &done), ED_E_NOT_FINITE);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, far, fast, NULL, NULL, power, &held, &done), ED_E_NOT_FINITE);
  CHECK(done == 1);
  ed_damper_free(damper);
  damper = ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, voigt, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  CHECK_STATUS(ed_mgmm_moments(damper, 2, t, u, u, spring, dashpot, NULL, &held, &done), ED_E_STATE);
  ed_damper_free(damper);
}

int main(void)
{
  check_polynomials();
  check_refusals();
  for (double step = 0.002; step < 0.02; step *= 2.0) {
    check_against_the_law(step, 0.374);
    check_against_the_law(step, 1.4);
  }
  return checks_end("mgmm moments");
}
