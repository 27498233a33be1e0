/* Loads on members. */
#ifndef ED_SPACE_LOADS_H
#define ED_SPACE_LOADS_H

#include "edcore.h"

/* Refuses loads that are not finite, or on what is not there. `loads` may be NULL. */
int ed_space_check_loads(ed_space *space, int n_cases, const ed_space_loads *loads);
/* Adds the end forces (n_members x 12) that displacements of the nodes (n_nodes x 6) make. */
void ed_space_member_forces(const ed_space *space, const double *displacements, double *end_forces);

#endif
