/* Forces that are given from step to step of a history: against the ground motion that does the same, jumps, energy, restarts, refusals. */
#include "checks.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 400 };
static const double DT = 0.005, M = 4e3, K = 9e5;
static const double ALPHA[4] = {2.0 / 7.0, 3.0 / 7.0, 0.5 + 1.0 / 7.0, 16.0 / 49.0};
static double ground[N + 1], values[2][N + 1], energy[2][(N + 1) * ED_N_ENERGY];

/* A mass on an elastic bar. */
static ed_model *oscillator(void)
{
  ed_model *model = ed_model_new(2);
  const double E = K;
  const int steel = ed_model_material(model, ED_ELASTIC, 1, &E);
  ed_model_node(model, "support", (double[]){0.0, 0.0});
  ed_model_node(model, "mass", (double[]){1.0, 0.0});
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_fix(model, 1, (int[]){0, 1, 1});
  ed_model_mass(model, 1, (double[]){M, M, 0.0});
  ed_model_truss(model, "bar", 0, 1, steel, 1.0, ED_LINEAR);
  return model;
}

/* A history under the ground motion, or under the forces on the masses that do the same to what moves relative to the ground. */
static void run_frame(ed_analysis *a, frame_options o, int method, int by_force, double *value, double *balance)
{
  static const double still[N + 1];
  int node[12], degree[12] = {0}, n = 0;
  double coefficient[12];
  for (int floor = 1; floor <= o.storeys; floor++)
    for (int line = 0; line <= o.bays; line++) {
      node[n] = frame_node(o, line, floor);
      coefficient[n++] = -20e3;
    }
  CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 5), ED_OK);
  CHECK_STATUS(run_to_end(a, 5), ED_OK);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  add_channel(a, ED_DISPLACEMENT, frame_node(o, 0, o.storeys), 0);
  CHECK_STATUS(ed_history_begin(a, N, DT, by_force ? still : ground, NULL, NULL, method, method == ED_NEWMARK ? AVERAGE_ACCELERATION : ALPHA),
               ED_OK);
  ed_run_buffers(a, 1, NULL, value, balance);
  if (by_force)
    CHECK_INT(ed_history_force(a, n, node, degree, coefficient), 0);
  for (int k = 0; k < N; k++) {
    if (by_force)
      CHECK_STATUS(ed_history_set_force(a, 0, ground[k], ground[k + 1]), ED_OK);
    CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
  }
  ed_run_end(a);
}

static void check_against_ground(int method, int iterations, int halves)
{
  const frame_options o = {.bays = 2, .storeys = 2, .points = 5, .geometry = ED_P_DELTA, .hardening = 0.01};
  double largest = 0.0, input = 0.0;
  ed_statistics s;
  for (int by_force = 0; by_force < 2; by_force++) {
    ed_model *model = frame_model(o);
    add_dampers(model, o);
    ed_analysis *a = frame_analysis(model);
    CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-10), ED_OK);
    CHECK_STATUS(ed_set(a, ED_MAX_ITERATIONS, iterations), ED_OK);
    ed_rayleigh(a, 0.3, 1e-3, ED_STIFFNESS_INITIAL);
    run_frame(a, o, method, by_force, values[by_force], energy[by_force]);
    ed_get_statistics(a, &s);
    CHECK((s.substeps > s.steps) == halves);
    ed_analysis_free(a);
    ed_model_free(model);
  }
  for (int i = 0; i <= N; i++) {
    largest = fmax(largest, fabs(values[0][i]));
    input = fmax(input, fabs(energy[0][i * ED_N_ENERGY + ED_INPUT]));
  }
  CHECK(largest > 0.05); /* far into the plastic range */
  CHECK(energy[1][N * ED_N_ENERGY + ED_HYSTERETIC] > 0.05 * input);
  for (int i = 0; i <= N; i++) {
    CHECK_NEAR(values[1][i], values[0][i], 1e-5 * largest);
    CHECK_NEAR(energy[1][i * ED_N_ENERGY + ED_INPUT], energy[0][i * ED_N_ENERGY + ED_INPUT], 1e-4 * input);
    if (method == ED_NEWMARK)
      CHECK_NEAR(energy[1][i * ED_N_ENERGY + ED_BALANCE], energy[0][i * ED_N_ENERGY + ED_BALANCE], 1e-4 * input);
  }
}

/* Held forces: m x'' = F_k - k x over each step, acceleration from balance with F_k at both ends. */
static void check_jumps(void)
{
  ed_model *model = oscillator();
  ed_analysis *a = frame_analysis(model);
  const int node = 1, degree = 0;
  const double one = 1.0;
  double u = 0.0, v = 0.0, largest = 0.0;
  add_channel(a, ED_DISPLACEMENT, 1, 0);
  CHECK_STATUS(ed_history_begin(a, N, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(a, 1, NULL, values[0], energy[0]);
  CHECK_INT(ed_history_force(a, 1, &node, &degree, &one), 0);
  for (int k = 0; k < N; k++) {
    const double F = 1e4 * sin(20.0 * DT * k + 0.5);
    if (k < N - 5) { /* then it stays as it is */
      CHECK_STATUS(ed_history_set_force(a, 0, 3.0 * F, 7.0), ED_OK); /* what is not wanted after all leaves nothing */
      CHECK_STATUS(ed_history_set_force(a, 0, F, F), ED_OK);
    }
    CHECK_STATUS(ed_try_and_revert(a, 0.5), ED_OK);
    CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
    const double held = k < N - 5 ? F : 1e4 * sin(20.0 * DT * (N - 6) + 0.5), a0 = (held - K * u) / M;
    const double next = (held + M * (4.0 * u / (DT * DT) + 4.0 * v / DT + a0)) / (K + 4.0 * M / (DT * DT));
    const double a1 = (held - K * next) / M;
    v += 0.5 * DT * (a0 + a1);
    u = next;
    largest = fmax(largest, fabs(u));
    CHECK_NEAR(values[0][k + 1], u, 1e-11 * largest);
    CHECK_NEAR(energy[0][(k + 1) * ED_N_ENERGY + ED_BALANCE], 0.0, 1e-9 * K * largest * largest);
  }
  ed_run_end(a);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* A horizontal force and a moment on a rotation without mass, both of which jump: the balance of an elastic frame closes. */
static void check_balance(void)
{
  const frame_options o = {.bays = 1, .storeys = 2, .points = 3, .geometry = ED_LINEAR, .hardening = 0.01};
  ed_model *model = frame_model(o);
  ed_analysis *a = frame_analysis(model);
  const int node[] = {frame_node(o, 0, 2), frame_node(o, 0, 0)}, across[] = {0, 0}, turn = 2;
  const double coefficient[] = {1.0, -1.0};
  ed_rayleigh(a, 0.3, 1e-3, ED_STIFFNESS_INITIAL);
  CHECK_STATUS(ed_history_begin(a, N, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(a, 1, NULL, NULL, energy[0]);
  CHECK_INT(ed_history_force(a, 2, node, across, coefficient), 0); /* the second degree is fixed */
  CHECK_INT(ed_history_force(a, 1, node, &turn, coefficient), 1);
  double input = 0.0;
  for (int k = 0; k < N; k++) {
    CHECK_STATUS(ed_history_set_force(a, 0, 2e3 * sin(0.05 * k), 2e3 * sin(0.05 * k + 0.1)), ED_OK);
    CHECK_STATUS(ed_history_set_force(a, 1, 1e3 * cos(0.3 * k), 1.5e3 * cos(0.3 * k + 0.3)), ED_OK);
    CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
    input = fmax(input, fabs(energy[0][(k + 1) * ED_N_ENERGY + ED_INPUT]));
    CHECK_NEAR(energy[0][(k + 1) * ED_N_ENERGY + ED_BALANCE], 0.0, 1e-6 * input);
  }
  CHECK(input > 0.0);
  ed_run_end(a);
  ed_analysis_free(a);
  ed_model_free(model);
}

static double *state_of(const ed_analysis *a)
{
  double *state = malloc((size_t)ed_state_size(a) * sizeof *state);
  ed_state_get(a, state);
  return state;
}

/* Whether a history goes on from the state of another one. */
static void check_restart(void)
{
  ed_model *model = oscillator();
  const int node = 1, degree = 0, half = N / 2;
  const double one = 1.0;
  double *state = NULL;
  for (int parts = 1; parts <= 2; parts++) {
    ed_analysis *a = frame_analysis(model);
    add_channel(a, ED_DISPLACEMENT, 1, 0);
    for (int part = 0; part < parts; part++) {
      const int first = part * half, steps = parts == 1 ? N : half;
      if (part == 1) {
        ed_analysis_free(a);
        a = frame_analysis(model);
        add_channel(a, ED_DISPLACEMENT, 1, 0);
        CHECK_STATUS(ed_state_set(a, state), ED_OK);
      }
      CHECK_STATUS(ed_history_begin(a, steps, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
      ed_run_buffers(a, 1, NULL, values[parts - 1] + first, NULL);
      CHECK_INT(ed_history_force(a, 1, &node, &degree, &one), 0);
      for (int k = first; k < first + steps; k++) {
        CHECK_STATUS(ed_history_set_force(a, 0, 1e4 * ground[k], 1e4 * ground[k + 1]), ED_OK);
        CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
      }
      ed_run_end(a);
      free(state);
      state = state_of(a);
    }
    ed_analysis_free(a);
  }
  for (int i = 0; i <= N; i++)
    CHECK_NEAR(values[1][i], values[0][i], 1e-9);
  free(state);
  ed_model_free(model);
}

#define REFUSED(call, status, part) \
  do { \
    CHECK_STATUS((call), (status)); \
    CHECK_CONTAINS(ed_analysis_message(a), (part)); \
  } while (0)

static void check_refusals(void)
{
  ed_model *model = oscillator();
  ed_analysis *a = frame_analysis(model);
  const int node[] = {1, 7, 0}, degree[] = {0, 0, 3};
  const double coefficient[] = {1.0, INFINITY};
  REFUSED(ed_history_force(a, 1, node, degree, coefficient), ED_E_STATE, "while one runs");
  REFUSED(ed_history_set_force(a, 0, 0.0, 0.0), ED_E_STATE, "while one runs");
  CHECK_STATUS(ed_history_begin(a, 3, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  REFUSED(ed_history_force(a, 0, node, degree, coefficient), ED_E_ARGUMENT, "1 to 12");
  REFUSED(ed_history_force(a, 13, node, degree, coefficient), ED_E_ARGUMENT, "1 to 12");
  REFUSED(ed_history_force(a, 1, node + 1, degree, coefficient), ED_E_ID, "node 7");
  REFUSED(ed_history_force(a, 1, node, degree + 2, coefficient), ED_E_ID, "degree 3");
  REFUSED(ed_history_force(a, 1, node, degree, coefficient + 1), ED_E_NOT_FINITE, "coefficient 1");
  REFUSED(ed_history_force(a, 1, node + 2, degree, coefficient), ED_E_ARGUMENT, "supports");
  for (int i = 0; i < ED_HISTORY_FORCES; i++)
    CHECK_INT(ed_history_force(a, 1, node, degree, coefficient), i);
  REFUSED(ed_history_force(a, 1, node, degree, coefficient), ED_E_ARGUMENT, "at most");
  REFUSED(ed_history_set_force(a, ED_HISTORY_FORCES, 0.0, 0.0), ED_E_ID, "no force");
  REFUSED(ed_history_set_force(a, 0, NAN, 0.0), ED_E_NOT_FINITE, "force 0");
  REFUSED(ed_history_set_force(a, 0, 0.0, INFINITY), ED_E_NOT_FINITE, "force 0");
  double *before = state_of(a);
  CHECK_STATUS(ed_history_set_force(a, 0, 1e308, 0.0), ED_OK);
  CHECK_STATUS(ed_history_set_force(a, 0, 0.0, 0.0), ED_OK);
  REFUSED(ed_history_set_force(a, 0, -1.0, NAN), ED_E_NOT_FINITE, "force 0");
  double *after = state_of(a);
  CHECK_SAME(after, before, ed_state_size(a));
  CHECK_STATUS(run_to_end(a, 3), ED_OK);
  REFUSED(ed_history_set_force(a, 0, 0.0, 0.0), ED_E_STATE, "while one runs");
  CHECK_STATUS(ed_history_begin(a, 3, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  REFUSED(ed_history_set_force(a, 0, 0.0, 0.0), ED_E_ID, "no force"); /* they end with their run */
  CHECK_INT(ed_history_force(a, 1, node, degree, coefficient), 0);
  CHECK_STATUS(ed_history_set_force(a, 0, 0.0, 1e308), ED_OK);
  CHECK(ed_run_advance(a, 3) < 0);
  REFUSED(ed_history_set_force(a, 0, 0.0, 0.0), ED_E_STATE, "while one runs"); /* it has failed */
  ed_run_end(a);
  free(before), free(after);
  ed_analysis_free(a);
  ed_model_free(model);
}

int main(void)
{
  ground_motion(N, DT, 12.0, ground);
  check_against_ground(ED_NEWMARK, 25, 0);
  check_against_ground(ED_NEWMARK, 3, 1);
  check_against_ground(ED_GENERALISED_ALPHA, 25, 0);
  check_jumps();
  check_balance();
  check_restart();
  check_refusals();
  return checks_end("forces of histories");
}
