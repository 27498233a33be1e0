/* Energy balance of the committed state; the energies are in the head of the state. */
#ifndef ED_ENERGY_H
#define ED_ENERGY_H

#include "edcore.h"

void ed_count_energy(ed_analysis *a, double dissipated);
void ed_close_energy(ed_analysis *a);
void ed_restart_energy(ed_analysis *a);

#endif
