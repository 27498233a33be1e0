/* A compensator on its own. */
#include "substructure/wrong_input.h"

#include <stdlib.h>

int ed_compensator_run(const ed_compensator_parameters *parameters, int n, const double *target, const double *measured, double *command)
{
  if (ed_wrong_compensator(parameters) || n < 0)
    return ED_E_ARGUMENT;
  ed_compensator *state = malloc(sizeof *state);
  if (!state)
    return ED_E_MEMORY;
  ed_compensator_start(parameters, state);
  for (int k = 0; k < n; k++, target += 3)
    command[k] = ed_compensator_step(parameters, state, target[0], target[1], target[2], measured[k]);
  free(state);
  return ED_OK;
}
