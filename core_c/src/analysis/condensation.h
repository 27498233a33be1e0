/* The frame condensed to the deformations of its dampers. */
#ifndef ED_CONDENSATION_H
#define ED_CONDENSATION_H

#include "analysis/equilibrium.h"

typedef struct {
  double *response;              /* n_devices x n: A^-1 b of the factors; NULL: condensation would cost more than it saves */
  double *flexibility;           /* n_devices x n_devices: b' A^-1 b */
  double *balance;               /* n_devices x n_devices: factors of the balance at the dampers */
  int *pivot;
  double *work;                  /* 8 n_devices */
  int known;                     /* response and flexibility of the present factors */
} ed_condensation;

int ed_condensation_allocate(ed_analysis *a);
void ed_condensation_free(ed_condensation *condensation);
int ed_condenses(const ed_analysis *a, int fallback);   /* whether dampers are balanced with the condensed frame */
double ed_condensation_flops(const ed_analysis *a); /* that come to a factorisation */
double ed_iteration_flops(const ed_analysis *a);    /* of an iteration of the frame */
/* Moves the trial state by the solution in `du`, with the dampers in balance and at their new states. first: of the step. */
int ed_move_condensed(ed_analysis *a, const ed_step *step, int first);
void ed_follow_pace(const ed_analysis *a, double *du); /* from the committed state, on as in the last two steps */

#endif
