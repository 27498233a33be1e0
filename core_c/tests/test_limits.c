/* Limits of channels: the run ends in the first step beyond one, everything before it is that of a run without limits. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 400 };
static const double DT = 0.01;
static const frame_options FRAME = {.bays = 1, .storeys = 2, .points = 4, .geometry = ED_P_DELTA};

static ed_analysis *shaken(const ed_model *model)
{
  static double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 2), ED_OK);
  CHECK_STATUS(ed_history_begin(analysis, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  return analysis;
}

/* The first sample beyond a limit, from 1; the start does not count. */
static int first_beyond(const double *u, double limit)
{
  for (int i = 1; i <= N; i++)
    if (fabs(u[i]) > limit)
      return i;
  return 0;
}

/* Negative and positive excursions, every step and every third kept, in one piece and in pieces. */
static void check_first_step_beyond(double share, int every, int piece)
{
  static double u[N + 1], kept[N + 1], time[N + 1];
  ed_model *model = frame_model(FRAME);
  ed_analysis *free_run = shaken(model), *watched = shaken(model);
  const int roof = frame_node(FRAME, 0, 2);
  add_channel(free_run, ED_DISPLACEMENT, roof, 0);
  ed_run_buffers(free_run, 1, NULL, u, NULL);
  CHECK_STATUS(ed_run_advance(free_run, N), ED_OK);
  double largest = 0.0, value = 0.0, at = 0.0;
  for (int i = 0; i <= N; i++)
    largest = fmax(largest, fabs(u[i]));
  const double limit = share * largest;
  const int step = first_beyond(u, limit);
  CHECK(step > 10 && step < N - 10);
  const int channel = add_channel(watched, ED_DISPLACEMENT, roof, 0);
  CHECK_STATUS(ed_channel_limit(watched, channel, limit), ED_OK);
  ed_run_buffers(watched, every, time, kept, NULL);
  CHECK_INT(ed_run_limit(watched, &value, &at), -1);
  int status = ED_OK;
  while (status == ED_OK && ed_run_steps_done(watched) < N)
    status = ed_run_advance(watched, piece);
  CHECK_STATUS(status, ED_LIMIT);
  CHECK_INT(ed_run_steps_done(watched), step);
  CHECK_INT(ed_run_rows(watched), step / every + 1);
  for (int i = 0; i < ed_run_rows(watched); i++)
    CHECK_SAME(kept + i, u + i * every, 1);
  CHECK_INT(ed_run_limit(watched, &value, &at), channel);
  CHECK_SAME(&value, u + step, 1);
  CHECK_NEAR(at, step * DT, 1e-12);
  double high, when_high, low, when_low, last;
  ed_extremes(watched, &high, &when_high, &low, &when_low, &last);
  CHECK_SAME(&last, u + step, 1);
  CHECK(fabs(last) == fmax(high, -low)); /* nothing was beyond before */
  CHECK_CONTAINS(ed_analysis_message(watched), "channel 0");
  CHECK_STATUS(ed_run_advance(watched, 1), ED_E_STATE); /* it is over */
  CHECK_CONTAINS(ed_analysis_message(watched), "limit");
  CHECK_INT(ed_run_steps_done(watched), step);
  ed_run_end(watched);

  /* the state stands: what follows is as after a run that was stopped there */
  ed_run_end(free_run);
  ed_analysis *stopped = shaken(model);
  CHECK_STATUS(ed_run_advance(stopped, step), ED_OK);
  ed_run_end(stopped);
  const int size = ed_state_size(watched);
  double *states = calloc(2 * (size_t)size, sizeof *states);
  ed_state_get(watched, states);
  ed_state_get(stopped, states + size);
  CHECK_SAME(states, states + size, size);
  free(states);
  ed_analysis_free(free_run);
  ed_analysis_free(watched);
  ed_analysis_free(stopped);
  ed_model_free(model);
}

/* Of several channels the one furthest beyond its limit; limits belong to their channels. */
static void check_several(void)
{
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = shaken(model);
  const int roof = frame_node(FRAME, 0, 2);
  double value, at;
  for (int i = 0; i < 3; i++)
    CHECK_INT(add_channel(analysis, ED_DISPLACEMENT, roof, 0), i);
  CHECK_STATUS(ed_channel_limit(analysis, 1, 1e-6), ED_OK);
  CHECK_STATUS(ed_channel_limit(analysis, 2, 1e-7), ED_OK);
  CHECK_STATUS(ed_run_advance(analysis, N), ED_LIMIT);
  CHECK_INT(ed_run_limit(analysis, &value, &at), 2);
  ed_run_end(analysis);
  CHECK_INT(ed_run_limit(analysis, &value, &at), -1);
  ed_clear_channels(analysis);
  add_channel(analysis, ED_DISPLACEMENT, roof, 0);
  CHECK_STATUS(ed_history_begin(analysis, N, DT, NULL, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(ed_run_advance(analysis, N), ED_OK);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* A pushover stops as well: the control point is the channel. */
static void check_pushover(void)
{
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model);
  const int roof = frame_node(FRAME, 0, 2);
  add_channel(analysis, ED_DISPLACEMENT, roof, 0);
  CHECK_STATUS(ed_channel_limit(analysis, 0, 0.0451), ED_OK);
  CHECK_STATUS(ed_pushover_begin(analysis, LATERAL, roof, 0, -0.1, 100), ED_OK);
  CHECK_STATUS(ed_run_advance(analysis, 100), ED_LIMIT);
  CHECK_INT(ed_run_steps_done(analysis), 46);
  ed_analysis_free(analysis); /* in the middle of it */
  ed_model_free(model);
}

static void check_refused(void)
{
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = shaken(model);
  CHECK_STATUS(ed_channel_limit(analysis, 0, 1.0), ED_E_ID);
  add_channel(analysis, ED_DISPLACEMENT, 2, 0);
  CHECK_STATUS(ed_channel_limit(analysis, 1, 1.0), ED_E_ID);
  CHECK_STATUS(ed_channel_limit(analysis, -1, 1.0), ED_E_ID);
  CHECK_STATUS(ed_channel_limit(analysis, 0, 0.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_channel_limit(analysis, 0, -1.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_channel_limit(analysis, 0, NAN), ED_E_ARGUMENT);
  CHECK_STATUS(ed_channel_limit(analysis, 0, INFINITY), ED_OK); /* none */
  CHECK_STATUS(ed_run_advance(analysis, 1), ED_OK);
  CHECK_STATUS(ed_channel_limit(analysis, 0, 1.0), ED_E_STATE);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  check_first_step_beyond(0.5, 1, N);
  check_first_step_beyond(0.9, 3, 7);
  check_first_step_beyond(0.2, 1000, 1);
  check_several();
  check_pushover();
  check_refused();
  return checks_end("limits of channels");
}
