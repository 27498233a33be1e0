/* Menegotto & Pinto (1973) with the curvature rule of Filippou, Popov & Bertero (1983), no isotropic hardening; many fibres at once.
 *
 * A branch runs from a reversal point towards the asymptote of its direction. The classical rule forgets the branch it left,
 * so that a small unloading and reloading rises above the curve that would have been followed without it. Here the branches that
 * were left are remembered as long as a new one begins ahead of them: the response is the lowest of the new branch and those
 * remembered for its direction (the highest when loading downwards) and, where it meets one, continues on it. */
#ifndef ED_MENEGOTTO_PINTO_H
#define ED_MENEGOTTO_PINTO_H

#include "material/steel.h"

/* Laws of n fibres, n a multiple of ED_LANE_WIDTH; arrays of n. */
typedef struct {
  int n;
  int plain_turns; /* every turn begins a branch, also where both branches are the elastic line: of fibres in one plane */
  double *E, *b, *yield_strain;
  double *R0, *cR1, *cR2;
} ed_menegotto_pinto;

enum { ED_MENEGOTTO_PINTO_ARRAYS = 6 };

/* Lays the arrays of n fibres into n ED_MENEGOTTO_PINTO_ARRAYS doubles; turns are plain. */
void ed_menegotto_pinto_place(ed_menegotto_pinto *law, int n, double *block);
void ed_menegotto_pinto_set(ed_menegotto_pinto *law, int fibre, const ed_steel *steel);

/* The state of n fibres, n ED_MENEGOTTO_PINTO_STATE doubles, before any strain. */
void ed_menegotto_pinto_initialise(const ed_menegotto_pinto *law, double *state);
/* Whether the branches that a state remembers may be so many. */
int ed_menegotto_pinto_valid(int n, const double *state);
/* Stress and tangent of the fibres `first` to first + count, multiples of ED_LANE_WIDTH; arrays of count. The return is 1 when all
 * respond elastically. Strains may change by `reach` before a stress leaves its tangent by more than 1e-12 of yield. */
int ed_menegotto_pinto_trial(const ed_menegotto_pinto *law, const double *state, int first, int count,
                             const double *strain, double *stress, double *tangent, double *reach);
/* Moves the fibres to `strain`, where a trial found `stress`, or follows from it within reach; fibres that come near remembered branches
 * are evaluated anew. `dissipated`: a unit volume, on the way. */
void ed_menegotto_pinto_commit(const ed_menegotto_pinto *law, double *state, int first, int count, const double *strain,
                               double *stress, double *dissipated);
/* The committed stress of a fibre. */
double ed_menegotto_pinto_stress(const double *state, int fibre);

#endif
