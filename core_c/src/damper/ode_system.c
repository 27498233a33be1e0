#include "damper/ode_system.h"

#include "edcore.h"

#include <stddef.h>

ed_ode_system *ed_ode_system_new(int n, const ed_damper *const *damper, double tolerance, int *status)
{
  (void)n, (void)damper, (void)tolerance;
  *status = ED_E_STATE;
  return NULL;
}
void ed_ode_system_free(ed_ode_system *system)
{
  (void)system;
}
int ed_ode_system_step(ed_ode_system *system, const double *const *committed, const ed_path *path,
                       const ed_path (*direction)[2], double *const *trial, ed_damper_force *out)
{
  (void)system, (void)committed, (void)path, (void)direction, (void)trial, (void)out;
  return ED_E_STATE;
}
int ed_ode_system_history(ed_ode_system *system, double *state, int n, const double *time, const double *u, const double *v,
                          double *force, int *done)
{
  (void)system, (void)state, (void)n, (void)time, (void)u, (void)v, (void)force, (void)done;
  return ED_E_STATE;
}
