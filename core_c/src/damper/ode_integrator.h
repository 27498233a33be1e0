/* ARKODE of SUNDIALS set up for blocks of small systems: a diagonally implicit Runge-Kutta method whose stages are solved block by
 * block. Private to ode_*.c. Time runs from 0 to 1 over `scale` seconds from `origin`. */
#ifndef ED_ODE_INTEGRATOR_H
#define ED_ODE_INTEGRATOR_H

#include "damper/ode_block.h"

#include <sundials/sundials_context.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sundials/sundials_nvector.h>

typedef struct {
  int n_blocks, n;          /* n: variables of all blocks */
  int *found;               /* n_blocks, for roots */
  int copies;               /* 1, or 3 with sensitivities behind the variables */
  double tolerance;
  ed_ode_block *block;
  ed_ode_work *work;
  ed_watch *watch;          /* of the call, or NULL */
  double origin, scale;     /* s */
  double *change;           /* n * copies: size of the change of each variable and sensitivity in this segment */
  double *weight;           /* n: of changes in Newton's method */
  double *slope;            /* n: derivatives where they were asked for last, for first guesses */
  SUNContext context;
  void *arkode;
  SUNNonlinearSolver stages;
  N_Vector y;
} ed_ode_integrator;

/* Blocks, work and context belong to the caller, the rest to the integrator. Returns a status; clear it in any case. */
int ed_ode_integrator_new(ed_ode_integrator *integrator, SUNContext context, int n_blocks, ed_ode_block *block, ed_ode_work *work,
                          int copies, double tolerance);
void ed_ode_integrator_clear(ed_ode_integrator *integrator);

double *ed_ode_variables(const ed_ode_integrator *integrator);
/* Begins a segment from instant t0 to t1 (s) with what is in ed_ode_variables. */
int ed_ode_integrator_begin(ed_ode_integrator *integrator, double t0, double t1);
/* Goes on to instant t <= t1; *reached may be less when blocks turn there (their `turned` is set). ED_OK, ED_E_NOT_FINITE,
 * ED_E_NOT_CONVERGED, ED_E_STOPPED. */
int ed_ode_integrator_advance(ed_ode_integrator *integrator, double t, double *reached);

#endif
