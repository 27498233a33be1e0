/* Runs are begun, advanced in pieces and ended. */
#ifndef ED_RUN_H
#define ED_RUN_H

#include "system/history_forces.h"
#include "system/support_motion.h"

typedef enum { ED_RUN_NONE, ED_RUN_STATIC, ED_RUN_PUSHOVER, ED_RUN_HISTORY } ed_run_kind;

struct ed_run {
  ed_run_kind kind;
  int steps, done, row, every;
  int taken;                     /* rows that are no longer in the buffers */
  double *abscissa, *values, *energy;
  int failed;
  int limited;                   /* 1 + the channel that has exceeded its limit; 0: none */
  /* static */
  int pattern;
  double factor_start, factor_end;
  int control;                   /* equation */
  double control_start, control_end;
  /* history */
  double dt;
  double *ground[3];             /* copies, n+1 samples */
  double ground_now[3], ground_before[3]; /* of the present substep */
  double alpha_m, alpha_f, gamma, beta;
  int n_forces;
  ed_history_load force[ED_HISTORY_FORCES];
  int n_motions;
  ed_support_motion *motion;     /* of supported degrees */
};

void ed_start_run(ed_analysis *a, int kind, int steps, double abscissa);

/* One attempt at a step or a fraction of it, by kind of run: static.c, pushover.c, history.c. */
int ed_static_attempt(ed_analysis *a, double fraction, int fallback);
int ed_pushover_attempt(ed_analysis *a, double fraction, int fallback);
int ed_history_attempt(ed_analysis *a, double fraction, int fallback);

#endif
