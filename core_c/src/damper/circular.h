/* Hysteresis of bearings that slide or yield in two directions at once: its force lies within a circle, whatever the way.
 *
 * Along each direction it is the law of the plane, an elastic rise q' = k u' up to a limit that keeps |q|; on the circle it turns
 * towards the motion, q' = k (u' - n (n . u')), n = q / |q| (associated flow of a circular yield surface; of friction that acts against
 * the velocity, with the elastic displacement k has before it slips). */
#ifndef ED_CIRCULAR_H
#define ED_CIRCULAR_H

#include "damper/law.h"

typedef struct {
  double stiffness;
  double limit;  /* at high speed */
  double fading; /* what is missing of it at rest; fades with exp(-rate |velocity|) */
  double rate;
} ed_circle;

/* Moves q (2) along the paths of both directions. slope: derivatives [of q along][to the motion along][to its deformation, velocity at
 * the end]. ED_OK, ED_E_NOT_FINITE. */
int ed_circle_follow(const ed_circle *circle, const ed_path path[2], const ed_path direction[2], double q[2], double slope[2][2][2]);

/* The step of a law in two directions that is this beside a linear spring, alike in both, with q as its memory. */
int ed_circle_beside_spring(const ed_circle *circle, double spring, const double *const committed[2], const ed_path path[2],
                            const ed_path direction[2], double *const trial[2], ed_pair_force *out);

#endif
