#include "base/power_exp.h"

#include "base/clones.h"
#include "base/lanes.h"

_Static_assert((int)ED_POWER_BLOCK == (int)ED_LANE_WIDTH, "whole vectors");

static const double LOG2_E = 0x1.71547652b82fep+0, LARGEST = 0x1.f8f179c517d18p+9, LEAST = 1e-300;

ED_CLONES void ed_power_exp(int n, double power, const double *restrict base, const double *restrict rise,
                            double *restrict result)
{
  const ed_lanes zero = {0}, largest = zero + LARGEST, least = zero + LEAST;
  for (int i = 0; i < n; i += ED_LANE_WIDTH) {
    ed_lanes x = ED_LOAD(base + i), y;
    x = ED_SELECT(x > least, x, least);
    ed_lanes_log2(&x, &y);
    y = power * y + LOG2_E * ED_LOAD(rise + i);
    y = ED_SELECT(y > largest, largest, ED_SELECT(y < -largest, -largest, y));
    ed_lanes_exp2(&y, &x);
    ED_STORE(result + i, x);
  }
}
