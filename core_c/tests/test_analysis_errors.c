/* What an analysis refuses: status, message, and no harm done. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>

static const frame_options FRAME = {.bays = 1, .storeys = 1, .points = 4};

#define REFUSED(call, status, part)                          \
  do {                                                       \
    CHECK_STATUS((call), (status));                          \
    CHECK_CONTAINS(ed_analysis_message(analysis), (part));   \
  } while (0)

static void check_settings(ed_analysis *analysis)
{
  REFUSED(ed_set(analysis, ED_TOLERANCE, 0.0), ED_E_ARGUMENT, "tolerance");
  REFUSED(ed_set(analysis, ED_TOLERANCE, 1.0), ED_E_ARGUMENT, "tolerance");
  REFUSED(ed_set(analysis, ED_TOLERANCE, NAN), ED_E_ARGUMENT, "nan");
  REFUSED(ed_set(analysis, ED_MAX_ITERATIONS, 0.0), ED_E_ARGUMENT, "iterations");
  REFUSED(ed_set(analysis, ED_MAX_ITERATIONS, 1e9), ED_E_ARGUMENT, "iterations");
  REFUSED(ed_set(analysis, ED_HALVINGS, 21.0), ED_E_ARGUMENT, "20");
  REFUSED(ed_set(analysis, ED_HALVINGS, -1.0), ED_E_ARGUMENT, "-1");
  REFUSED(ed_set(analysis, 99, 1.0), ED_E_ARGUMENT, "99");
  REFUSED(ed_rayleigh(analysis, -0.1, 0.0, ED_STIFFNESS_INITIAL), ED_E_ARGUMENT, "Rayleigh");
  REFUSED(ed_rayleigh(analysis, 0.1, NAN, ED_STIFFNESS_INITIAL), ED_E_ARGUMENT, "Rayleigh");
  REFUSED(ed_rayleigh(analysis, 0.1, 0.1, 3), ED_E_ARGUMENT, "3");
}

static void check_modal(ed_analysis *analysis)
{
  const int n = ed_n_equations(analysis);
  double *shape = calloc((size_t)n, sizeof *shape), omega = 10.0, ratio = 0.02, none = 0.0, minus = -0.1;
  REFUSED(ed_modal_damping(analysis, n + 1, shape, &omega, &ratio), ED_E_ARGUMENT, "modes");
  REFUSED(ed_modal_damping(analysis, 1, shape, &omega, &ratio), ED_E_ARGUMENT, "mode 1"); /* no mass moves */
  for (int i = 0; i < n; i++)
    shape[i] = 1.0;
  REFUSED(ed_modal_damping(analysis, 1, shape, &none, &ratio), ED_E_ARGUMENT, "mode 1");
  REFUSED(ed_modal_damping(analysis, 1, shape, &omega, &minus), ED_E_ARGUMENT, "mode 1");
  CHECK_STATUS(ed_modal_damping(analysis, 1, shape, &omega, &ratio), ED_OK);
  CHECK_STATUS(ed_modal_damping(analysis, 0, shape, &omega, &ratio), ED_OK);
  free(shape);
}

static void check_channels(ed_analysis *analysis)
{
  static const int bad[][3] = {
      {ED_DISPLACEMENT, 4, 0},   {ED_DISPLACEMENT, -1, 0},   {ED_REACTION, 0, 3},       {ED_GROUND_ACCELERATION, 0, 2},
      {ED_LOAD_FACTOR, 2, 0},    {ED_END_FORCE, 3, 0},       {ED_END_FORCE, 0, 6},      {ED_GLOBAL_FORCE, 0, -1},
      {ED_AXIAL_FORCE, 0, 1},    {ED_DEFORMATION, 0, 3},     {ED_PLASTIC_ROTATION, 0, 2}, {ED_SECTION_FORCE, 0, 8},
      {ED_SECTION_DEFORMATION, 0, 8}, {ED_FIBRE_STRESS, 0, 48}, {ED_FIBRE_STRAIN, 0, 48}, {ED_FIBRE_STRAIN + 1, 0, 0},
      {-1, 0, 0}};
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
    REFUSED(add_channel(analysis, bad[i][0], bad[i][1], bad[i][2]), ED_E_ID, "channel 0");
  REFUSED(ed_channel(analysis, 0, NULL, NULL, NULL, NULL, 1), ED_E_ARGUMENT, "term");
  CHECK_INT(add_channel(analysis, ED_FIBRE_STRAIN, 0, 47), 0); /* 4 points of 12 layers */
  CHECK_INT(add_channel(analysis, ED_SECTION_FORCE, 2, 7), 1);
  REFUSED(ed_channel_root(analysis, 2, 0, 1), ED_E_ID, "channel 2"); /* itself */
  REFUSED(ed_channel_root(analysis, 0, -1, 1), ED_E_ID, "channel -1");
  CHECK_INT(ed_channel_root(analysis, 0, 1, 0), 2);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(ed_run_advance(analysis, 1), ED_OK);
  REFUSED(add_channel(analysis, ED_DISPLACEMENT, 2, 0), ED_E_STATE, "channels");
  REFUSED(ed_channel_root(analysis, 0, 1, 0), ED_E_STATE, "channels");
  ed_run_end(analysis);
  ed_clear_channels(analysis);
}

static void check_runs(ed_analysis *analysis)
{
  const double ground[3] = {0.0, 1.0, 0.0}, broken[3] = {0.0, NAN, 0.0}, flat[] = {0.5, 0.0};
  const double wild[] = {1.0, 0.5, 0.5, 0.25};
  const int roof = frame_node(FRAME, 0, 1);
  REFUSED(ed_static_begin(analysis, 2, 1.0, 1), ED_E_ID, "pattern 2");
  REFUSED(ed_static_begin(analysis, LATERAL, 1.0, 0), ED_E_ARGUMENT, "0 load steps");
  REFUSED(ed_static_begin(analysis, LATERAL, NAN, 1), ED_E_ARGUMENT, "nan");
  REFUSED(ed_pushover_begin(analysis, -1, roof, 0, 0.1, 5), ED_E_ID, "pattern -1");
  REFUSED(ed_pushover_begin(analysis, LATERAL, 44, 0, 0.1, 5), ED_E_ID, "44");
  REFUSED(ed_pushover_begin(analysis, LATERAL, roof, 3, 0.1, 5), ED_E_ID, "degree 3");
  REFUSED(ed_pushover_begin(analysis, LATERAL, 0, 0, 0.1, 5), ED_E_ARGUMENT, "A0");
  REFUSED(ed_pushover_begin(analysis, LATERAL, roof, 0, 0.1, 0), ED_E_ARGUMENT, "0 steps");
  REFUSED(ed_pushover_begin(analysis, LATERAL, roof, 0, HUGE_VAL, 5), ED_E_ARGUMENT, "inf");
  REFUSED(ed_pushover_begin(analysis, GRAVITY, roof, 0, 0.1, 5), ED_E_ARGUMENT, "nodes only");
  REFUSED(ed_history_begin(analysis, 0, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_ARGUMENT, "0 steps");
  REFUSED(ed_history_begin(analysis, 2, 0.0, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_ARGUMENT, "of 0");
  REFUSED(ed_history_begin(analysis, 2, NAN, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_ARGUMENT, "nan");
  REFUSED(ed_history_begin(analysis, 2, 0.01, broken, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_NOT_FINITE, "sample 2");
  REFUSED(ed_history_begin(analysis, 2, 0.01, ground, broken, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_NOT_FINITE, "sample 2");
  REFUSED(ed_history_begin(analysis, 2, 0.01, ground, NULL, NULL, ED_NEWMARK, flat), ED_E_ARGUMENT, "parameters");
  REFUSED(ed_history_begin(analysis, 2, 0.01, ground, NULL, NULL, ED_GENERALISED_ALPHA, wild), ED_E_ARGUMENT, "parameters");
  CHECK(ed_history_begin(analysis, 2, 0.01, ground, NULL, NULL, 7, AVERAGE_ACCELERATION) < 0); /* unknown method */
  ed_run_end(analysis);
  REFUSED(ed_run_advance(analysis, 1), ED_E_STATE, "no run");
  CHECK_STATUS(ed_static_begin(analysis, LATERAL, 1.0, 1), ED_OK); /* all the same */
  CHECK_STATUS(run_to_end(analysis, 1), ED_OK);
}

static void check_without_mass(void)
{
  const double EA = 1e9, EI = 1e8, ground[2] = {0.0, 1.0};
  ed_model *model = ed_model_new(2);
  ed_model_elastic_section(model, (double[]){EA, EI});
  ed_model_node(model, "base", (double[]){0.0, 0.0});
  ed_model_node(model, "top", (double[]){0.0, 3.0});
  ed_model_fix(model, 0, (int[]){1, 1, 1});
  ed_model_elastic_beam(model, "post", 0, 1, 0, ED_LINEAR, NULL, NULL);
  const int empty = ed_model_pattern(model);
  ed_analysis *analysis = frame_analysis(model);
  REFUSED(ed_history_begin(analysis, 1, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
          ED_E_ARGUMENT, "mass");
  REFUSED(ed_pushover_begin(analysis, empty, 1, 0, 0.1, 1), ED_E_ARGUMENT, "no load");
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model);
  check_settings(analysis);
  check_modal(analysis);
  check_channels(analysis);
  check_runs(analysis);
  ed_analysis_free(analysis);
  ed_model_free(model);
  check_without_mass();
  return checks_end("refusals of an analysis");
}
