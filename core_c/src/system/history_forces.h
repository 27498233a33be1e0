/* Forces on a frame during a history that the caller gives from step to step; without a history there are none. */
#ifndef ED_HISTORY_FORCES_H
#define ED_HISTORY_FORCES_H

#include "system/model.h"
#include "system/numbering.h"

/* A force of a history, along its degrees. What acts on fixed ones goes into their reactions and does no work. */
typedef struct {
  int n_terms, equation[ED_MAX_TERMS];
  double coefficient[ED_MAX_TERMS];
  int n_fixed, fixed[ED_MAX_TERMS]; /* over all degrees */
  double fixed_coefficient[ED_MAX_TERMS];
  double origin;                 /* displacement along it when it was made */
  double last;                   /* at the end of the last whole step */
  double start, end;             /* of the present whole step; accelerations are those with `start` */
  double before, now;            /* of the present substep */
  double before_without_mass;    /* what degrees without mass are in balance with when it begins */
} ed_history_load;

typedef struct ed_run ed_run;

void ed_move_history_forces(ed_run *run, double from, double to); /* to a substep between two positions in the whole step */
void ed_finish_history_forces(ed_run *run);                       /* the whole step is done: they stay as they are at its end */
/* Adds them to r, weighted between the ends of the substep. */
void ed_add_history_forces(const ed_run *run, const double *mass, double share_before, double *r);
double ed_history_force_work(ed_analysis *a);                     /* over the substep; adds it to that of each force */
void ed_largest_history_force(const ed_run *run, const int *rotational, double *force, double *moment);
double ed_history_force_value(const ed_analysis *a, int kind, int force); /* as of a damper in its place; 0 of one that there is not */
double ed_history_force_on(const ed_run *run, int degree);        /* of all of them on a fixed degree */

#endif
