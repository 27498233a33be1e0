#include "material/fatigue.h"

#include <math.h>

/* Whether it has broken; damage of closed cycles, and of half cycles between the turning points kept, whose ranges narrow; the strain; the
 * turning points. */
enum { BROKEN, CLOSED, OPEN, STRAIN, COUNT, POINTS };
enum { DEPTH = ED_FATIGUE_STATE - POINTS };

static double of_range(const ed_steel *steel, double a, double b)
{
  return pow(fabs(a - b) / steel->fatigue_strain, steel->fatigue_exponent);
}

double ed_fatigue_follow(const ed_steel *steel, double *state, double strain)
{
  double *points = state + POINTS;
  int n = state[COUNT] > 0.0 ? (int)state[COUNT] : 1; /* the origin */
  if ((strain - state[STRAIN]) * (state[STRAIN] - points[n - 1]) < 0.0) { /* a turning point */
    if (n == DEPTH) { /* the innermost cycle, the smallest, counts as closed, and the half cycle that led to it as done */
      const double led = 0.5 * of_range(steel, points[n - 2], points[n - 1]);
      state[CLOSED] += of_range(steel, points[n - 1], state[STRAIN]) + led;
      state[OPEN] -= led;
      n--;
    } else {
      state[OPEN] += 0.5 * of_range(steel, points[n - 1], state[STRAIN]);
      points[n++] = state[STRAIN];
    }
  }
  state[STRAIN] = strain;
  while (n > 1 && fabs(strain - points[n - 1]) >= fabs(points[n - 1] - points[n - 2])) {
    const double damage = of_range(steel, points[n - 1], points[n - 2]);
    state[OPEN] -= 0.5 * damage;
    if (n > 2) {
      state[CLOSED] += damage;
      state[OPEN] -= 0.5 * of_range(steel, points[n - 2], points[n - 3]);
      n -= 2;
    } else { /* a range from the first point is half a cycle */
      state[CLOSED] += 0.5 * damage;
      points[0] = points[1];
      n = 1;
    }
  }
  state[COUNT] = n;
  return state[CLOSED] + state[OPEN] + 0.5 * of_range(steel, points[n - 1], strain);
}

int ed_fatigue_broken(const double *state)
{
  return state[BROKEN] != 0.0;
}

void ed_fatigue_break(double *state)
{
  state[BROKEN] = 1.0;
}

int ed_fatigue_state_valid(const double *state)
{
  return state[COUNT] >= 0.0 && state[COUNT] <= DEPTH;
}
