/* A stiffness or damping coefficient that the largest deformation or velocity so far takes away: a exp(-mean / reference) + b, of the
 * mean of the running extremes (thesis Eqs. 4.24 to 4.26); along a path. */
#ifndef ED_SOFTENING_H
#define ED_SOFTENING_H

#include "damper/running_extremes.h"

#include <math.h>

typedef struct {
  double a, b, reference;
} ed_softening;

/* A piece of a path, up to the place `to`. The mean there is rest + follow * value, where follow is 0, or 1/2 with the sign of the
 * extreme that follows the path; likewise its derivatives. */
typedef struct {
  double to;
  double follow, rest, slope[2];
} ed_softening_piece;

/* The coefficient and its derivatives. */
typedef struct {
  double value, slope[2];
} ed_modulus;

/* On a piece, where its quantity is `value` with the derivatives `along`. */
static inline ed_modulus ed_softening_modulus(const ed_softening *law, const ed_softening_piece *piece, double value,
                                              const double along[2])
{
  const double falling = law->a * exp(-(piece->rest + piece->follow * value) / law->reference), change = -falling / law->reference;
  return (ed_modulus){falling + law->b,
                      {change * (piece->slope[0] + piece->follow * along[0]), change * (piece->slope[1] + piece->follow * along[1])}};
}

/* The pieces of path from 0 to h, without those that end before `origin`; places count from the origin. direction: of the same
 * quantity; NULL: without slopes. after: the extremes at the end. */
int ed_softening_pieces(ed_running start, const ed_path *path, const ed_path *direction, double origin,
                        ed_softening_piece piece[ED_EXTREMES_PIECES], ed_running *after);

#endif
