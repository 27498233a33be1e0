#include "damper/running_extremes.h"

#include <math.h>

/* Adds the part up to `to` behind the pieces there are; a resting part is joined to a resting one. */
static int add(ed_extremes_piece *piece, int n, ed_extremes_piece part, double to, int growing)
{
  if (n && !growing && !piece[n - 1].growing) {
    piece[n - 1].to = to;
    return n;
  }
  part.from = n ? piece[n - 1].to : 0.0;
  part.to = to;
  part.growing = growing;
  piece[n] = part;
  return n + 1;
}

/* Rounding of a level that the path before this one has reached at its end, where this one begins. */
static const double REACHED = 1e-14;

/* Where the path, monotone between the two places and beyond the level at the second, leaves it; the first where it never was inside. */
static double leaves(const ed_path *path, double level, double from, double to)
{
  const double inside = (level - ed_path_u(path, from)) * (level < ed_path_u(path, to) ? 1.0 : -1.0);
  return inside > REACHED * fabs(level) ? ed_path_crossing(path, level, from, to) : from;
}

int ed_extremes_pieces(ed_running start, const ed_path *path, ed_extremes_piece piece[ED_EXTREMES_PIECES])
{
  double end[3] = {0.0};
  const int turns = ed_path_reversals(path, end);
  end[turns] = path->h;
  ed_extremes_piece now = {.start = ed_extremes_with(start, path->c[0]), .largest_at = -1.0, .smallest_at = -1.0};
  if (now.start.largest > start.largest)
    now.largest_at = 0.0;
  if (now.start.smallest < start.smallest)
    now.smallest_at = 0.0;
  int n = 0;
  double from = 0.0;
  for (int i = 0; i <= turns; i++) {
    const double to = end[i], next = ed_path_u(path, to);
    const int growing = next > now.start.largest ? 1 : next < now.start.smallest ? -1 : 0;
    const double level = growing > 0 ? now.start.largest : now.start.smallest;
    const double rest = growing ? leaves(path, level, from, to) : to;
    if (rest > from)
      n = add(piece, n, now, rest, 0);
    if (growing) {
      n = add(piece, n, now, to, growing);
      if (growing > 0) {
        now.start.largest = next;
        now.largest_at = to;
      } else {
        now.start.smallest = next;
        now.smallest_at = to;
      }
    }
    from = to;
  }
  return n;
}

ed_running ed_extremes_after(const ed_extremes_piece *piece, const ed_path *path)
{
  return piece->growing ? ed_extremes_with(piece->start, ed_path_u(path, piece->to)) : piece->start;
}

ed_running ed_extremes_along(ed_running start, const ed_path *path)
{
  ed_extremes_piece piece[ED_EXTREMES_PIECES];
  const int n = ed_extremes_pieces(start, path, piece);
  return ed_extremes_after(&piece[n - 1], path);
}

int ed_extremes_breaks(ed_running start, const ed_path *path, double at[ED_EXTREMES_BREAKS])
{
  ed_extremes_piece piece[ED_EXTREMES_PIECES];
  const int n = ed_extremes_pieces(start, path, piece);
  for (int i = 1; i < n; i++)
    at[i - 1] = piece[i].from;
  return n - 1;
}
