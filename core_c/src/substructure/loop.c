/* The loop of a real-time substructure test: numerical part, compensator, rig, specimen, sensors. */
#include "base/finite.h"
#include "base/watch.h"
#include "damper/law.h"
#include "damper/ode_system.h"
#include "substructure/delay_line.h"
#include "substructure/numerical.h"
#include "substructure/rig.h"
#include "substructure/sensor.h"
#include "substructure/specimen.h"
#include "substructure/wrong_input.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TARGETS = ED_PART_TARGETS, MOST_TEXT = 1200 };

static const double TOLERANCE = 1e-6; /* relative, of SUNDIALS for laws without an exact step */

struct ed_substructure {
  double step, h;
  int sub_steps, unseen_delay;
  ed_numerical *numerical;   /* NULL: targets are given */
  double abort_displacement;
  double in_series;          /* flexibility of what stands in series with the specimen, m/N */
  ed_compensator_parameters compensator;
  ed_rig_model rig;
  ed_sensors sensors;
  ed_specimen specimen;
  ed_stop stop;
  size_t state_size;         /* of one block */
  double *state, *waiting;   /* the specimen's is the first of it */
  ed_delay_line command_line, force_line;
  ed_compensator compensating;
  ed_rig_state moving;
  ed_sensor displacement_sensor, force_sensor;
  char message[MOST_TEXT];
};

/* ---- making one ------------------------------------------------------------------------------------------------- */

static int refuse(char *message, int size, const char *text)
{
  if (size > 0)
    snprintf(message, (size_t)size, "%s", text);
  return ED_E_ARGUMENT;
}

static int make(ed_substructure *t, const ed_substructure_input *in)
{
  const size_t law = (size_t)ed_damper_state_size(in->specimen), waiting = TARGETS * ((size_t)in->unseen_delay + 1);
  int status = ED_OK;
  t->step = in->step;
  t->sub_steps = in->sub_steps;
  t->h = in->step / in->sub_steps;
  t->unseen_delay = in->unseen_delay;
  t->abort_displacement = in->abort_displacement;
  t->in_series = ed_rig_flexibility(in->rig);
  t->compensator = *in->compensator;
  t->rig = *in->rig;
  t->sensors = *in->sensors;
  t->specimen = (ed_specimen){.damper = in->specimen, .force_scale = in->force_scale, .deformation_scale = in->deformation_scale, .h = t->h};
  const double late = t->rig.delay / t->h, force_late = t->sensors.force_delay / t->h;
  const size_t line = (size_t)ed_delay_line_size(late), force_line = (size_t)ed_delay_line_size(force_late);
  t->state_size = 2 * law + waiting + line + force_line;
  t->state = malloc(sizeof *t->state * t->state_size);
  const int numerical = in->frame || in->n_states > 0;
  if (numerical)
    t->numerical = in->frame ? ed_frame_part_new(in) : ed_recursion_part(in);
  if (!t->state || (numerical && !t->numerical))
    return ED_E_MEMORY;
  t->specimen.law = t->state;
  t->specimen.trial = t->state + law;
  t->waiting = t->state + 2 * law;
  t->command_line = ed_delay_line_of(late, t->waiting + waiting);
  t->force_line = ed_delay_line_of(force_late, t->waiting + waiting + line);
  if (!ed_damper_has_exact_step(in->specimen))
    t->specimen.system = ed_ode_system_new(1, &t->specimen.damper, TOLERANCE, &status);
  return status;
}

ed_substructure *ed_substructure_new(const ed_substructure_input *input, int *status, char *message, int size)
{
  const char *wrong = ed_wrong_substructure(input);
  if (wrong) {
    *status = refuse(message, size, wrong);
    return NULL;
  }
  ed_substructure *test = calloc(1, sizeof *test);
  *status = test ? make(test, input) : ED_E_MEMORY;
  if (*status == ED_OK)
    return test;
  if (size > 0)
    snprintf(message, (size_t)size, "%s", ed_status_text(*status));
  ed_substructure_free(test);
  return NULL;
}

void ed_substructure_free(ed_substructure *test)
{
  if (!test)
    return;
  ed_ode_system_free(test->specimen.system);
  if (test->numerical)
    test->numerical->free(test->numerical);
  free(test->state);
  free(test);
}

void ed_substructure_ask(ed_substructure *test, const ed_stop *stop)
{
  test->stop = stop ? *stop : (ed_stop){0};
}

/* ---- running ---------------------------------------------------------------------------------------------------- */

static void begin(ed_substructure *t, unsigned long long seed)
{
  const ed_sensors *s = &t->sensors;
  memset(t->state, 0, sizeof *t->state * t->state_size);
  t->command_line.last = t->force_line.last = 0;
  ed_specimen_start(&t->specimen);
  ed_compensator_start(&t->compensator, &t->compensating);
  ed_rig_start(&t->rig, &t->moving, t->h);
  t->displacement_sensor = (ed_sensor){.noise = s->displacement_noise, .quantisation = s->displacement_quantisation, .range = s->displacement_range,
                                       .state = 2 * seed};
  t->force_sensor = (ed_sensor){.noise = s->force_noise, .quantisation = s->force_quantisation, .range = s->force_range, .state = 2 * seed + 1};
}

/* Notes what failed, and returns the status. */
static int failed(ed_substructure *t, int status, const char *what, const char *why)
{
  snprintf(t->message, sizeof t->message, "%s: %s", what, why ? why : ed_status_text(status));
  return status;
}

static int numerical_part_failed(ed_substructure *t, int status)
{
  return failed(t, status, "the numerical part", t->numerical->message(t->numerical));
}

/* The target that the compensator gets: that of `unseen_delay` steps ago. */
static const double *delayed_target(ed_substructure *t, int k, const double target[TARGETS])
{
  const int places = t->unseen_delay + 1;
  memcpy(t->waiting + TARGETS * (k % places), target, sizeof *target * TARGETS);
  return t->waiting + TARGETS * ((k + 1) % places);
}

typedef struct {
  double force, measured;
  int saturated;
} readings;

/* Drive, specimen and force over a sub-step. */
static int move_specimen(ed_substructure *t, double w, readings *now)
{
  ed_rig_state *rig = &t->moving;
  const double from = rig->x;
  double start;
  ed_rig_move(&t->rig, rig, t->h, w, t->specimen.force, &start, &now->saturated);
  if (!isfinite(rig->x + rig->v))
    return ED_E_NOT_FINITE;
  ed_specimen *specimen = &t->specimen;
  const double force = specimen->force, deformation = specimen->deformation;
  int status = t->in_series > 0.0 ? ed_specimen_in_series(specimen, t->in_series, rig->x)
                                  : ed_specimen_follow(specimen, from, start, rig->x, rig->v);
  const double end = ed_rig_beyond(&t->rig, rig, specimen->force);
  if (status == ED_OK && end != 0.0) { /* the piston stands, and no oil gives way */
    specimen->force = force;
    specimen->deformation = deformation;
    status = ed_specimen_in_series(specimen, ed_rig_give(&t->rig), end);
    ed_rig_stop(&t->rig, rig, end, specimen->force, &now->saturated);
  }
  ed_specimen_commit(specimen);
  ed_rig_settle(&t->rig, rig, specimen->force, &now->saturated);
  return status;
}

static double applied_force(const ed_substructure *t, const readings *now)
{
  return now->force + ed_compensator_force(&t->compensator, &t->compensating);
}

static void write_row(const ed_substructure *t, const double *target, double command, const readings *now, double *row)
{
  const ed_compensator *c = &t->compensating;
  const int adaptive = t->compensator.kind == ED_COMPENSATE_ATS || t->compensator.kind == ED_COMPENSATE_MODIFIED_ATS;
  memcpy(row, target, sizeof *row * TARGETS);
  row[ED_RTS_COMMAND] = command;
  row[ED_RTS_MEASURED] = now->measured;
  row[ED_RTS_ACTUATOR] = t->moving.piston;
  row[ED_RTS_DEFORMATION] = t->specimen.deformation;
  row[ED_RTS_FORCE] = now->force;
  row[ED_RTS_TRUE_FORCE] = t->specimen.force;
  for (int i = 0; i < 3; i++)
    row[ED_RTS_ALPHA + i] = adaptive ? c->alpha[i] : 0.0;
  if (t->compensator.kind == ED_COMPENSATE_LIVE_DELAY)
    row[ED_RTS_ALPHA] = c->delay;
  row[ED_RTS_INDEPENDENCE] = c->independence;
  row[ED_RTS_LIMITED] = c->limited;
  row[ED_RTS_SATURATED] = now->saturated;
  row[ED_RTS_APPLIED_FORCE] = applied_force(t, now);
}

static void read_sensors(ed_substructure *t, double delayed_force, readings *now)
{
  int clipped = 0;
  now->measured = ed_sensor_read(&t->displacement_sensor, t->specimen.deformation, &clipped);
  now->force = ed_sensor_read(&t->force_sensor, delayed_force, &clipped);
  if (clipped)
    now->saturated |= ED_SATURATED_SENSOR;
}

/* Rig and specimen over a main step in which the command goes from one value to the next. */
static int advance_rig(ed_substructure *t, double from, double to, readings *now)
{
  double delayed_force = 0.0;
  now->saturated = 0;
  for (int j = 1; j <= t->sub_steps; j++) {
    const double w = from + (to - from) * ((double)j / t->sub_steps);
    const int status = move_specimen(t, ed_delay_line_next(&t->command_line, w), now);
    if (status != ED_OK)
      return status;
    delayed_force = ed_delay_line_next(&t->force_line, t->specimen.force);
  }
  read_sensors(t, delayed_force, now);
  return ED_OK;
}

static int beyond(const ed_substructure *t, double target)
{
  return fabs(target) > t->abort_displacement || fabs(t->specimen.deformation) > t->abort_displacement;
}

static int run(ed_substructure *t, int n, const double *drive, ed_watch *watch, double *record, int *done)
{
  ed_numerical *numerical = t->numerical;
  const size_t width = ED_RTS_CHANNELS + (numerical ? (size_t)numerical->n_outputs : 0);
  readings now = {0};
  double sent = 0.0; /* command with the correction of the rig */
  memset(record, 0, sizeof *record * width);
  int status = numerical ? numerical->start(numerical, n, drive, record + ED_RTS_CHANNELS) : ED_OK;
  if (status != ED_OK)
    return numerical_part_failed(t, status);
  read_sensors(t, 0.0, &now);
  write_row(t, record, 0.0, &now, record);
  *done = 1;
  for (int k = 0; k < n; k++) {
    double *row = record + ((size_t)k + 1) * width, target[TARGETS];
    if (ed_watch_step(watch))
      return ED_E_STOPPED;
    int moved = ED_OK;
    if (numerical) {
      /* the first three of y are the target, and lie in the row before what is recorded of them */
      double *y = row + ED_RTS_CHANNELS - TARGETS;
      moved = numerical->step(numerical, applied_force(t, &now), y);
      if (moved < 0)
        return numerical_part_failed(t, moved);
      memcpy(target, y, sizeof target);
    } else {
      memcpy(target, drive + ((size_t)k + 1) * TARGETS, sizeof target);
    }
    const double *wanted = delayed_target(t, k, target);
    const double command = ed_compensator_step(&t->compensator, &t->compensating, wanted[0], wanted[1], wanted[2], now.measured);
    const double to = command + (t->rig.corrected ? t->moving.piston - now.measured : 0.0);
    if (!isfinite(command))
      return failed(t, ED_E_NOT_FINITE, "the command", NULL);
    if ((status = advance_rig(t, sent, to, &now)) != ED_OK)
      return failed(t, status, "the specimen", NULL);
    sent = to;
    write_row(t, target, command, &now, row);
    *done = k + 2;
    if (moved == ED_LIMIT || beyond(t, target[0]))
      return ED_LIMIT;
  }
  return ED_OK;
}

int ed_substructure_run(ed_substructure *t, int n, const double *drive, unsigned long long seed, double *record, int *done)
{
  ed_watch watch = ed_watch_of(&t->stop);
  *done = 0;
  if (n < 0 || !ed_all_finite(((size_t)n + 1) * (t->numerical ? 1 : TARGETS), drive))
    return failed(t, ED_E_ARGUMENT, "what drives the test", NULL);
  begin(t, seed);
  if (t->specimen.system)
    ed_ode_system_watch(t->specimen.system, &watch);
  const int status = run(t, n, drive, &watch, record, done);
  if (t->specimen.system)
    ed_ode_system_watch(t->specimen.system, NULL);
  if (t->numerical)
    t->numerical->end(t->numerical);
  return status;
}

/* y: room for targets and outputs. */
static int move_by_force(ed_substructure *t, int n, const double *ground, const double *force, ed_watch *watch, double *y, double *target,
                         int *done)
{
  ed_numerical *numerical = t->numerical;
  int status = numerical->start(numerical, n, ground, y + TARGETS);
  target[0] = 0.0;
  *done = 1;
  for (int k = 0; k < n && status == ED_OK; k++) {
    if (ed_watch_step(watch))
      return ED_E_STOPPED;
    status = numerical->step(numerical, force[k], y);
    if (status >= 0)
      target[(*done)++] = y[0];
  }
  return status < 0 ? numerical_part_failed(t, status) : status;
}

int ed_substructure_by_force(ed_substructure *t, int n, const double *ground, const double *force, double *target, int *done)
{
  ed_watch watch = ed_watch_of(&t->stop);
  *done = 0;
  if (!t->numerical)
    return failed(t, ED_E_ARGUMENT, "the numerical part", "there is none");
  if (n < 0 || !ed_all_finite((size_t)n + 1, ground) || !ed_all_finite((size_t)n + 1, force))
    return failed(t, ED_E_ARGUMENT, "what drives the test", NULL);
  double *y = malloc(sizeof *y * (TARGETS + (size_t)t->numerical->n_outputs));
  if (!y)
    return failed(t, ED_E_MEMORY, "the numerical part", NULL);
  const int status = move_by_force(t, n, ground, force, &watch, y, target, done);
  t->numerical->end(t->numerical);
  free(y);
  return status;
}

const char *ed_substructure_message(const ed_substructure *t)
{
  return t->message;
}
