#include "damper/brace.h"

int ed_brace_step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out)
{
  (void)damper, (void)committed, (void)path, (void)direction, (void)trial, (void)out;
  return ED_E_STATE;
}
