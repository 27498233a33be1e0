/* One test of a damper at a time: its force under samples of a motion, from rest or from what the test before left in the specimen. */
#ifndef ED_RUN_OF_TEST_H
#define ED_RUN_OF_TEST_H

#include "damper/stepper.h"

#define ED_SERIES_TOLERANCE 1e-8 /* of SUNDIALS, in series with a rig */

/* What the law alone carries in all tests of a campaign, step by step: dampers that differ in their effects have it in common. */
typedef struct {
  double *force;
  size_t at; /* the next step */
  int known; /* else it is written */
} ed_law_forces;

typedef struct {
  ed_stepper stepper;
  int method;
  double fineness;
  ed_watch *watch;
  double *room;            /* of all states; owned */
  double *state, *trial;   /* `state` is that at the last sample when a history ends */
  int keeps_law;           /* whether a law keeps extremes of the test before */
  double *before;          /* the state at the end of the test before, or NULL: a new specimen */
  double rest;             /* s between that and the first sample */
  ed_law_forces *law;      /* of histories without rig, or NULL; for dampers of which ed_test_run_shares_law says that they have such */
} ed_test_run;

/* Close it in any case. */
int ed_test_run_open(ed_test_run *run, const ed_damper *damper, int method, double fineness, ed_watch *watch);
/* Another fineness from here on. */
int ed_test_run_tune(ed_test_run *run, double fineness);
/* Another damper of the same law and effects from here on; ED_E_ARGUMENT if it is none. */
int ed_test_run_exchange(ed_test_run *run, const ed_damper *damper);
void ed_test_run_close(ed_test_run *run);
/* The test is over, and the next one of the same specimen is to begin after a rest (s). */
void ed_test_run_carry(ed_test_run *run, double rest);
/* `state` at rest, with what the law keeps of `before`. */
void ed_test_run_begin(ed_test_run *run);

/* From the state at rest: held at the first deformation, to which it comes in a time `slowly`, then the jump to the first velocity: a step
 * of no deformation. force: one, before the first step. Of dampers with an exact step. */
int ed_test_run_hold(ed_test_run *run, int n, const double *time, const double *u, const double *v, double slowly, double *force);

/* Whether a damper with effects, which moves by the exact step of its law, has the same force of the law as another one in every
 * test that does not begin with what the law kept of the one before. */
int ed_test_run_shares_law(const ed_damper *one, const ed_damper *other);

/* `trial` becomes the state. */
static inline void ed_test_run_accept(ed_test_run *run)
{
  double *swap = run->state;
  run->state = run->trial;
  run->trial = swap;
}

/* ED_OK if n >= 1 samples are finite and their times ascend; *done: those that are well when they are not, else 0. */
int ed_check_samples(int n, const double *time, const double *u, const double *v, int *done);
/* The same of a test, and whether its rig is allowed. */
int ed_check_test(const ed_test *test, int *done);

/* ed_damper_history. */
int ed_test_run_history(ed_test_run *run, int n, const double *time, const double *u, const double *v, double *force, int *done);
/* A test with a rig. */
int ed_test_run_in_series(ed_test_run *run, const ed_test *test, double *force, double *own, int *done);

#endif
