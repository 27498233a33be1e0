/* A step that was tried and given up leaves nothing behind, bit for bit; runs can be stopped, fail and be followed by
 * others. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 120 };
static const double DT = 0.02;
static const frame_options FRAME = {.bays = 1, .storeys = 2, .points = 5, .geometry = ED_P_DELTA};

typedef enum { STATIC, PUSHOVER, HISTORY } run_kind;

static int begin(ed_analysis *analysis, run_kind kind, const double *ground)
{
  switch (kind) {
    case STATIC:
      return ed_static_begin(analysis, LATERAL, 80.0, N);
    case PUSHOVER:
      return ed_pushover_begin(analysis, LATERAL, frame_node(FRAME, 0, 2), 0, 0.3, N);
    default:
      return ed_history_begin(analysis, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION);
  }
}

static void same_state(const ed_analysis *a, const ed_analysis *b)
{
  const int n = ed_state_size(a);
  CHECK_INT(ed_state_size(b), n);
  double *of_a = malloc((size_t)n * sizeof *of_a), *of_b = malloc((size_t)n * sizeof *of_b);
  ed_state_get(a, of_a);
  ed_state_get(b, of_b);
  CHECK_SAME(of_b, of_a, n);
  free(of_a);
  free(of_b);
}

static void under_gravity(ed_analysis *analysis, int damping, int reuse)
{
  CHECK_STATUS(ed_set(analysis, ED_REUSE_FACTORS, reuse), ED_OK);
  CHECK_STATUS(ed_rayleigh(analysis, 0.2, 0.002, damping), ED_OK);
  CHECK_STATUS(ed_static_begin(analysis, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(analysis, 2), ED_OK);
}

static void check_tries(run_kind kind, int damping, int reuse)
{
  static const double fractions[] = {1.0, 0.5, 0.125, 1.0};
  double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *straight = frame_analysis(model), *hesitant = frame_analysis(model);
  under_gravity(straight, damping, reuse);
  under_gravity(hesitant, damping, reuse);
  CHECK_STATUS(begin(straight, kind, ground), ED_OK);
  CHECK_STATUS(begin(hesitant, kind, ground), ED_OK);
  for (int i = 0; i < N; i++) {
    for (int k = 0; k <= i % 3; k++) {
      ed_try_and_revert(hesitant, fractions[(i + k) % 4]);
      same_state(straight, hesitant);
    }
    CHECK_STATUS(ed_run_advance(straight, 1), ED_OK);
    CHECK_STATUS(ed_run_advance(hesitant, 1), ED_OK);
    same_state(straight, hesitant);
  }
  CHECK_STATUS(ed_try_and_revert(hesitant, 1.0), ED_E_STATE); /* there is no next step */
  ed_run_end(straight);
  ed_run_end(hesitant);
  same_state(straight, hesitant);
  ed_analysis_free(straight);
  ed_analysis_free(hesitant);
  ed_model_free(model);
}

/* A run that fails leaves the last good state, can be ended, and what follows is as if it had not been. */
static void check_failure(run_kind next)
{
  double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *straight = frame_analysis(model), *failed = frame_analysis(model);
  under_gravity(straight, ED_STIFFNESS_CURRENT, 1);
  under_gravity(failed, ED_STIFFNESS_CURRENT, 1);
  const int reaction = add_channel(failed, ED_REACTION, 0, 1), force = add_channel(failed, ED_GLOBAL_FORCE, 0, 4);
  const int equal = add_channel(straight, ED_REACTION, 0, 1);
  CHECK_INT(reaction, equal);
  add_channel(straight, ED_GLOBAL_FORCE, 0, 4);
  CHECK_STATUS(ed_static_begin(failed, LATERAL, 1e4, 1), ED_OK); /* far beyond collapse */
  const int status = ed_run_advance(failed, 1);
  CHECK(status == ED_E_NOT_CONVERGED || status == ED_E_SINGULAR || status == ED_E_ELEMENT);
  CHECK(strlen(ed_analysis_message(failed)) > 20);
  CHECK(ed_n_events(failed) > 0);
  CHECK_INT(ed_run_steps_done(failed), 0);
  ed_event event;
  ed_get_event(failed, ed_n_events(failed) - 1, &event);
  CHECK(event.step == 1 && event.fallback >= ED_FALLBACK_FULL_NEWTON && event.fallback <= ED_FALLBACK_HALVE && event.level <= 8);
  CHECK_STATUS(ed_run_advance(failed, 1), ED_E_STATE);
  CHECK_CONTAINS(ed_analysis_message(failed), "failed");
  CHECK_STATUS(ed_static_begin(failed, LATERAL, 1.0, 1), ED_E_STATE); /* not before it is ended */
  ed_run_end(failed);
  CHECK_STATUS(ed_static_begin(straight, LATERAL, 1.0, 1), ED_OK); /* a beginning sets the abscissa */
  ed_run_end(straight);
  same_state(straight, failed);

  static double rows[2 * (N + 1)], expected[2 * (N + 1)];
  CHECK_STATUS(begin(straight, next, ground), ED_OK);
  CHECK_STATUS(begin(failed, next, ground), ED_OK);
  ed_run_buffers(straight, 1, NULL, expected, NULL);
  ed_run_buffers(failed, 1, NULL, rows, NULL);
  CHECK_STATUS(ed_run_advance(straight, N), ED_OK);
  CHECK_STATUS(ed_run_advance(failed, N), ED_OK);
  CHECK_SAME(rows, expected, 2); /* the first row shows the restored state, not the failed attempt */
  CHECK_SAME(rows, expected, 2 * (N + 1));
  same_state(straight, failed);
  CHECK(force > reaction);
  ed_analysis_free(straight); /* in the middle of a run */
  ed_analysis_free(failed);
  ed_model_free(model);
}

/* In the middle of a history, with numbers that overflow. */
static void check_failure_in_a_history(void)
{
  double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ground[60] = 1e200;
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model), *straight = frame_analysis(model);
  under_gravity(analysis, ED_STIFFNESS_INITIAL, 1);
  under_gravity(straight, ED_STIFFNESS_INITIAL, 1);
  ed_set(analysis, ED_HALVINGS, 2);
  ed_set(straight, ED_HALVINGS, 2);
  CHECK_STATUS(begin(analysis, HISTORY, ground), ED_OK);
  CHECK_STATUS(begin(straight, HISTORY, ground), ED_OK);
  CHECK(ed_run_advance(analysis, N) < 0);
  CHECK_INT(ed_run_steps_done(analysis), 59);
  CHECK_STATUS(ed_run_advance(straight, 59), ED_OK);
  same_state(straight, analysis);
  CHECK_CONTAINS(ed_analysis_message(analysis), "step 60");
  ed_run_end(analysis);
  ed_analysis_free(analysis);
  ed_analysis_free(straight);
  ed_model_free(model);
}

static void check_pieces_and_stops(void)
{
  double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *whole = frame_analysis(model), *pieces = frame_analysis(model);
  under_gravity(whole, ED_STIFFNESS_INITIAL, 1);
  under_gravity(pieces, ED_STIFFNESS_INITIAL, 1);
  begin(whole, HISTORY, ground);
  begin(pieces, HISTORY, ground);
  CHECK_STATUS(ed_run_advance(whole, 1000), ED_OK);
  CHECK_INT(ed_run_steps_done(whole), N);
  for (int i = 0; i < N; i += 7)
    CHECK_STATUS(ed_run_advance(pieces, 7), ED_OK);
  same_state(whole, pieces);
  ed_run_end(whole);
  ed_run_end(pieces);
  /* stopped early, ended, another run after it */
  begin(pieces, PUSHOVER, ground);
  CHECK_STATUS(ed_run_advance(pieces, 3), ED_OK);
  CHECK_STATUS(ed_set(pieces, ED_TOLERANCE, 1e-5), ED_E_STATE);
  ed_run_end(pieces);
  ed_run_end(pieces); /* twice does no harm */
  CHECK_STATUS(ed_run_advance(pieces, 1), ED_E_STATE);
  CHECK_STATUS(ed_try_and_revert(pieces, 1.0), ED_E_STATE);
  CHECK_STATUS(ed_set(pieces, ED_TOLERANCE, 1e-6), ED_OK);
  CHECK_STATUS(begin(pieces, HISTORY, ground), ED_OK);
  CHECK_STATUS(run_to_end(pieces, N), ED_OK);
  ed_analysis_free(whole);
  ed_analysis_free(pieces);
  ed_model_free(model);
}

/* A state taken and set again later gives the same run once more. */
static void check_state_set(void)
{
  double ground[N + 1];
  ground_motion(N, DT, 9.0, ground);
  ed_model *model = frame_model(FRAME);
  ed_analysis *analysis = frame_analysis(model);
  under_gravity(analysis, ED_STIFFNESS_INITIAL, 0);
  const int n = ed_state_size(analysis);
  double *start = malloc((size_t)n * sizeof *start), *first = malloc((size_t)n * sizeof *first);
  double *second = malloc((size_t)n * sizeof *second);
  ed_state_get(analysis, start);
  begin(analysis, HISTORY, ground);
  CHECK_STATUS(ed_state_set(analysis, start), ED_E_STATE);
  CHECK_STATUS(run_to_end(analysis, N), ED_OK);
  ed_state_get(analysis, first);
  CHECK(memcmp(first, start, (size_t)n * sizeof *start) != 0);
  CHECK_STATUS(ed_state_set(analysis, start), ED_OK);
  begin(analysis, HISTORY, ground);
  CHECK_STATUS(run_to_end(analysis, N), ED_OK);
  ed_state_get(analysis, second);
  CHECK_SAME(second, first, n);
  free(start);
  free(first);
  free(second);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  for (int kind = STATIC; kind <= HISTORY; kind++)
    for (int damping = ED_STIFFNESS_INITIAL; damping <= (kind == HISTORY ? ED_STIFFNESS_CURRENT : 0); damping++)
      for (int reuse = 0; reuse < 2; reuse++)
        check_tries((run_kind)kind, damping, reuse);
  check_failure(STATIC);
  check_failure(PUSHOVER);
  check_failure(HISTORY);
  check_failure_in_a_history();
  check_pieces_and_stops();
  check_state_set();
  return checks_end("reverting and following runs");
}
