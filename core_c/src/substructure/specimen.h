/* The specimen of a test: its law at the size of the device, moved over one sub-step after the other. */
#ifndef ED_SPECIMEN_H
#define ED_SPECIMEN_H

#include "damper/law.h"
#include "damper/ode_system.h"

typedef struct {
  const ed_damper *damper;
  ed_ode_system *system;     /* of a law without an exact step, or NULL */
  double force_scale, deformation_scale; /* F = force_scale * law(deformation_scale * u) */
  double h;                  /* sub-step */
  double *law, *trial;       /* states of the law, ed_damper_state_size each: committed, and at the end of the last trial */
  double force, deformation; /* at the end of the last sub-step */
  double tangent, largest;   /* in series: last stiffness over a sub-step, and largest displacement so far */
} ed_specimen;

/* At rest. */
void ed_specimen_start(ed_specimen *specimen);
/* The specimen moves from `from` to `to` on the cubic with the velocities `start` and `end`. ED_OK, or what ed_damper_advance returns. */
int ed_specimen_follow(ed_specimen *specimen, double from, double start, double to, double end);
/* The specimen behind oil and rig that give way (m/N): force(x) = stiffness (drive - x) at the end of the sub-step, over which x rises in a
 * ramp. A force that grows with x leaves one solution; Newton's method finds it, and where it does not halve its steps or leaves the
 * bracket of what was tried, the middle of that. Where nothing gives way, x is the drive. Also ED_E_NOT_CONVERGED. */
int ed_specimen_in_series(ed_specimen *specimen, double flexibility, double drive);
/* Of both above the last one counts. */
void ed_specimen_commit(ed_specimen *specimen);

#endif
