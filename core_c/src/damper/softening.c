#include "damper/softening.h"

/* Half the derivative of an extreme that was reached at a place of the path: that of the path there, as at a maximum a shift of
 * the place changes nothing. Before the path: none. */
static double half_slope(const ed_path *direction, double at)
{
  return at >= 0.0 ? 0.5 * ed_path_u(direction, at) : 0.0;
}

int ed_softening_pieces(ed_running start, const ed_path *path, const ed_path *direction, double origin,
                        ed_softening_piece piece[ED_EXTREMES_PIECES], ed_running *after)
{
  ed_extremes_piece part[ED_EXTREMES_PIECES];
  const int parts = ed_extremes_pieces(start, path, part);
  int n = 0;
  for (int i = 0; i < parts; i++) {
    const ed_extremes_piece *of = &part[i];
    if (of->to <= origin)
      continue;
    ed_softening_piece *to = &piece[n++];
    *to = (ed_softening_piece){.to = of->to - origin, .follow = 0.5 * of->growing};
    if (of->growing <= 0)
      to->rest += 0.5 * of->start.largest;
    if (of->growing >= 0)
      to->rest -= 0.5 * of->start.smallest;
    for (int j = 0; direction && j < 2; j++) {
      if (of->growing <= 0)
        to->slope[j] += half_slope(&direction[j], of->largest_at);
      if (of->growing >= 0)
        to->slope[j] -= half_slope(&direction[j], of->smallest_at);
    }
  }
  *after = ed_extremes_after(&part[parts - 1], path);
  return n;
}
