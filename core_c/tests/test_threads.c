/* Two analyses of one model in two threads at the same time give, bit for bit, what one after the other gives. Under
 * the thread sanitizer this shows whether anything is shared. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <pthread.h>
#include <string.h>

enum { N = 200, THREADS = 2 };
static const frame_options FRAME = {.bays = 2, .storeys = 2, .points = 5, .geometry = ED_P_DELTA};

typedef struct {
  const ed_model *model;
  double peak;               /* of the ground, so that the two do not do the same */
  int status;
  double displacement[N + 1], energy[(N + 1) * ED_N_ENERGY];
} job;

/* No checks in here: their counters belong to the main thread. */
static void *run(void *argument)
{
  job *j = argument;
  char message[128];
  const int kind = ED_DISPLACEMENT, object = frame_node(FRAME, 0, 2), component = 0;
  const double one = 1.0;
  double ground[N + 1];
  ground_motion(N, 0.01, j->peak, ground);
  ed_analysis *analysis = ed_analysis_new(j->model, &j->status, message, sizeof message);
  if (!analysis)
    return NULL;
  ed_channel(analysis, 1, &one, &kind, &object, &component, 1);
  ed_rayleigh(analysis, 0.2, 0.002, ED_STIFFNESS_CURRENT);
  if ((j->status = ed_static_begin(analysis, GRAVITY, 1.0, 2)) == ED_OK)
    j->status = ed_run_advance(analysis, 2);
  ed_run_end(analysis);
  if (j->status == ED_OK)
    j->status = ed_install_dampers(analysis);
  if (j->status == ED_OK)
    j->status = ed_history_begin(analysis, N, 0.01, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION);
  if (j->status == ED_OK) {
    ed_run_buffers(analysis, 1, NULL, j->displacement, j->energy);
    for (int i = 0; i < N && j->status == ED_OK; i += 10)
      j->status = ed_run_advance(analysis, 10);
  }
  ed_analysis_free(analysis);
  return NULL;
}

static void check_frame(int damped)
{
  static job together[THREADS], alone[THREADS];
  pthread_t thread[THREADS];
  ed_model *model = frame_model(FRAME);
  if (damped)
    add_dampers(model, FRAME);
  for (int i = 0; i < THREADS; i++) {
    together[i].model = alone[i].model = model;
    together[i].peak = alone[i].peak = 9.0 + i;
    CHECK_INT(pthread_create(&thread[i], NULL, run, &together[i]), 0);
  }
  for (int i = 0; i < THREADS; i++)
    CHECK_INT(pthread_join(thread[i], NULL), 0);
  for (int i = 0; i < THREADS; i++) {
    run(&alone[i]);
    CHECK_STATUS(together[i].status, ED_OK);
    CHECK_STATUS(alone[i].status, ED_OK);
    CHECK_SAME(together[i].displacement, alone[i].displacement, N + 1);
    CHECK_SAME(together[i].energy, alone[i].energy, (N + 1) * ED_N_ENERGY);
    CHECK(alone[i].energy[N * ED_N_ENERGY + ED_HYSTERETIC] > 0.0);
  }
  CHECK(memcmp(alone[0].displacement, alone[1].displacement, sizeof alone[0].displacement) != 0);
  for (int i = 0; damped && i < THREADS; i++)
    CHECK(alone[i].energy[N * ED_N_ENERGY + ED_DAMPERS] > 0.0);
  ed_model_free(model);
}

int main(void)
{
  check_frame(0);
  check_frame(1);
  return checks_end("two threads");
}
