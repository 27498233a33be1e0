/* Models and analyses are made, used and freed many times in every order: what leaks or is used after its end shows
 * under valgrind and the sanitizers. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <stdlib.h>

enum { N = 20, LOOPS = 50 };
static const frame_options FRAME = {.bays = 1, .storeys = 2, .points = 4, .geometry = ED_P_DELTA};

static void damp_modes(ed_analysis *analysis)
{
  const int n = ed_n_equations(analysis);
  const double omega[] = {10.0, 40.0}, ratio[] = {0.02, 0.03};
  double *shape = calloc(2 * (size_t)n, sizeof *shape);
  for (int i = 0; i < 2 * n; i++)
    shape[i] = i < n ? 1.0 : (i % 2 ? 1.0 : -1.0);
  CHECK_STATUS(ed_modal_damping(analysis, 2, shape, omega, ratio), ED_OK);
  CHECK_STATUS(ed_modal_damping(analysis, 1, shape, omega, ratio), ED_OK); /* replaces the first */
  free(shape);
}

static void use(ed_analysis *analysis, int how)
{
  double ground[N + 1], rows[2 * (N + 1)], energy[(N + 1) * ED_N_ENERGY];
  ground_motion(N, 0.02, 5.0, ground);
  add_channel(analysis, ED_DISPLACEMENT, 4, 0);
  add_channel(analysis, ED_FIBRE_STRESS, 0, 3);
  if (how % 3 == 1)
    damp_modes(analysis);
  if (how % 4 == 3) {
    ed_clear_channels(analysis);
    add_channel(analysis, ED_VELOCITY, 4, 0);
    add_channel(analysis, ED_SECTION_FORCE, 1, 1);
  }
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 2), ED_OK);
  const double *vertical = how % 2 ? ground : NULL;
  CHECK_STATUS(ed_history_begin(analysis, N, 0.02, ground, vertical, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(analysis, 1, NULL, rows, energy);
  CHECK_STATUS(ed_run_advance(analysis, how % 5 == 4 ? N / 2 : N), ED_OK);
  if (how % 2 == 0)
    ed_run_end(analysis);
  CHECK_STATUS(ed_history_begin(analysis, N, -1.0, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION),
               how % 2 ? ED_E_STATE : ED_E_ARGUMENT);
}

/* Structures that are refused free what they had built. */
static void refused(int how)
{
  ed_model *model = frame_model(FRAME);
  char message[64];
  int status;
  if (how % 2)
    ed_model_node(model, "loose", (double[]){99.0, 0.0});
  else {
    const int tip = ed_model_node(model, "tip", (double[]){20.0, 7.0});
    const int material = 0;
    ed_model_truss(model, "bar", frame_node(FRAME, 1, 2), tip, material, 0.01, ED_LINEAR);
  }
  CHECK(!ed_analysis_new(model, &status, message, sizeof message));
  CHECK_STATUS(status, how % 2 ? ED_E_DISCONNECTED : ED_E_MECHANISM);
  ed_model_free(model);
}

int main(void)
{
  for (int i = 0; i < LOOPS; i++) {
    ed_model *model = frame_model(FRAME);
    ed_analysis *first = frame_analysis(model), *second = i % 2 ? frame_analysis(model) : NULL;
    use(first, i);
    if (second)
      use(second, i + 1);
    ed_analysis_free(first);
    ed_analysis_free(second);
    ed_model_free(model);
    refused(i);
  }
  return checks_end("lifetime");
}
