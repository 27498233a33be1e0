#include "analysis/oscillator_lanes.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)

enum { IN_FLIGHT = 4 }; /* vectors; a step of one waits ten cycles for its own results */

/* Decaying states stop here, before arithmetic with denormal numbers slows down. */
static const double NOTHING = 1e-250;

#define WIDTH 16
#define TARGET
#include "analysis/oscillator_kernel.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define WIDTH 32
#define TARGET __attribute__((target("avx2")))
#include "analysis/oscillator_kernel.h"

#define WIDTH 64
#define TARGET __attribute__((target("avx512f,avx512dq")))
#include "analysis/oscillator_kernel.h"
#endif

/* All widths do the same operations in the same order and give the same bits. */
static void advance(ed_lanes *b, int lanes, const double *a)
{
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
    advance_64(b, lanes, a);
    return;
  }
  if (__builtin_cpu_supports("avx2")) {
    advance_32(b, lanes, a);
    return;
  }
#endif
  advance_16(b, lanes, a);
}

static void set_lane(ed_lanes *b, int l, double first)
{
  const ed_oscillator *o = &b->oscillator[l];
  const double q = o->Q[0], D1 = o->E[0][0] * o->Q[0] + o->E[0][1] * o->Q[1] + o->P[0];
  const double D2 = o->E[1][0] * o->Q[0] + o->E[1][1] * o->Q[1] + o->P[1];
  b->e11[l] = o->E[0][0];
  b->e21[l] = o->E[0][1] * o->E[1][0];
  b->e22[l] = o->E[1][1];
  b->d1[l] = D1 / q;
  b->d2[l] = o->E[0][1] * D2 / q;
  b->vy[l] = 1.0 / o->E[0][1];
  b->va[l] = o->Q[1] / q;
  b->su[l] = -o->h * o->h;
  b->sv[l] = -2.0 * o->zeta * o->h;
  b->y1[l] = -first; /* x = 0 */
  b->y2[l] = -b->va[l] * o->E[0][1] * first;
  for (int k = 0; k < ED_KINDS; k++)
    b->y[k][0][l] = b->y[k][1][l] = 0.0;
}

int ed_lanes_begin(ed_lanes *b, int first, int n, double dt, const double *period, const double *damping, double a,
                   int kinds)
{
  const int lanes = n - first < ED_LANES ? n - first : ED_LANES;
  for (int l = 0; l < ED_LANES; l++) {
    if (l < lanes)
      ed_oscillator_set(&b->oscillator[l], period[first + l] / dt, damping[first + l]);
    else
      b->oscillator[l] = b->oscillator[lanes - 1]; /* idle lanes of the last vector */
    set_lane(b, l, a);
  }
  b->rows = 0;
  b->kinds = kinds;
  return lanes;
}

void ed_lanes_advance(ed_lanes *b, int lanes, int rows, const double *a)
{
  for (int k = 0; k < b->kinds && b->rows; k++)
    memmove(b->y[k][0], b->y[k][b->rows], 2 * sizeof b->y[k][0]); /* the two overlap after a piece of one row */
  for (int l = 0; l < lanes; l++)
    if (fabs(b->y1[l]) + fabs(b->y2[l]) < NOTHING)
      b->y1[l] = b->y2[l] = 0.0;
  b->rows = rows;
  advance(b, lanes, a);
}

void ed_lane_end(const ed_lanes *b, int l, double start[ED_KINDS], double rate[ED_KINDS])
{
  const ed_oscillator *o = &b->oscillator[l];
  const double damping = 2.0 * o->zeta * o->h, stiffness = o->h * o->h;
  start[ED_SD] = b->y1[l];
  start[ED_SV] = rate[ED_SD] = b->vy[l] * b->y2[l];
  start[ED_SA] = rate[ED_SV] = -(damping * start[ED_SV] + stiffness * start[ED_SD]);
  rate[ED_SA] = -(damping * rate[ED_SV] + stiffness * start[ED_SV]);
}
