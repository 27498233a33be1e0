/* A damper behind a rig in one test, as a campaign has it. */
#ifndef IN_SERIES_H
#define IN_SERIES_H

#include "edcore.h"

/* Force through rig and damper, and the damper's own deformation: n each. *done: samples that were reached. */
int history_in_series(const ed_damper *damper, int method, double fineness, int n, const double *time, const double *u, const double *v,
                      const double *factor, const double *added, const double *spring, const ed_rig *rig, double *force, double *own,
                      int *done);

#endif
