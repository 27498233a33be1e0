/* No allocation inside a step: while a yielding frame is advanced, nothing calls malloc, calloc, realloc or free. This
 * program takes their place (glibc only); with a sanitizer or valgrind, which do the same, it says that it did not
 * look. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void __libc_free(void *block);

static volatile int counting;
static volatile long calls;

/* visible, so that the libraries call these too */
#define VISIBLE __attribute__((visibility("default")))

VISIBLE void *malloc(size_t size)
{
  calls += counting;
  return __libc_malloc(size);
}

VISIBLE void *calloc(size_t count, size_t size)
{
  calls += counting;
  return __libc_calloc(count, size);
}

VISIBLE void *realloc(void *block, size_t size)
{
  calls += counting;
  return __libc_realloc(block, size);
}

VISIBLE void free(void *block)
{
  calls += counting;
  __libc_free(block);
}

enum { N = 400 };
static const frame_options FRAME = {.bays = 2, .storeys = 3, .points = 5, .geometry = ED_P_DELTA};

/* 0 when another program owns malloc after all, as valgrind does. */
static int in_place(void)
{
  counting = 1;
  ed_model_free(ed_model_new(2));
  counting = 0;
  return calls > 0;
}

/* Calls of the solver's library are seen as well. */
static void check_counter(void)
{
  ed_model *model = frame_model(FRAME);
  calls = 0;
  counting = 1;
  ed_analysis *analysis = frame_analysis(model);
  counting = 0;
  CHECK(calls > 40);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

static long calls_while(ed_analysis *analysis, int steps)
{
  CHECK_STATUS(ed_run_advance(analysis, 1), ED_OK); /* the first step may make itself at home */
  calls = 0;
  counting = 1;
  const int status = ed_run_advance(analysis, steps - 1);
  counting = 0;
  CHECK_STATUS(status, ED_OK);
  return calls;
}

static void check_runs(int damping)
{
  static double ground[N + 1], rows[2 * (N + 1)], energy[(N + 1) * ED_N_ENERGY];
  ed_statistics statistics;
  ground_motion(N, 0.01, 9.0, ground);
  const double mgmm[] = {515e3, 15.1e3, 107e3, 21e3, 0.374, 3741e3, 3613e3, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0}, one = 1.0;
  const int top = frame_node(FRAME, 0, 1), along = 0;
  ed_model *model = frame_model(FRAME);
  CHECK_INT(ed_model_damper(model, "damper", ED_LAW_MGMM, 12, mgmm, 0.0, 0.0, 1.0, 1.0, 1, &top, &along, &one), 0);
  ed_analysis *analysis = frame_analysis(model);
  add_channel(analysis, ED_DISPLACEMENT, frame_node(FRAME, 0, 3), 0);
  add_channel(analysis, ED_FIBRE_STRESS, 0, 0);
  CHECK_STATUS(ed_rayleigh(analysis, 0.2, 0.002, damping), ED_OK);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 5), ED_OK);
  CHECK_INT(calls_while(analysis, 5), 0);
  ed_run_end(analysis);
  CHECK_STATUS(ed_install_dampers(analysis), ED_OK);
  CHECK_STATUS(ed_history_begin(analysis, N, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  ed_run_buffers(analysis, 1, NULL, rows, energy);
  CHECK_INT(calls_while(analysis, N), 0);
  ed_get_statistics(analysis, &statistics);
  CHECK(statistics.refactorisations > 10); /* it did yield and the factors did change */
  CHECK(energy[N * ED_N_ENERGY + ED_HYSTERETIC] > 0.0);
  ed_run_end(analysis);
  CHECK_STATUS(ed_pushover_begin(analysis, LATERAL, frame_node(FRAME, 0, 3), 0, 0.5, 50), ED_OK);
  CHECK_INT(calls_while(analysis, 50), 0);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Nor do dampers, of any law, with a brace or without, nor SUNDIALS for them. */
static void check_dampers(void)
{
  static double ground[N + 1];
  ground_motion(N, 0.01, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  add_dampers(model, FRAME);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_STATUS(ed_install_dampers(analysis), ED_OK);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 5), ED_OK);
  CHECK_INT(calls_while(analysis, 5), 0);
  ed_run_end(analysis);
  CHECK_STATUS(ed_install_dampers(analysis), ED_OK);
  CHECK_STATUS(ed_history_begin(analysis, N, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_INT(calls_while(analysis, N), 0);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Steps that need fallbacks allocate nothing either. */
static void check_fallbacks(void)
{
  double ground[41];
  ground_motion(40, 0.05, 15.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model);
  ed_rayleigh(analysis, 0.2, 0.002, ED_STIFFNESS_CURRENT);
  ed_set(analysis, ED_MAX_ITERATIONS, 4);
  CHECK_STATUS(ed_history_begin(analysis, 40, 0.05, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_INT(calls_while(analysis, 40), 0);
  CHECK(ed_n_events(analysis) > 0);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

/* Calls of a substructure test of n main steps with a frame that yields. */
static long calls_of_test(ed_substructure *test, int n, const double *ground, double *record)
{
  int done;
  calls = 0;
  counting = 1;
  const int status = ed_substructure_run(test, n, ground, 0, record, &done);
  counting = 0;
  CHECK_STATUS(status, ED_OK);
  return calls;
}

/* A test with a frame allocates when it begins, whatever its length. */
static void check_frame_in_loop(void)
{
  static double ground[N + 1], record[(N + 1) * ED_RTS_CHANNELS];
  static ed_compensator_parameters compensator = {.step = 0.01, .n_terms = 1, .term = {{.coefficient = 1.0}}};
  static const ed_rig_model rig = {.d = 1.0, .stroke = INFINITY, .velocity = INFINITY, .force = INFINITY};
  const ed_sensors sensors = {.displacement_range = INFINITY, .force_range = INFINITY};
  const double law[] = {2e6, 0.0}, along[] = {1.0, -1.0};
  const int node[] = {frame_node(FRAME, 0, 1), frame_node(FRAME, 0, 0)}, degree[] = {0, 0};
  int status;
  char message[256];
  ground_motion(N, 0.01, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model);
  ed_rayleigh(analysis, 0.2, 0.002, ED_STIFFNESS_CURRENT);
  ed_damper *specimen = ed_damper_new(ED_LAW_KELVIN_VOIGT, 2, law, 0.0, 0.0, &status, message, sizeof message);
  const ed_frame_part frame = {.analysis = analysis, .divisions = 1, .method = ED_NEWMARK, .parameters = {0.5, 0.25}, .n_terms = 2,
                               .node = node, .degree = degree, .coefficient = along};
  const ed_substructure_input input = {.step = 0.01, .sub_steps = 1, .compensator = &compensator, .rig = &rig, .sensors = &sensors,
                                       .specimen = specimen, .force_scale = 1.0, .deformation_scale = 1.0,
                                       .abort_displacement = INFINITY, .frame = &frame};
  ed_substructure *test = ed_substructure_new(&input, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  calls_of_test(test, N, ground, record); /* the solver makes itself at home */
  const long of_one = calls_of_test(test, 1, ground, record);
  CHECK_INT(calls_of_test(test, N, ground, record), of_one);
  ed_substructure_free(test);
  ed_damper_free(specimen);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  if (!in_place()) {
    printf("allocation inside a step: not counted in this run (another program owns malloc)\n");
    return 0;
  }
  check_counter();
  check_runs(ED_STIFFNESS_INITIAL);
  check_runs(ED_STIFFNESS_CURRENT);
  check_dampers();
  check_fallbacks();
  check_frame_in_loop();
  return checks_end("allocation inside a step");
}

#else

int main(void)
{
  printf("allocation inside a step: not counted in this build (a sanitizer or another C library owns malloc)\n");
  return 0;
}

#endif
