/* Differential equations of dampers, integrated by SUNDIALS (ARKODE) as one system, with sensitivities.
 * Used for devices whose law has `rate` but no exact step, and to check the exact steps of others.
 * A law with memory that takes a brace has the elongation of the brace as its first variable: where its own deformation reverses is
 * found while integrating, and is an event like the reversals of the path. */
#ifndef ED_ODE_SYSTEM_H
#define ED_ODE_SYSTEM_H

#include "damper/law.h"

typedef struct ed_ode_system ed_ode_system;

/* All dampers must have `rate`. tolerance: relative, of each variable against its own size. NULL: out of memory or SUNDIALS
 * refused; *status says which. */
ed_ode_system *ed_ode_system_new(int n, const ed_damper *const *damper, double tolerance, int *status);
void ed_ode_system_free(ed_ode_system *system);
/* Whom its integration asks whether to stop: of a call, for as long as that lasts. */
void ed_ode_system_watch(ed_ode_system *system, ed_watch *watch);

/* One step of all: from committed[i] along path[i] (all of the same h) to trial[i]; out[i] as in ed_law.step. Never changes
 * `committed`; the same input gives the same output, whatever was computed before. ED_OK, ED_E_NOT_CONVERGED, ED_E_NOT_FINITE,
 * ED_E_STOPPED. */
int ed_ode_system_step(ed_ode_system *system, const double *const *committed, const ed_path *path,
                       const ed_path (*direction)[2], double *const *trial, ed_damper_force *out);

/* Force history of a system of one damper without sensitivities: from `state` (updated) through n samples of deformation u and
 * velocity v at ascending times; between samples the cubic through both. force: n, of the law without effects. *done: samples
 * that were reached. */
int ed_ode_system_history(ed_ode_system *system, double *state, int n, const double *time, const double *u, const double *v,
                          double *force, int *done);

#endif
