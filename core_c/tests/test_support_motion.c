/* Supports that move in a history: every law of dampers and yielding members, halved steps, returns, restarts, refusals. */
#include "checks.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 300 };
static const double DT = 0.005;
static const frame_options OPTIONS = {.bays = 2, .storeys = 2, .points = 5, .geometry = ED_P_DELTA, .hardening = 0.01};
static double ground[N + 1], d[N + 1], v[N + 1], acc[N + 1], values[2][N + 1], energy[(N + 1) * ED_N_ENERGY];

/* From rest: displacement, velocity and acceleration of a smooth way there and back. */
static void make_motion(void)
{
  for (int i = 0; i <= N; i++) {
    const double t = i * DT, w = 2.0 * acos(-1.0) / (N * DT);
    d[i] = 0.02 * (1.0 - cos(w * t)) * (1.0 - cos(w * t));
    v[i] = 0.04 * w * sin(w * t) * (1.0 - cos(w * t));
    acc[i] = 0.04 * w * w * (cos(w * t) * (1.0 - cos(w * t)) + sin(w * t) * sin(w * t));
  }
}

static void prepare(ed_analysis *a)
{
  CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 5), ED_OK);
  CHECK_STATUS(run_to_end(a, 5), ED_OK);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  ed_rayleigh(a, 0.3, 1e-3, ED_STIFFNESS_CURRENT);
  CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
}

/* A yielding frame with every damper: trials that are left change nothing, and the balance closes. */
static void check_returns(void)
{
  for (int tried = 0; tried < 2; tried++) {
    ed_model *model = frame_model(OPTIONS);
    add_dampers(model, OPTIONS);
    ed_analysis *a = frame_analysis(model);
    const int base = frame_node(OPTIONS, 2, 0);
    prepare(a);
    CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_OK);
    add_channel(a, ED_DISPLACEMENT, frame_node(OPTIONS, 0, 2), 0);
    add_channel(a, ED_DISPLACEMENT, base, 0);
    double *both = calloc(2 * (N + 1), sizeof *both);
    ed_run_buffers(a, 1, NULL, both, energy);
    for (int i = 0; i < N; i++) {
      if (tried && i % 7 == 3)
        ed_try_and_revert(a, 0.4); /* whether it converges or not */
      CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
    }
    double input = 0.0;
    for (int i = 0; i <= N; i++) {
      values[tried][i] = both[2 * i];
      CHECK_NEAR(both[2 * i + 1], d[i], 1e-15);
      input = fmax(input, fabs(energy[i * ED_N_ENERGY + ED_INPUT]));
    }
    for (int i = 0; i <= N; i++)
      CHECK_NEAR(energy[i * ED_N_ENERGY + ED_BALANCE], 0.0, 5e-3 * input); /* yielding in a step is not trapezoidal */
    free(both);
    ed_run_end(a);
    ed_analysis_free(a);
    ed_model_free(model);
  }
  CHECK_SAME(values[1], values[0], N + 1);
}

/* What is prescribed at the ends of whole steps holds in halved ones: one tight step a piece needs them. */
static void check_halving(void)
{
  ed_model *model = frame_model(OPTIONS);
  ed_analysis *a = frame_analysis(model);
  const int base = frame_node(OPTIONS, 1, 0);
  CHECK_STATUS(ed_set(a, ED_MAX_ITERATIONS, 4), ED_OK);
  CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-9), ED_OK);
  prepare(a);
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_OK);
  CHECK_STATUS(ed_history_support(a, base, 1, d, v, acc), ED_OK);
  const int across = add_channel(a, ED_DISPLACEMENT, base, 0), speed = add_channel(a, ED_VELOCITY, base, 1);
  ed_run_buffers(a, 1, NULL, NULL, energy);
  CHECK_STATUS(run_to_end(a, N), ED_OK);
  ed_statistics s;
  ed_get_statistics(a, &s);
  CHECK(s.substeps > s.steps);
  CHECK(s.energy_error < 1e-2);
  double most[2], least[2], last[2], when[2];
  ed_extremes(a, most, when, least, when, last);
  CHECK_NEAR(last[across], 0.0, 1e-15);
  CHECK_NEAR(last[speed], v[N], 1e-15);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* The state of a run with a base aside goes into another analysis of the model, where it stays aside. */
static void check_restart(void)
{
  ed_model *model = frame_model(OPTIONS);
  ed_analysis *a = frame_analysis(model), *b = frame_analysis(model);
  const int base = frame_node(OPTIONS, 0, 0);
  prepare(a);
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_OK);
  CHECK_STATUS(ed_run_advance(a, N / 2), ED_OK);
  ed_run_end(a);
  double *state = malloc((size_t)ed_state_size(a) * sizeof *state);
  ed_state_get(a, state);
  CHECK_STATUS(ed_state_set(b, state), ED_OK);
  double last[1], other[1];
  CHECK_STATUS(ed_history_begin(b, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  const int channel = add_channel(b, ED_DISPLACEMENT, base, 0);
  CHECK_STATUS(ed_run_advance(b, 3), ED_OK);
  ed_extremes(b, other, other, other, other, last);
  CHECK_INT(channel, 0);
  CHECK_NEAR(last[0], d[N / 2], 1e-15);
  free(state);
  ed_analysis_free(a);
  ed_analysis_free(b);
  ed_model_free(model);
}

static void check_refusals(void)
{
  ed_model *model = frame_model(OPTIONS);
  ed_analysis *a = frame_analysis(model);
  const int base = frame_node(OPTIONS, 0, 0), degree[] = {0, 0}, both[] = {frame_node(OPTIONS, 0, 1), base};
  const double one[] = {1.0, -1.0};
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_E_STATE);
  prepare(a);
  CHECK_STATUS(ed_history_support(a, base, 3, d, v, acc), ED_E_ID);
  CHECK_STATUS(ed_history_support(a, -1, 0, d, v, acc), ED_E_ID);
  CHECK_STATUS(ed_history_support(a, both[0], 0, d, v, acc), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_analysis_message(a), "has no support");
  d[N] += NAN;
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_E_NOT_FINITE);
  make_motion();
  v[0] = 1.0;
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_analysis_message(a), "at rest");
  make_motion();
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_OK);
  CHECK_STATUS(ed_history_support(a, base, 0, d, v, acc), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_analysis_message(a), "already");
  CHECK_STATUS(ed_history_force(a, 2, both, degree, one), ED_E_ARGUMENT);
  CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
  CHECK_STATUS(ed_history_support(a, base, 1, d, v, acc), ED_E_STATE);
  ed_analysis_free(a); /* during the run */
  ed_model_free(model);
}

int main(void)
{
  ground_motion(N, DT, 6.0, ground);
  make_motion();
  check_returns();
  check_halving();
  check_restart();
  check_refusals();
  return checks_end("support motion");
}
