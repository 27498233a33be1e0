/* A frame as the numerical part of a substructure test: against a recursion by hand, and against the frame with the specimen in it. */
#include "checks.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINEST = 4, BASE = 400, MOST = BASE * FINEST, WIDTH = ED_RTS_CHANNELS };
static const double BASE_STEP = 0.01;
static const frame_options OPTIONS = {.bays = 1, .storeys = 2, .points = 4, .geometry = ED_P_DELTA, .hardening = 0.02};
static double record[(MOST + 1) * WIDTH], again[(MOST + 1) * WIDTH], ground[MOST + 1], direct[MOST + 1];
static double kept[2][(MOST + 1) * 2], energy[(MOST + 1) * ED_N_ENERGY];

static ed_damper *spring(double stiffness, double dashpot)
{
  int status;
  char message[256];
  const double parameters[] = {stiffness, dashpot};
  return ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, parameters, 0.0, 0.0, &status, message, sizeof message);
}

/* A loop of a perfect laboratory around a frame. */
typedef struct {
  ed_compensator_parameters compensator;
  ed_rig_model rig;
  ed_frame_part frame;
  ed_substructure_input input;
} loop;

static const ed_sensors PERFECT = {.displacement_range = HUGE_VAL, .force_range = HUGE_VAL};

static void perfect_loop(loop *l, ed_analysis *analysis, ed_damper *specimen, double step, int n_terms, const int *node, const int *degree,
                         const double *coefficient)
{
  memset(l, 0, sizeof *l);
  l->compensator.step = step;
  l->compensator.n_terms = 1;
  l->compensator.term[0].coefficient = 1.0;
  l->rig.d = 1.0;
  l->rig.stroke = l->rig.velocity = l->rig.force = HUGE_VAL;
  l->frame = (ed_frame_part){.analysis = analysis, .divisions = 1, .method = ED_NEWMARK, .parameters = {0.5, 0.25}, .n_terms = n_terms,
                             .node = node, .degree = degree, .coefficient = coefficient};
  l->input = (ed_substructure_input){.step = step, .sub_steps = 1, .compensator = &l->compensator, .rig = &l->rig, .sensors = &PERFECT,
                                     .specimen = specimen, .abort_displacement = HUGE_VAL, .force_scale = 1.0, .deformation_scale = 1.0,
                                     .frame = &l->frame};
}

static ed_substructure *made(const loop *l)
{
  int status;
  char message[256];
  ed_substructure *test = ed_substructure_new(&l->input, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return test;
}

static int run(const loop *l, int n, double *rows, int *done)
{
  ed_substructure *test = made(l);
  const int status = ed_substructure_run(test, n, ground, 0, rows, done);
  ed_substructure_free(test);
  return status;
}

/* A mass on a spring and the specimen: Newmark's constant average acceleration with F_k at the start, and at the end F_k or 2 F_k -
 * F_(k-1). */
static void check_oscillator(int held, int divisions)
{
  const double M = 4e3, K = 9e5, k_E = 4e5, h = 2e-3, dt = h / divisions;
  ed_model *model = ed_model_new(2);
  const int steel = ed_model_material(model, ED_ELASTIC, 1, &K), node = 1, degree = 0;
  const double one = 1.0;
  ed_model_node(model, "support", (double[]){0.0, 0.0});
  ed_model_node(model, "mass", (double[]){1.0, 0.0});
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_fix(model, 1, (int[]){0, 1, 1});
  ed_model_mass(model, 1, (double[]){M, M, 0.0});
  ed_model_truss(model, "bar", 0, 1, steel, 1.0, ED_LINEAR);
  ed_analysis *a = frame_analysis(model);
  add_channel(a, ED_DISPLACEMENT, 1, 0);
  add_channel(a, ED_GROUND_ACCELERATION, 0, 0);
  ed_damper *specimen = spring(k_E, 0.0);
  loop l;
  int done;
  perfect_loop(&l, a, specimen, h, 1, &node, &degree, &one);
  l.frame.held = held;
  l.frame.divisions = divisions;
  ground_motion(BASE, h, 3.0, ground);
  ed_run_buffers(a, divisions, NULL, kept[0], NULL);
  CHECK_STATUS(run(&l, BASE, record, &done), ED_OK);
  CHECK_INT(done, BASE + 1);
  double u = 0.0, v = 0.0, last = 0.0;
  for (int k = 0; k < BASE; k++) {
    const double F = k_E * u, change = held || k == 0 ? 0.0 : F - last;
    last = F;
    double acceleration = 0.0;
    for (int j = 0; j < divisions; j++) {
      const double s0 = (double)j / divisions, s1 = (double)(j + 1) / divisions, g0 = ground[k] + s0 * (ground[k + 1] - ground[k]);
      const double g1 = ground[k] + s1 * (ground[k + 1] - ground[k]), a0 = -(K * u + F + s0 * change) / M - g0;
      const double next = (-M * g1 - F - s1 * change + M * (4.0 * u / (dt * dt) + 4.0 * v / dt + a0)) / (K + 4.0 * M / (dt * dt));
      acceleration = -(K * next + F + s1 * change) / M - g1;
      v += 0.5 * dt * (a0 + acceleration);
      u = next;
    }
    const double *row = record + (k + 1) * WIDTH;
    CHECK_NEAR(row[ED_RTS_TARGET], u, 1e-9);
    CHECK_NEAR(row[ED_RTS_TARGET_VELOCITY], v, 1e-8);
    CHECK_NEAR(row[ED_RTS_TARGET_ACCELERATION], acceleration, 1e-5);
    CHECK_NEAR(row[ED_RTS_TRUE_FORCE], k_E * u, 1e-3);
    CHECK_NEAR(kept[0][2 * (k + 1)], u, 1e-9);
    CHECK_NEAR(kept[0][2 * (k + 1) + 1], ground[k + 1], 1e-14);
  }
  ed_damper_free(specimen);
  ed_analysis_free(a);
  ed_model_free(model);
}

static const int SPECIMEN_DEGREE[] = {0, 0};
static const double SPECIMEN_COEFFICIENT[] = {1.0, -1.0}, SPECIMEN[] = {4e6, 0.0};

static ed_analysis *ready(ed_model **model, int with_specimen, const int *node)
{
  *model = frame_model(OPTIONS);
  if (with_specimen)
    ed_model_damper(*model, "specimen", ED_LAW_KELVIN_VOIGT, 2, SPECIMEN, 0.0, 0.0, 1.0, 1.0, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
  ed_analysis *a = frame_analysis(*model);
  ed_set(a, ED_TOLERANCE, 1e-9);
  ed_rayleigh(a, 0.3, 1e-3, ED_STIFFNESS_INITIAL);
  CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 5), ED_OK);
  CHECK_STATUS(run_to_end(a, 5), ED_OK);
  ed_install_dampers(a);
  return a;
}

static void specimen_nodes(int node[2])
{
  node[0] = frame_node(OPTIONS, 0, 1);
  node[1] = frame_node(OPTIONS, 0, 0);
}

/* The rig goes in ramps, so the velocity of a dashpot would be late by half a step; the specimen is a spring.
 * Root mean square difference of the loop and the frame with the specimen in it, over the root mean square, at instants BASE_STEP apart. */
static double error_of_loop(int held, int finer)
{
  int node[2], done, n = BASE * finer;
  ed_model *model;
  specimen_nodes(node);
  ground_motion(n, BASE_STEP / finer, 14.0, ground);
  ed_analysis *whole = ready(&model, 1, node);
  add_channel(whole, ED_DAMPER_DEFORMATION, 0, 0);
  CHECK_STATUS(ed_history_begin(whole, n, BASE_STEP / finer, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(whole, 1, NULL, direct, NULL);
  CHECK_STATUS(run_to_end(whole, n), ED_OK);
  ed_analysis_free(whole);
  ed_model_free(model);
  ed_damper *specimen = spring(SPECIMEN[0], SPECIMEN[1]);
  ed_analysis *a = ready(&model, 0, node);
  add_channel(a, ED_DISPLACEMENT, node[0], 0);
  add_channel(a, ED_PLASTIC_ROTATION, 0, 0);
  loop l;
  perfect_loop(&l, a, specimen, BASE_STEP / finer, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
  l.frame.held = held;
  ed_run_buffers(a, 1, NULL, kept[0], NULL);
  CHECK_STATUS(run(&l, n, record, &done), ED_OK);
  double error = 0.0, size = 0.0, plastic = 0.0;
  for (int i = 0; i <= n; i += finer) {
    error += pow(record[i * WIDTH + ED_RTS_DEFORMATION] - direct[i], 2.0);
    size += direct[i] * direct[i];
    plastic = fmax(plastic, fabs(kept[0][2 * i + 1]));
  }
  CHECK(plastic > 2e-3);
  ed_statistics s;
  ed_get_statistics(a, &s);
  CHECK(s.energy_error < 2e-3);
  ed_damper_free(specimen);
  ed_analysis_free(a);
  ed_model_free(model);
  return sqrt(error / size);
}

/* The given force is the specimen as the frame meets it, its part on the support is in the reaction of the node, and its work balances
 * the energies: all as of a damper in the frame. A limit ends the test. */
static void check_specimen_of_frame(void)
{
  enum { CHANNELS = 4 };
  static double loop_values[(BASE + 1) * CHANNELS], whole_values[(BASE + 1) * CHANNELS];
  int node[2], done;
  specimen_nodes(node);
  const double h = 0.25 * BASE_STEP;
  ground_motion(BASE, h, 14.0, ground);
  for (int with_specimen = 0; with_specimen < 2; with_specimen++) {
    ed_model *model;
    ed_analysis *a = ready(&model, with_specimen, node);
    add_channel(a, with_specimen ? ED_DAMPER_FORCE : ED_GIVEN_FORCE, 0, 0);
    add_channel(a, with_specimen ? ED_DAMPER_DEFORMATION : ED_GIVEN_DEFORMATION, 0, 0);
    add_channel(a, with_specimen ? ED_DAMPER_WORK : ED_GIVEN_WORK, 0, 0);
    add_channel(a, ED_REACTION, node[1], 0);
    if (with_specimen) {
      CHECK_STATUS(ed_history_begin(a, BASE, h, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
      ed_run_buffers(a, 1, NULL, whole_values, NULL);
      CHECK_STATUS(run_to_end(a, BASE), ED_OK);
      ed_run_end(a);
    } else {
      ed_damper *specimen = spring(SPECIMEN[0], SPECIMEN[1]);
      loop l;
      perfect_loop(&l, a, specimen, h, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
      ed_substructure *test = made(&l);
      ed_run_buffers(a, 1, NULL, loop_values, energy);
      CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, record, &done), ED_OK);
      const double limit = 0.5 * fabs(loop_values[CHANNELS * (BASE / 2)]);
      CHECK_STATUS(ed_channel_limit(a, 0, limit), ED_OK);
      CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, again, &done), ED_LIMIT);
      ed_substructure_free(test);
      CHECK(done > 1 && done <= BASE / 2 + 1);
      CHECK_SAME(again, record, (size_t)done * WIDTH);
      CHECK(fabs(loop_values[CHANNELS * (done - 1)]) > limit && fabs(loop_values[CHANNELS * (done - 2)]) <= limit);
      ed_damper_free(specimen);
    }
    ed_analysis_free(a);
    ed_model_free(model);
  }
  for (int channel = 0; channel < CHANNELS; channel++) {
    double largest = 0.0;
    for (int k = 0; k <= BASE; k++)
      largest = fmax(largest, fabs(whole_values[CHANNELS * k + channel]));
    for (int k = 0; k <= BASE; k++)
      CHECK_NEAR(loop_values[CHANNELS * k + channel], whole_values[CHANNELS * k + channel], 5e-3 * largest); /* of the step */
  }
  for (int k = 0; k <= BASE; k++) {
    const double *values = loop_values + CHANNELS * k;
    CHECK_NEAR(values[1], record[k * WIDTH + ED_RTS_TARGET], 1e-12);
    CHECK_NEAR(energy[k * ED_N_ENERGY + ED_BALANCE], 0.0, 1e-3 * energy[BASE * ED_N_ENERGY + ED_HYSTERETIC]);
  }
}

static void check_order(void)
{
  for (int held = 0; held < 2; held++) {
    double error[3];
    for (int i = 0; i < 3; i++)
      error[i] = error_of_loop(held, 1 << i);
    const double order = log2(error[0] / error[2]) / 2.0;
    CHECK_NEAR(order, held ? 1.0 : 2.0, 0.25);
    CHECK(error[2] < (held ? 0.05 : 2e-3));
  }
}

/* Tests begin where the analysis stood when the loop was made, again and again; what fails is reported, and leaves no run behind. */
static void check_life(void)
{
  int node[2], done, status;
  char message[256];
  ed_model *model;
  specimen_nodes(node);
  ed_analysis *a = ready(&model, 0, node);
  ed_damper *specimen = spring(SPECIMEN[0], SPECIMEN[1]);
  double *rest = malloc((size_t)ed_state_size(a) * sizeof *rest);
  ed_state_get(a, rest);
  add_channel(a, ED_DISPLACEMENT, node[0], 0);
  loop l;
  perfect_loop(&l, a, specimen, BASE_STEP, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
  ground_motion(BASE, BASE_STEP, 14.0, ground);
  ed_substructure *test = made(&l);
  add_channel(a, ED_PLASTIC_ROTATION, 0, 0);
  ed_run_buffers(a, 1, NULL, kept[0], NULL);
  CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, record, &done), ED_OK);
  ed_run_buffers(a, 1, NULL, kept[1], NULL);
  CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, again, &done), ED_OK);
  CHECK_SAME(again, record, (BASE + 1) * WIDTH);
  CHECK_SAME(kept[1], kept[0], (BASE + 1) * 2);
  kept[1][0] = 7.0; /* the buffers of a test are given anew for the next */
  CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, again, &done), ED_OK);
  CHECK(kept[1][0] == 7.0);
  CHECK_STATUS(ed_substructure_run(test, 0, ground, 0, again, &done), ED_OK);
  CHECK_INT(done, 1);
  for (int k = 0; k <= BASE; k++)
    ground[k] *= 100.0; /* it collapses */
  CHECK(ed_substructure_run(test, BASE, ground, 0, again, &done) < 0);
  CHECK(done > 1 && done < BASE);
  CHECK_CONTAINS(ed_substructure_message(test), "the numerical part: ");
  CHECK_STATUS(ed_state_set(a, rest), ED_OK);
  CHECK_STATUS(ed_history_begin(a, BASE, BASE_STEP, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, again, &done), ED_E_STATE);
  CHECK(ed_substructure_new(&l.input, &status, message, sizeof message) == NULL);
  CHECK_CONTAINS(message, "in the middle of a run");
  CHECK_STATUS(ed_run_advance(a, 1), ED_OK); /* of which the test has kept its hands off */
  ed_run_end(a);
  ed_substructure_free(test);
  l.frame.parameters[1] = -1.0;
  test = made(&l);
  CHECK_STATUS(ed_substructure_run(test, BASE, ground, 0, again, &done), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_substructure_message(test), "integration parameters");
  ed_substructure_free(test);
  free(rest);
  ed_damper_free(specimen);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* A specimen too stiff for the step: the loop grows, and ends at the abort displacement or where the frame fails. */
static void check_divergence(void)
{
  int node[2], done;
  ed_model *model;
  specimen_nodes(node);
  ed_analysis *a = ready(&model, 0, node);
  ed_damper *specimen = spring(4e9, 0.0);
  loop l;
  perfect_loop(&l, a, specimen, BASE_STEP, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
  ground_motion(BASE, BASE_STEP, 1.0, ground);
  l.input.abort_displacement = 0.1;
  CHECK_STATUS(run(&l, BASE, record, &done), ED_LIMIT);
  l.input.abort_displacement = HUGE_VAL;
  CHECK(run(&l, BASE, record, &done) < 0);
  CHECK(done < BASE);
  ed_damper_free(specimen);
  ed_analysis_free(a);
  ed_model_free(model);
}

static void check_refused(const loop *l, const char *part)
{
  int status;
  char message[256] = "";
  CHECK(ed_substructure_new(&l->input, &status, message, sizeof message) == NULL);
  CHECK_STATUS(status, ED_E_ARGUMENT);
  CHECK_CONTAINS(message, part);
}

static void check_refusals(void)
{
  int node[2], wrong[2] = {0, 77}, turned[2] = {3, 0};
  ed_model *model;
  specimen_nodes(node);
  ed_analysis *a = ready(&model, 0, node);
  ed_damper *specimen = spring(1e6, 0.0);
  const double broken[] = {NAN, 1.0};
  loop good, l;
  perfect_loop(&good, a, specimen, BASE_STEP, 2, node, SPECIMEN_DEGREE, SPECIMEN_COEFFICIENT);
#define REFUSED(change, part) \
  do { \
    l = good; \
    l.input.compensator = &l.compensator, l.input.rig = &l.rig, l.input.frame = &l.frame; \
    change; \
    check_refused(&l, part); \
  } while (0)
  REFUSED(l.input.n_states = 2, "either");
  REFUSED(l.input.n_states = -2, "no states");
  REFUSED(l.input.n_outputs = -1, "outputs");
  REFUSED(l.input.n_outputs = 1, "outputs");
  REFUSED(l.frame.analysis = NULL, "analysis");
  REFUSED(l.frame.divisions = 0, "1 to 1000");
  REFUSED(l.frame.n_terms = 0, "1 to 12");
  REFUSED(l.frame.n_terms = 13, "1 to 12");
  REFUSED(l.frame.node = wrong, "degree");
  REFUSED(l.frame.degree = turned, "degree");
  REFUSED(l.frame.coefficient = broken, "finite");
  ed_damper_free(specimen);
  ed_analysis_free(a);
  ed_model_free(model);
}

int main(void)
{
  for (int held = 0; held < 2; held++)
    for (int divisions = 1; divisions <= 3; divisions += 2)
      check_oscillator(held, divisions);
  check_order();
  check_specimen_of_frame();
  check_life();
  check_divergence();
  check_refusals();
  return checks_end("a frame as the numerical part of substructure tests");
}
