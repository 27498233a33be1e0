/* Load patterns at their present factors, on nodes and inside members. */
#ifndef ED_LOADING_H
#define ED_LOADING_H

#include "element/element.h"

typedef struct {
  double section_load[ED_MAX_POINTS][ED_MAX_RESULTANTS], end_load[ED_MAX_BASIC], free_deformation[ED_MAX_BASIC];
  double arm_force[2][3], arm_moment[2][3], mean_axial;
} ed_member_loads;

typedef struct {
  double *factors;               /* of the load patterns, trial */
  double *factors_committed, *factors_backup;
  double *external;              /* n: loads at `factors` */
  double *external_committed;    /* n: loads at the last commit */
  ed_member_loads *member_committed; /* per member: element loads at the last commit */
} ed_loading;

int ed_loading_allocate(ed_loading *loading, const ed_model *model, int n);
void ed_loading_free(ed_loading *loading);
void ed_set_factors(ed_analysis *a);    /* external and element loads from the factors */
void ed_remember_loads(ed_analysis *a); /* those of the committed state, for the work of the next step */

#endif
