/* Long calls end when they are asked to, in the thread of the caller, and a run goes on behind it to the same bits. The works are so
 * large that none of them would end within the time after which it is asked for the first time. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"
#include "in_series.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
  int asked, answer;
} wish;

static int answer(void *data)
{
  wish *own = data;
  own->asked++;
  return own->answer;
}

static int every_second(void *data)
{
  return ++((wish *)data)->asked % 2;
}

enum { LONG = 2000000, PERIODS = 2000 };

static void check_spectra(const double *a)
{
  static double period[PERIODS], damping[PERIODS], sd[PERIODS];
  wish own = {.answer = 1};
  const ed_stop stop = {answer, &own};
  for (int i = 0; i < PERIODS; i++)
    period[i] = 1.0, damping[i] = 0.05;
  CHECK_STATUS(ed_response_spectrum(LONG, 0.01, a, PERIODS, period, damping, sd, NULL, NULL, &stop), ED_E_STOPPED);
  CHECK_INT(own.asked, 1);
  double *rotated = malloc((size_t)PERIODS * ED_MAX_ANGLES * sizeof *rotated);
  CHECK_STATUS(ed_rotated_spectrum(LONG, 0.01, a, a, PERIODS, period, damping, ED_MAX_ANGLES, rotated, &stop), ED_E_STOPPED);
  CHECK_INT(own.asked, 2);
  free(rotated);
  /* a short call is not asked */
  CHECK_STATUS(ed_response_spectrum(100, 0.01, a, 1, period, damping, sd, NULL, NULL, &stop), ED_OK);
  CHECK_INT(own.asked, 2);
}

static void check_peaks(const double *a)
{
  enum { M = 800, MOST = 20000 };
  double *b = calloc(3 * M, sizeof *b), *d = calloc(2 * M, sizeof *d), *place = malloc(2 * M * MOST * sizeof *place);
  static int count[M];
  wish own = {.answer = 1};
  const ed_stop stop = {answer, &own};
  for (int i = 0; i < M; i++)
    b[3 * i] = 1.0;
  CHECK_STATUS(ed_recursion_peaks(LONG, a, M, b, d, 0.0, MOST, count, place, place + M * MOST, &stop), ED_E_STOPPED);
  CHECK_INT(own.asked, 1);
  free(b);
  free(d);
  free(place);
}

static ed_damper *damper(int law, int n, const double *parameters, double brace, const ed_stop *stop)
{
  int status;
  char message[256];
  ed_damper *new = ed_damper_new(law, n, parameters, brace, 0.0, &status, message, 256);
  CHECK_STATUS(status, ED_OK);
  ed_damper_ask(new, stop);
  return new;
}

/* Exact steps, SUNDIALS, in series with a rig; nobody to ask, or the answer 0, changes nothing. */
static void check_dampers(const double *a)
{
  static const double mgmm[] = {0.515e6, 15.1e3, 0.107e6, 20974.0, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
  static const double power[] = {300e3, 0.35, 40e6};
  const ed_rig rig = {.stiffness = 1e8, .back = 1.0, .power = 1.0};
  double *time = malloc(4 * (size_t)LONG * sizeof *time), *v = time + LONG, *force = v + LONG, *own_u = force + LONG;
  int done;
  wish own = {.answer = 1};
  const ed_stop stop = {answer, &own};
  for (int i = 0; i < LONG; i++)
    time[i] = 0.01 * i, v[i] = 0.0;
  ed_damper *exact = damper(ED_LAW_MGMM, 12, mgmm, 1e8, &stop), *ode = damper(ED_LAW_MAXWELL_POWER, 3, power, 0.0, &stop);
  ed_damper *bare = damper(ED_LAW_MGMM, 12, mgmm, 0.0, &stop);
  CHECK_STATUS(ed_damper_history(exact, ED_DAMPER_BEST, 1e-6, LONG, time, a, v, force, &done), ED_E_STOPPED);
  CHECK(done > 0 && done < LONG);
  CHECK_STATUS(ed_damper_history(ode, ED_DAMPER_BEST, 1e-6, LONG, time, a, v, force, &done), ED_E_STOPPED);
  CHECK(done > 0 && done < LONG);
  CHECK_STATUS(history_in_series(bare, ED_DAMPER_BEST, 1e-6, LONG, time, a, v, NULL, NULL, NULL, &rig, force, own_u, &done), ED_E_STOPPED);
  CHECK(done > 0 && done < LONG);
  CHECK_INT(own.asked, 3);
  enum { SHORT = 1000, SHORT_TESTS = LONG / SHORT }; /* none of which lasts long enough to be asked about */
  ed_test *test = calloc(SHORT_TESTS, sizeof *test);
  ed_campaign_end end;
  for (int i = 0; i < SHORT_TESTS; i++)
    test[i] = (ed_test){.n = SHORT, .time = time, .u = a, .v = v};
  CHECK_STATUS(ed_damper_campaign(1, (const ed_damper *const *)&exact, SHORT_TESTS, test, ED_DAMPER_BEST, 1e-6, 0, force, NULL, &end), ED_E_STOPPED);
  CHECK(end.status == ED_E_STOPPED && end.test > 0 && isnan(force[LONG - 1]));
  CHECK_INT(own.asked, 4);
  free(test);
  enum { SOME = 20000 };
  own.answer = 0;
  CHECK_STATUS(ed_damper_history(exact, ED_DAMPER_BEST, 1e-6, SOME, time, a, v, force, &done), ED_OK);
  ed_damper_ask(exact, NULL);
  CHECK_STATUS(ed_damper_history(exact, ED_DAMPER_BEST, 1e-6, SOME, time, a, v, own_u, &done), ED_OK);
  CHECK_SAME(own_u, force, SOME);
  free(time);
  ed_damper_free(exact);
  ed_damper_free(ode);
  ed_damper_free(bare);
}

/* A yielding frame with dampers, left wherever it is asked, and taken up again. */
static void check_run(void)
{
  enum { N = 2000 };
  const frame_options frame = {.bays = 2, .storeys = 3, .points = 5, .geometry = ED_P_DELTA};
  static double ground[N + 1];
  double *state[2];
  ground_motion(N, 0.01, 9.0, ground);
  ed_model *model = frame_model(frame);
  add_dampers(model, frame);
  wish own = {0};
  const ed_stop stop = {every_second, &own};
  int stops = 0;
  for (int k = 0; k < 2; k++) {
    ed_analysis *a = frame_analysis(model);
    CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 2), ED_OK);
    CHECK_STATUS(run_to_end(a, 2), ED_OK);
    CHECK_STATUS(ed_install_dampers(a), ED_OK);
    ed_analysis_ask(a, k ? &stop : NULL);
    CHECK_STATUS(ed_history_begin(a, N, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
    int status, before = -1;
    do {
      status = ed_run_advance(a, N);
      stops += status == ED_E_STOPPED;
      CHECK(status != ED_E_STOPPED || ed_run_steps_done(a) >= before);
      before = ed_run_steps_done(a);
    } while (status == ED_E_STOPPED);
    CHECK_STATUS(status, ED_OK);
    ed_run_end(a);
    state[k] = malloc((size_t)ed_state_size(a) * sizeof **state);
    ed_state_get(a, state[k]);
    if (k)
      CHECK_SAME(state[1], state[0], ed_state_size(a));
    ed_analysis_free(a);
  }
  CHECK(stops > 0);
  free(state[0]);
  free(state[1]);
  ed_model_free(model);
}

int main(void)
{
  double *a = malloc((size_t)LONG * sizeof *a);
  numbers source = {5};
  for (int i = 0; i < LONG; i++)
    a[i] = next_number(&source, -0.01, 0.01);
  check_spectra(a);
  check_peaks(a);
  check_dampers(a);
  check_run();
  free(a);
  return checks_end("stop");
}
