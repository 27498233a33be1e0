/* A damper in a test rig: it is moved, and its force read. */
#ifndef DAMPER_RIG_H
#define DAMPER_RIG_H

#include "edcore.h"

enum { LARGEST_DAMPER_STATE = 200 };

typedef struct {
  ed_damper *damper;
  double state[LARGEST_DAMPER_STATE];
  double u, v;
} rig;

/* At rest; a law that is refused fails a check. */
rig new_rig(int law, int n_parameters, const double *parameters, double brace);
void free_rig(rig *rig);
/* To (u, v) in time h along the cubic, for good; the force there. Every step is made twice and must come out the same to the
 * last bit, with the state before it untouched. */
double move(rig *rig, double h, double u, double v);
/* To u in a second, at rest there: monotone. */
double move_to(rig *rig, double u);
/* The slopes of a step to (u, v) against central differences of width du and dv; within `tolerance` (force per deformation), and
 * for the velocity that times h. */
void check_slopes(const rig *rig, double h, double u, double v, double du, double dv, double tolerance);
/* What `ed_damper_new` says of parameters that it refuses. */
void check_refused(int law, int n_parameters, const double *parameters, const char *text);

#endif
