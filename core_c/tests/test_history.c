/* Time histories: one degree against the recursion written out, free vibration against its period, a yielding frame
 * and its energies, order of convergence. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double M = 4e3, K = 9e5, C = 3e3; /* about 0.42 s and 2.5 % */

/* A mass on a bar: K = E A / L. */
static ed_model *oscillator(double fy)
{
  ed_model *model = ed_model_new(2);
  const double E = K, steel[] = {K, fy, 0.0};
  if (fy > 0.0)
    ed_model_material(model, ED_BILINEAR, 3, steel);
  else
    ed_model_material(model, ED_ELASTIC, 1, &E);
  ed_model_node(model, "ground", (double[]){0.0, 0.0});
  ed_model_node(model, "mass", (double[]){1.0, 0.0});
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_fix(model, 1, (int[]){0, 1, 1});
  ed_model_mass(model, 1, (double[]){M, 0.0, 0.0});
  ed_model_truss(model, "spring", 0, 1, 0, 1.0, ED_LINEAR);
  return model;
}

typedef struct {
  double am, af, gamma, beta;
} scheme;

/* Generalised-alpha written out for one linear degree (Chung & Hulbert 1993); am = af = 0: Newmark. */
static void recursion(scheme s, int n, double dt, const double *ground, double *u)
{
  double x = 0.0, v = 0.0, a = -ground[0];
  u[0] = 0.0;
  for (int i = 1; i <= n; i++) {
    const double xp = x + dt * v + dt * dt * (0.5 - s.beta) * a, vp = v + dt * (1.0 - s.gamma) * a;
    const double load = -M * ((1.0 - s.af) * ground[i] + s.af * ground[i - 1]);
    const double mass = (1.0 - s.am) * M + (1.0 - s.af) * (s.gamma * dt * C + s.beta * dt * dt * K);
    const double rest = s.am * M * a + C * ((1.0 - s.af) * vp + s.af * v) + K * ((1.0 - s.af) * xp + s.af * x);
    const double next = (load - rest) / mass;
    x = xp + s.beta * dt * dt * next;
    v = vp + s.gamma * dt * next;
    a = next;
    u[i] = x;
  }
}

static void check_recursion(int method, scheme s)
{
  enum { N = 400 };
  const double dt = 0.01, newmark[] = {s.gamma, s.beta}, alpha[] = {s.am, s.af, s.gamma, s.beta};
  double ground[N + 1], expected[N + 1], got[N + 1], time[N + 1];
  ground_motion(N, dt, 3.0, ground);
  recursion(s, N, dt, ground, expected);
  ed_model *model = oscillator(0.0);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_STATUS(ed_set(analysis, ED_TOLERANCE, 1e-12), ED_OK);
  CHECK_STATUS(ed_rayleigh(analysis, C / M, 0.0, ED_STIFFNESS_INITIAL), ED_OK);
  add_channel(analysis, ED_DISPLACEMENT, 1, 0);
  CHECK_STATUS(ed_history_begin(analysis, N, dt, ground, NULL, NULL, method, method == ED_NEWMARK ? newmark : alpha), ED_OK);
  ed_run_buffers(analysis, 1, time, got, NULL);
  CHECK_STATUS(run_to_end(analysis, N), ED_OK);
  const double peak = largest_of(expected, N + 1);
  CHECK(peak > 0.01);
  for (int i = 0; i <= N; i++) {
    CHECK_NEAR(got[i], expected[i], 1e-10 * peak);
    CHECK_NEAR(time[i], i * dt, 1e-12);
  }
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Rows that are taken while the run goes on leave their place to the next ones. */
static void check_taken_rows(void)
{
  enum { N = 200 };
  static double ground[N + 1], whole[N + 1], piece[4], time[4];
  for (int i = 0; i <= N; i++)
    ground[i] = sin(0.05 * i);
  ed_model *model = oscillator(0.0);
  for (int taken = 0; taken < 2; taken++) {
    ed_analysis *analysis = frame_analysis(model);
    add_channel(analysis, ED_DISPLACEMENT, 1, 0);
    CHECK_STATUS(ed_history_begin(analysis, N, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
    if (taken)
      ed_run_buffers(analysis, 1, time, piece, NULL);
    else
      ed_run_buffers(analysis, 1, NULL, whole, NULL);
    for (int row = 0; taken && row <= N;) {
      CHECK_STATUS(ed_run_advance(analysis, 3), ED_OK);
      const int rows = ed_run_take_rows(analysis);
      CHECK(rows > 0 && rows <= 4);
      CHECK_INT(ed_run_take_rows(analysis), 0);
      for (int i = 0; i < rows; i++, row++) {
        CHECK(piece[i] == whole[row]);
        CHECK_NEAR(time[i], row * 0.01, 1e-12);
      }
      CHECK_INT(ed_run_rows(analysis), row);
    }
    if (!taken)
      CHECK_STATUS(run_to_end(analysis, N), ED_OK);
    ed_analysis_free(analysis);
  }
  ed_model_free(model);
}

/* Free vibration from an initial velocity: the amplitude stays and the phase errs as (omega dt)^2 / 12. */
static double phase_error(double dt, double duration)
{
  const int n = (int)(duration / dt + 0.5);
  const double omega = sqrt(K / M), start = 0.3;
  ed_model *model = oscillator(0.0);
  ed_analysis *analysis = frame_analysis(model);
  ed_set(analysis, ED_TOLERANCE, 1e-12);
  double *u = malloc(((size_t)n + 1) * sizeof *u);
  add_channel(analysis, ED_DISPLACEMENT, 1, 0);
  CHECK_STATUS(ed_initial_velocity(analysis, &start), ED_OK);
  CHECK_STATUS(ed_history_begin(analysis, n, dt, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(ed_initial_velocity(analysis, &start), ED_E_STATE);
  ed_run_buffers(analysis, 1, NULL, u, NULL);
  CHECK_STATUS(run_to_end(analysis, n), ED_OK);
  CHECK(largest_of(u, n + 1) <= start / omega * (1.0 + 1e-9));
  const double error = fabs(u[n] - start / omega * sin(omega * n * dt)) * omega / start;
  free(u);
  ed_analysis_free(analysis);
  ed_model_free(model);
  return error;
}

static void check_order(void)
{
  const double coarse = phase_error(0.004, 2.0), fine = phase_error(0.002, 2.0);
  CHECK_NEAR(log2(coarse / fine), 2.0, 0.05);
}

/* Gravity, then strong shaking: completes, yields, balances. */
static void check_frame(int geometry, int stiffness, int method)
{
  enum { N = 500 };
  const double dt = 0.01, hht[] = {0.0, 0.1, 0.6, 0.3025};
  const frame_options o = {.bays = 2, .storeys = 2, .points = 5, .geometry = geometry};
  double ground[N + 1];
  static double energy[(N + 1) * ED_N_ENERGY];
  ed_statistics statistics;
  ground_motion(N, dt, 9.0, ground);
  ed_model *model = frame_model(o);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_STATUS(ed_rayleigh(analysis, 0.2, 0.002, stiffness), ED_OK);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 2), ED_OK);
  const double *parameters = method == ED_NEWMARK ? AVERAGE_ACCELERATION : hht;
  CHECK_STATUS(ed_history_begin(analysis, N, dt, ground, NULL, NULL, method, parameters), ED_OK);
  ed_run_buffers(analysis, 1, NULL, NULL, energy);
  CHECK_STATUS(ed_run_advance(analysis, N), ED_OK);
  CHECK_INT(ed_run_steps_done(analysis), N);
  ed_run_end(analysis);
  ed_get_statistics(analysis, &statistics);
  const double *end = energy + N * ED_N_ENERGY;
  CHECK(end[ED_HYSTERETIC] > 0.05 * end[ED_INPUT] && end[ED_DAMPING] > 0.0);
  double last = 0.0;
  for (int i = 0; i <= N; i++) { /* neither may be given back */
    CHECK(energy[i * ED_N_ENERGY + ED_HYSTERETIC] >= last);
    last = energy[i * ED_N_ENERGY + ED_HYSTERETIC];
  }
  /* numerical dissipation of the alpha method is part of its balance */
  if (method == ED_NEWMARK)
    CHECK_NEAR(end[ED_BALANCE], 0.0, 0.01 * end[ED_INPUT]);
  CHECK(statistics.steps == N + 2 && statistics.substeps >= statistics.steps && statistics.iterations > 0);
  CHECK(statistics.worst_unbalance <= 1e-6);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* A hinged bar that yields: the force never leaves the yield surface, the residual is that of the path. */
static void check_yielding_oscillator(void)
{
  enum { N = 600 };
  const double dt = 0.005, fy = 2e3;
  double ground[N + 1], force[N + 1];
  ground_motion(N, dt, 4.0, ground);
  ed_model *model = oscillator(fy);
  ed_analysis *analysis = frame_analysis(model);
  add_channel(analysis, ED_AXIAL_FORCE, 0, 0);
  CHECK_STATUS(ed_history_begin(analysis, N, dt, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(analysis, 1, NULL, force, NULL);
  CHECK_STATUS(run_to_end(analysis, N), ED_OK);
  CHECK_NEAR(largest_of(force, N + 1), fy, 1e-9 * fy);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  check_recursion(ED_NEWMARK, (scheme){0.0, 0.0, 0.5, 0.25});
  check_recursion(ED_NEWMARK, (scheme){0.0, 0.0, 0.5, 1.0 / 6.0});
  check_recursion(ED_GENERALISED_ALPHA, (scheme){0.0, 0.1, 0.6, 0.3025});
  check_recursion(ED_GENERALISED_ALPHA, (scheme){2.0 / 7.0, 3.0 / 7.0, 0.5 + 1.0 / 7.0, 16.0 / 49.0});
  check_order();
  check_taken_rows();
  check_yielding_oscillator();
  for (int stiffness = ED_STIFFNESS_INITIAL; stiffness <= ED_STIFFNESS_CURRENT; stiffness++)
    check_frame(ED_P_DELTA, stiffness, ED_NEWMARK);
  check_frame(ED_LINEAR, ED_STIFFNESS_CURRENT, ED_GENERALISED_ALPHA);
  check_frame(ED_COROTATIONAL, ED_STIFFNESS_INITIAL, ED_NEWMARK);
  return checks_end("time histories");
}
