#include "damper/rig.h"

#include <math.h>

/* Half the play. */
static double gap_of(const ed_rig *rig)
{
  return 0.5 * rig->play;
}

static double beyond(const ed_rig *rig, double stretch)
{
  return fmax(fabs(stretch) - gap_of(rig), 0.0);
}

/* Stiffness at small stretches of the side on which a stretch or a force is. */
static double of_side(const ed_rig *rig, double sign)
{
  return sign < 0.0 ? rig->back * rig->stiffness : rig->stiffness;
}

/* How many times as stiff as at first, by the secant, parts are at a stretch z. */
static double stiffer(const ed_rig *rig, double z)
{
  return rig->power > 1.0 ? pow(rig->bend * z * z, 0.5 * (rig->power - 1.0)) : 1.0 + rig->bend * z * z;
}

double ed_rig_carries(const ed_rig *rig, double stretch)
{
  const double z = beyond(rig, stretch), closing = rig->within * fmin(fabs(stretch), gap_of(rig));
  return copysign(closing + of_side(rig, stretch) * z * stiffer(rig, z), stretch);
}

/* Stretch at which parts carry a force, if they stiffen with a power and no play stands before them. */
static double stretched(const ed_rig *rig, double force)
{
  return copysign(pow(fabs(force) / (of_side(rig, force) * pow(rig->bend, 0.5 * (rig->power - 1.0))), 1.0 / rig->power), force);
}

double ed_rig_meets(const ed_rig *rig, double stretch, double force, double slope)
{
  const double z = beyond(rig, stretch), gap = gap_of(rig);
  if (rig->power > 1.0 && (z == 0.0 || force * stretch < 0.0)) /* no tangent there, or that of the other side: a bracket */
    return stretched(rig, force);
  if (z > 0.0 && rig->bend > 0.0) {
    const double tangent = of_side(rig, stretch) * (rig->power > 1.0 ? rig->power * stiffer(rig, z) : 1.0 + 3.0 * rig->bend * z * z);
    const double next = stretch + (force - ed_rig_carries(rig, stretch)) / (tangent + slope);
    if (next * stretch > 0.0 && fabs(next) >= gap)
      return next;
  }
  const double closed = rig->within * gap;
  const double at_high = force - slope * (gap - stretch), at_low = force + slope * (gap + stretch);
  if (at_high > closed)
    return gap + (at_high - closed) / (of_side(rig, 1.0) + slope);
  if (at_low < -closed)
    return (at_low + closed) / (of_side(rig, -1.0) + slope) - gap;
  return rig->within + slope > 0.0 ? (force + slope * stretch) / (rig->within + slope) : fmax(-gap, fmin(gap, stretch));
}
