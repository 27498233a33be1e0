/* Linear viscoelastic laws as Prony series: F = k u + c v + sum q_i, q_i' = k_i v - r_i q_i. */
#ifndef ED_PRONY_H
#define ED_PRONY_H

#include "damper/law.h"

typedef struct {
  double spring, dashpot;
  int branches;
  double rate[ED_MAX_ODE], stiffness[ED_MAX_ODE]; /* r_i, k_i */
} ed_prony;

/* To be called at the end of a law's `prepare`: keeps the series in the damper. */
int ed_prony_prepare(ed_damper *damper, const ed_prony *series, char message[ED_DAMPER_MESSAGE]);
/* Common to all laws that end their `prepare` so. */
int ed_prony_step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out);
/* The spring that carries the force at rest: the first parameter of laws that have one. */
void ed_prony_without_dashpots(ed_damper *damper);
void ed_prony_rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out);

#endif
