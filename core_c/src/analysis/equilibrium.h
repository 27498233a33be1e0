/* Iterates the trial state of one (sub)step to equilibrium. */
#ifndef ED_EQUILIBRIUM_H
#define ED_EQUILIBRIUM_H

#include "edcore.h"

enum { ED_MAX_RESIDUALS = 64 };

typedef struct {
  double *r, *du, *work, *work2, *predicted; /* n */
  double *residuals;             /* of the last attempt */
  int n_residuals;
  int worst;                     /* equation of the largest unbalance */
} ed_iteration;

typedef struct ed_step {
  double k, m, c;                /* effective matrix k K + m M + c C */
  double velocity, acceleration; /* dv / du, da / du */
  void (*residual)(ed_analysis *a, const struct ed_step *step, double *r);
  /* Moves the trial state by the solution in `du` with the dampers in balance, first: of the step; NULL: it moves by the solution
   * alone, and the dampers follow. */
  int (*balance)(ed_analysis *a, const struct ed_step *step, int first);
  double ground[3], ground_before[3];
} ed_step;

int ed_iteration_allocate(ed_iteration *iteration, int n);
void ed_iteration_free(ed_iteration *iteration);
int ed_equilibrate(ed_analysis *a, const ed_step *step, int fallback);
void ed_move(ed_analysis *a, const ed_step *step, double factor, const double *du); /* trial u, v, a by factor du */
double ed_unbalance(ed_analysis *a, const double *r);  /* relative; notes the worst equation */
void ed_raise_force_level(ed_analysis *a);
double ed_rounding(ed_analysis *a);                    /* relative unbalance that rounding makes */
int ed_stalls(const ed_iteration *iteration, int number);
int ed_accept(ed_statistics *statistics, double unbalance); /* notes it; ED_OK */
int ed_last_iterations(const ed_iteration *iteration);

#endif
