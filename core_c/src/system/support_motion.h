/* Supported degrees that move in a history. */
#ifndef ED_SUPPORT_MOTION_H
#define ED_SUPPORT_MOTION_H

#include "edcore.h"

typedef struct {
  int support;
  double origin;                 /* where it was when the history began */
  double *displacement, *velocity, *acceleration; /* n+1 samples of the history, one block */
  double *shape;                 /* n: the structure that follows it slowly, by the tangent at the start */
} ed_support_motion;


void ed_move_supports(ed_analysis *a, double position);  /* of the trial state, to a position in the whole step */
/* Takes away from a vector over n equations what follows supports slowly. */
void ed_subtract_slow_motion(const ed_run *run, int n, const double *of_supports, double *vector);
double ed_support_work(const ed_analysis *a, double *damping); /* over the substep; *damping: what damping forces take of it */
void ed_free_support_motions(ed_run *run);

#endif
