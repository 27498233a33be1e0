/* The loop of substructure tests: ideal parts against closed forms, each compensator and rig, refusals. */
#include "checks.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 400 };
static const double STEP = 1e-3, STIFFNESS = 2e6;

static ed_damper *spring(double brace)
{
  int status;
  char message[256];
  const double parameters[] = {STIFFNESS, 0.0};
  return ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, parameters, brace, 0.0, &status, message, sizeof message);
}

static void no_compensator(ed_compensator_parameters *c)
{
  memset(c, 0, sizeof *c);
  c->step = STEP;
  c->n_terms = 1;
  c->term[0].coefficient = 1.0;
}

static void ideal_rig(ed_rig_model *rig)
{
  memset(rig, 0, sizeof *rig);
  rig->d = 1.0;
  rig->stroke = rig->velocity = rig->force = HUGE_VAL;
}

static const ed_sensors PERFECT = {.displacement_range = HUGE_VAL, .force_range = HUGE_VAL};

static ed_substructure_input input_of(ed_compensator_parameters *c, ed_rig_model *rig, ed_damper *specimen)
{
  return (ed_substructure_input){.step = STEP, .sub_steps = 5, .compensator = c, .rig = rig, .sensors = &PERFECT, .specimen = specimen,
                                 .abort_displacement = HUGE_VAL, .force_scale = 1.0, .deformation_scale = 1.0};
}

/* Runs from rest; the status. record: (STEPS + 1) x ED_RTS_CHANNELS. */
static int run(const ed_substructure_input *input, const double *drive, unsigned long long seed, double *record, int *done)
{
  int status;
  char message[256];
  ed_substructure *test = ed_substructure_new(input, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  if (!test)
    return status;
  status = ed_substructure_run(test, STEPS, drive, seed, record, done);
  ed_substructure_free(test);
  return status;
}

static void sine(double amplitude, double frequency, double *target)
{
  const double omega = 2.0 * M_PI * frequency;
  for (int k = 0; k <= STEPS; k++) {
    const double phase = omega * STEP * k;
    target[3 * k] = amplitude * sin(phase);
    target[3 * k + 1] = amplitude * omega * cos(phase);
    target[3 * k + 2] = -amplitude * omega * omega * sin(phase);
  }
}

static double record[(STEPS + 1) * (ED_RTS_CHANNELS + 2)], other[(STEPS + 1) * (ED_RTS_CHANNELS + 2)], target[3 * (STEPS + 1)];

static void test_delay(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  ed_damper *specimen = spring(0.0);
  int done;
  no_compensator(&c);
  ideal_rig(&rig);
  rig.delay = 10.3e-3;
  sine(5e-3, 2.0, target);
  const ed_substructure_input input = input_of(&c, &rig, specimen);
  CHECK_STATUS(run(&input, target, 0, record, &done), ED_OK);
  CHECK_INT(done, STEPS + 1);
  for (int k = 20; k <= STEPS; k++) { /* ramps between samples: an eighth of the square of the step times the acceleration */
    const double *row = record + k * ED_RTS_CHANNELS;
    CHECK_NEAR(row[ED_RTS_DEFORMATION], 5e-3 * sin(4.0 * M_PI * (k * STEP - 10.3e-3)), 1.1 * 1e-6 / 8.0 * 5e-3 * 16.0 * M_PI * M_PI);
    CHECK_NEAR(row[ED_RTS_TRUE_FORCE], STIFFNESS * row[ED_RTS_DEFORMATION], 1e-6);
  }
  ed_damper_free(specimen);
}

/* Under the forces of a test the numerical part alone has the targets of `record` again. */
static void check_by_force(const ed_substructure_input *input, const double *drive, const double *force, int width)
{
  static double found[STEPS + 1];
  int status, done;
  char message[256];
  ed_substructure *test = ed_substructure_new(input, &status, message, sizeof message);
  CHECK_STATUS(ed_substructure_by_force(test, STEPS, drive, force, found, &done), ED_OK);
  CHECK_INT(done, STEPS + 1);
  for (int k = 0; k <= STEPS; k++)
    CHECK_NEAR(found[k], record[k * width + ED_RTS_TARGET], 1e-12);
  CHECK_STATUS(ed_substructure_by_force(test, -1, drive, force, found, &done), ED_E_ARGUMENT);
  ed_substructure_free(test);
}

/* An undamped mass on a numerical spring and the specimen, by the explicit Newmark method: x_(k+1) = 2 x_k - x_(k-1) + dt^2 a_k. */
static void test_closed_loop(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  ed_damper *specimen = spring(0.0);
  int done;
  const double mass = 1e4, k_N = 1e6;
  /* states x, v + dt/2 a; a = -(k_N x + F)/m - a_g */
  const double r = k_N / mass, h = STEP;
  const double A[] = {1.0 - 0.5 * h * h * r - 0.5 * h * h * r, h, -h * r, 1.0};
  const double of[2] = {-h * h, -h}; /* of F/m + a_g */
  const double B[] = {of[0] / mass, 0.0, of[0], 0.0, of[1] / mass, 0.0, of[1], 0.0};
  double C[8] = {0}, D[16] = {0}, drive[STEPS + 1] = {0};
  C[0] = A[0], C[1] = A[1], C[6] = A[0], C[7] = A[1];
  memcpy(D, B, 4 * sizeof *B);
  memcpy(D + 12, B, 4 * sizeof *B);
  no_compensator(&c);
  ideal_rig(&rig);
  ed_substructure_input input = input_of(&c, &rig, specimen);
  input.n_states = 2;
  input.n_outputs = 1;
  input.A = A, input.B = B, input.C = C, input.D = D;
  drive[0] = 1.0;
  CHECK_STATUS(run(&input, drive, 0, record, &done), ED_OK);
  const int width = ED_RTS_CHANNELS + 1;
  double x = 0.0, before = 0.0, force[STEPS + 1];
  force[0] = 0.0;
  for (int k = 0; k < STEPS; k++) {
    const double next = 2.0 * x - before - h * h * ((k_N + STIFFNESS) / mass * x + (k ? 0.0 : 1.0));
    before = x;
    x = next;
    CHECK_NEAR(record[(k + 1) * width + ED_RTS_TARGET], x, 1e-12);
    CHECK_NEAR(record[(k + 1) * width + ED_RTS_CHANNELS], x, 1e-12);
    force[k + 1] = STIFFNESS * x;
    CHECK_NEAR(record[(k + 1) * width + ED_RTS_APPLIED_FORCE], force[k + 1], 1e-6);
  }
  /* a force that the compensator adds to the one that is read is as a part of the numerical part's own */
  c.n_force_terms = 1;
  c.force_term[0].coefficient = -0.25 * STIFFNESS;
  CHECK_STATUS(run(&input, drive, 0, other, &done), ED_OK);
  for (int k = 1; k <= STEPS; k++) {
    const double *row = other + k * width;
    CHECK_NEAR(row[ED_RTS_APPLIED_FORCE], 0.75 * STIFFNESS * row[ED_RTS_TARGET], 1e-6);
    CHECK_NEAR(row[ED_RTS_FORCE], STIFFNESS * row[ED_RTS_TARGET], 1e-6);
  }
  c.n_force_terms = 0;
  check_by_force(&input, drive, force, width);
  input.abort_displacement = 1e-9;
  CHECK_STATUS(run(&input, drive, 0, record, &done), ED_LIMIT);
  CHECK(done >= 2 && done < STEPS);
  ed_damper_free(specimen);
}

static void adaptive(ed_compensator_parameters *c, int kind)
{
  static const double LARGEST[] = {1.3, 0.04, 8e-4}, RATE[] = {2.0, 0.05, 1e-3};
  memset(c, 0, sizeof *c);
  c->kind = kind;
  c->step = STEP;
  c->initial[0] = 1.0;
  c->least[0] = 0.7;
  memcpy(c->largest, LARGEST, sizeof LARGEST);
  memcpy(c->rate, RATE, sizeof RATE);
  c->threshold = 1e-4;
  c->forgetting = 0.996;
  c->window = 200;
  c->every = 16;
  c->n_sections = 1;
  const double low[] = {0.067455, 0.134911, 0.067455, -1.14298, 0.412802}; /* Butterworth, a tenth of the sampling rate */
  memcpy(c->section[0], low, sizeof low);
}

static void test_all_compensators(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  int done;
  ed_damper *specimen = spring(0.0);
  ideal_rig(&rig);
  rig.delay = 8e-3;
  sine(5e-3, 3.0, target);
  for (int kind = ED_COMPENSATE_LINEAR; kind <= ED_COMPENSATE_MODIFIED_ATS; kind++) {
    no_compensator(&c);
    if (kind == ED_COMPENSATE_LIVE_DELAY) {
      c.order = 2;
      c.delay = 6e-3;
      c.largest_delay = 0.04;
      c.share = 0.5;
    }
    if (kind >= ED_COMPENSATE_ATS)
      adaptive(&c, kind);
    c.kind = kind;
    ed_sensors noisy = PERFECT;
    noisy.displacement_noise = 1e-6;
    noisy.displacement_quantisation = 1e-7;
    noisy.force_noise = 10.0;
    noisy.force_delay = 0.3e-3;
    ed_substructure_input input = input_of(&c, &rig, specimen);
    input.sensors = &noisy;
    input.unseen_delay = kind == ED_COMPENSATE_ATS ? 2 : 0;
    CHECK_STATUS(run(&input, target, 3, record, &done), ED_OK);
    CHECK_STATUS(run(&input, target, 3, other, &done), ED_OK);
    CHECK_SAME(record, other, (STEPS + 1) * ED_RTS_CHANNELS);
    CHECK_STATUS(run(&input, target, 4, other, &done), ED_OK);
    CHECK(record[ED_RTS_CHANNELS + ED_RTS_FORCE] != other[ED_RTS_CHANNELS + ED_RTS_FORCE]);
    const double *last = record + STEPS * ED_RTS_CHANNELS;
    if (kind == ED_COMPENSATE_LIVE_DELAY)
      CHECK_NEAR(last[ED_RTS_ALPHA], 8e-3, 1e-3);
    if (kind >= ED_COMPENSATE_ATS)
      CHECK_NEAR(last[ED_RTS_ALPHA + 1], 8e-3, 1.5e-3);
  }
  ed_damper_free(specimen);
}

/* The bits of all limits that were met in a run. */
static int limits_met(const ed_substructure_input *input)
{
  int met = 0, done;
  CHECK_STATUS(run(input, target, 0, record, &done), ED_OK);
  for (int k = 0; k <= STEPS; k++)
    met |= (int)record[k * ED_RTS_CHANNELS + ED_RTS_SATURATED];
  return met;
}

/* The piston comes to the command, the specimen short of it by the give of the rig; limits that are met are reported. */
static void test_servo_hydraulic(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  int done;
  ed_damper *specimen = spring(0.0);
  no_compensator(&c);
  ideal_rig(&rig);
  rig.kind = ED_RIG_SERVO_HYDRAULIC;
  rig.gain = 140.0;
  rig.valve_lag = 2.6e-3;
  rig.oil = 5e7;
  rig.stiffness = 1e8;
  const ed_substructure_input input = input_of(&c, &rig, specimen);
  memset(target, 0, sizeof target);
  for (int k = 1; k <= STEPS; k++)
    target[3 * k] = 1e-3;
  CHECK_STATUS(run(&input, target, 0, record, &done), ED_OK);
  const double *last = record + STEPS * ED_RTS_CHANNELS;
  CHECK_NEAR(last[ED_RTS_ACTUATOR], 1e-3, 1e-9); /* the loop of the controller is closed about the piston */
  CHECK_NEAR(last[ED_RTS_DEFORMATION], 1e-3 / (1.0 + STIFFNESS / 1e8), 1e-9);
  rig.corrected = 1;
  CHECK_STATUS(run(&input, target, 0, record, &done), ED_OK);
  CHECK_NEAR(last[ED_RTS_DEFORMATION], 1e-3, 1e-6 * 1e-3 + 1e-8);
  rig.velocity = 0.01;
  rig.stroke = 0.5e-3;
  CHECK_INT(limits_met(&input), 3);
  rig.stroke = HUGE_VAL;
  rig.force = 500.0;
  CHECK_INT(limits_met(&input), 6);
  ed_damper_free(specimen);
}

/* The stroke is the piston's: at its end the rig gives way, and the oil does not. By hand, of three springs in series. */
static void test_stroke_of_the_piston(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  int done;
  ed_damper *specimen = spring(0.0);
  no_compensator(&c);
  ideal_rig(&rig);
  rig.kind = ED_RIG_SERVO_HYDRAULIC;
  rig.gain = 140.0;
  rig.oil = 5e6;
  rig.stroke = 0.8e-3;
  const ed_substructure_input input = input_of(&c, &rig, specimen);
  const double *last = record + STEPS * ED_RTS_CHANNELS;
  for (int soft = 0; soft <= 1; soft++) {
    rig.stiffness = soft ? 4e6 : 0.0;
    memset(target, 0, sizeof target);
    for (int k = 1; k <= STEPS; k++) /* there and back: 0.7 mm of piston need 0.98 mm of oil and piston together */
      target[3 * k] = k < STEPS / 2 ? -2e-3 : 0.7e-3;
    CHECK_STATUS(run(&input, target, 0, record, &done), ED_OK);
    const double *held = record + (STEPS / 2 - 1) * ED_RTS_CHANNELS, give = soft ? 1.0 + STIFFNESS / 4e6 : 1.0;
    CHECK_NEAR(held[ED_RTS_ACTUATOR], -0.8e-3, 1e-15);
    CHECK_NEAR(held[ED_RTS_DEFORMATION], -0.8e-3 / give, 1e-12);
    CHECK_NEAR(held[ED_RTS_TRUE_FORCE], -0.8e-3 * STIFFNESS / give, 1e-6);
    CHECK_NEAR(last[ED_RTS_ACTUATOR], 0.7e-3, 1e-9);
    CHECK_NEAR(last[ED_RTS_DEFORMATION], 0.7e-3 / give, 1e-9);
  }
  ed_damper_free(specimen);
}

/* A law that SUNDIALS integrates. */
static void test_law_without_exact_step(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  int done, status;
  char message[256];
  const double parameters[] = {2e4, 2e-3, 0.1, 1.0, 0.5, 0.5, 2.0};
  ed_damper *specimen = ed_damper_new(ED_LAW_BOUC_WEN, 7, parameters, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  no_compensator(&c);
  ideal_rig(&rig);
  sine(5e-3, 2.0, target);
  const ed_substructure_input input = input_of(&c, &rig, specimen);
  CHECK_STATUS(run(&input, target, 0, record, &done), ED_OK);
  CHECK_INT(done, STEPS + 1);
  CHECK(fabs(record[STEPS * ED_RTS_CHANNELS + ED_RTS_FORCE]) < 1e5);
  ed_damper_free(specimen);
}

static void check_refused(const ed_substructure_input *input, const char *part)
{
  int status;
  char message[256] = "";
  CHECK(ed_substructure_new(input, &status, message, sizeof message) == NULL);
  CHECK_STATUS(status, ED_E_ARGUMENT);
  CHECK_CONTAINS(message, part);
}

static void test_refusals(void)
{
  ed_compensator_parameters c;
  ed_rig_model rig;
  ed_damper *specimen = spring(0.0);
  no_compensator(&c);
  ideal_rig(&rig);
  ed_substructure_input input = input_of(&c, &rig, specimen);
  input.sub_steps = 0;
  check_refused(&input, "sub-step");
  input.sub_steps = 5;
  c.term[0].lag = ED_COMPENSATOR_MEMORY;
  check_refused(&input, "back");
  c.term[0].lag = 0;
  c.kind = 9;
  check_refused(&input, "no such compensator");
  adaptive(&c, ED_COMPENSATE_MODIFIED_ATS);
  c.forgetting = 0.0;
  check_refused(&input, "forgetting");
  adaptive(&c, ED_COMPENSATE_ATS);
  for (c.window = -1; c.window <= 32; c.window += 11) /* the last step, and those 16 and 32 before it, need 33 */
    check_refused(&input, "window");
  c.every = 2000000000;
  c.window = 33;
  check_refused(&input, "window");
  c.every = 16;
  int made;
  ed_substructure *shortest = ed_substructure_new(&input, &made, NULL, 0);
  CHECK_STATUS(made, ED_OK);
  ed_substructure_free(shortest);
  no_compensator(&c);
  input.specimen = spring(1e8);
  check_refused(&input, "brace");
  ed_damper_free(input.specimen);
  input.specimen = specimen;
  rig.delay = -1.0;
  check_refused(&input, "delay");
  rig.delay = NAN;
  check_refused(&input, "delay");
  rig.delay = 0.0;
  rig.stroke = 0.0;
  check_refused(&input, "limits");
  ideal_rig(&rig);
  input.abort_displacement = NAN;
  check_refused(&input, "abort");
  input.abort_displacement = 1.0;
  c.step = 2.0 * STEP;
  check_refused(&input, "another step");
  no_compensator(&c);
  target[4] = NAN;
  int done, status;
  char message[8];
  ed_substructure *test = ed_substructure_new(&input, &status, message, sizeof message);
  CHECK_STATUS(ed_substructure_run(test, STEPS, target, 0, record, &done), ED_E_ARGUMENT);
  ed_substructure_free(test);
  ed_damper_free(specimen);
}

int main(void)
{
  test_delay();
  test_closed_loop();
  test_all_compensators();
  test_servo_hydraulic();
  test_stroke_of_the_piston();
  test_law_without_exact_step();
  test_refusals();
  return checks_end("substructure tests");
}
