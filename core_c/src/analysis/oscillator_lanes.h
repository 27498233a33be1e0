/* Many oscillators side by side, one a lane, through pieces of the motion. */
#ifndef ED_OSCILLATOR_LANES_H
#define ED_OSCILLATOR_LANES_H

#include "analysis/oscillator.h"

enum {
  ED_LANES = 32, /* four vectors of eight doubles */
  ED_PIECE = 64  /* samples; the responses to a piece stay in the first-level cache */
};
enum { ED_SD = 0, ED_SV = 1, ED_SA = 2, ED_KINDS = 3 };

/* The state is moved and scaled so that a step takes five products: with z = x - Q a, y1 = z_u / Q_u, y2 = E_uv z_v / Q_u,
 *   y1' = e11 y1 + y2 + d1 a,  y2' = e21 y1 + e22 y2 + d2 a,
 * and over Q_u the displacement is y1 + a, the velocity vy y2 + va a, the absolute acceleration su u + sv v. */
typedef struct {
  double e11[ED_LANES], e21[ED_LANES], e22[ED_LANES], d1[ED_LANES], d2[ED_LANES];
  double vy[ED_LANES], va[ED_LANES], su[ED_LANES], sv[ED_LANES];
  double y1[ED_LANES], y2[ED_LANES];
  double top[ED_KINDS][ED_LANES];             /* largest magnitude in the piece */
  double y[ED_KINDS][ED_PIECE + 2][ED_LANES]; /* over Q_u; the last two rows of the piece before, then those of the piece */
  int rows, kinds;                            /* of the piece; kinds is 1 (displacement) or ED_KINDS */
  ed_oscillator oscillator[ED_LANES];
} __attribute__((aligned(64))) ed_lanes;

/* Oscillators first to first + lanes - 1 of n (at most ED_LANES), at rest at the first sample a. Returns their number. */
int ed_lanes_begin(ed_lanes *b, int first, int n, double dt, const double *period, const double *damping, double a,
                   int kinds);
/* Advances them over the next samples, at most ED_PIECE. */
void ed_lanes_advance(ed_lanes *b, int lanes, int rows, const double *a);
/* One step after the last sample, where the motion is over: x and x' of the free vibration of each kind, over Q_u. */
void ed_lane_end(const ed_lanes *b, int lane, double start[ED_KINDS], double rate[ED_KINDS]);

#endif
