/* Largest and smallest value so far of a deformation or a velocity, along a path (thesis Eq. 4.25).
 *
 * They begin at zero, so largest >= 0 >= smallest. Everything here takes a path of any quantity: for the velocity, the one that
 * ed_path_of_velocity makes. */
#ifndef ED_RUNNING_EXTREMES_H
#define ED_RUNNING_EXTREMES_H

#include "damper/path.h"

typedef struct {
  double largest, smallest;
} ed_running;

/* A part of a path on which the largest value follows the path (growing = +1), the smallest does (-1), or none (0). */
typedef struct {
  double from, to;                /* places on the path */
  int growing;
  ed_running start;              /* at its beginning */
  double largest_at, smallest_at; /* places on the path where these were reached; below zero: before the path */
} ed_extremes_piece;

enum { ED_EXTREMES_PIECES = 6, ED_EXTREMES_BREAKS = ED_EXTREMES_PIECES - 1 };

/* Amplitude u_max of Eq. 4.25. */
static inline double ed_extremes_mean(ed_running extremes)
{
  return 0.5 * (extremes.largest - extremes.smallest);
}

/* The extremes after one more value. */
static inline ed_running ed_extremes_with(ed_running extremes, double value)
{
  if (value > extremes.largest)
    extremes.largest = value;
  if (value < extremes.smallest)
    extremes.smallest = value;
  return extremes;
}

/* The velocity of a path as a path of its own: its ed_path_u is the velocity. */
static inline void ed_path_of_velocity(const ed_path *path, ed_path *velocity)
{
  *velocity = (ed_path){path->h, {path->c[1], 2.0 * path->c[2], 3.0 * path->c[3], 0.0}};
}

/* The whole path in pieces, one behind the other from 0 to h; at least one. The first value counts: where it lies outside of `start`
 * (a jump) the extremes begin there, reached at 0. */
int ed_extremes_pieces(ed_running start, const ed_path *path, ed_extremes_piece piece[ED_EXTREMES_PIECES]);
/* The extremes at the end of a piece. */
ed_running ed_extremes_after(const ed_extremes_piece *piece, const ed_path *path);
/* The extremes at the end of the path. */
ed_running ed_extremes_along(ed_running start, const ed_path *path);
/* Places in (0, h), ascending, where an extreme begins or ceases to grow. */
int ed_extremes_breaks(ed_running start, const ed_path *path, double at[ED_EXTREMES_BREAKS]);

#endif
