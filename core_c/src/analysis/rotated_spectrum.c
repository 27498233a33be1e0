/* Peaks of the displacement of oscillators under two components, in many directions (Boore 2010). */
#include "analysis/oscillator_lanes.h"
#include "base/watch.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  ed_lanes first, second;
  int n_angles;
  double cosine[ED_MAX_ANGLES], sine[ED_MAX_ANGLES];
  double best[ED_LANES][ED_MAX_ANGLES];
} pair;

/* A piece for one lane. A sample nearer to the origin than the smallest peak of all directions is none in any. */
static void look_around(pair *p, int l)
{
  const ed_oscillator *o = &p->first.oscillator[l];
  double(*y)[ED_LANES] = p->first.y[ED_SD], (*z)[ED_LANES] = p->second.y[ED_SD];
  double *best = p->best[l], smallest = best[0];
  for (int k = 1; k < p->n_angles; k++)
    smallest = best[k] < smallest ? best[k] : smallest;
  const double near = o->worth * smallest * o->worth * smallest;
  for (int i = 1; i <= p->first.rows; i++) {
    if (y[i][l] * y[i][l] + z[i][l] * z[i][l] <= near)
      continue;
    for (int k = 0; k < p->n_angles; k++) {
      const double c = p->cosine[k], s = p->sine[k], middle = c * y[i][l] + s * z[i][l], size = fabs(middle);
      if (size > o->worth * best[k]) {
        const double before = c * y[i - 1][l] + s * z[i - 1][l], after = c * y[i + 1][l] + s * z[i + 1][l];
        if (size >= fabs(before) && size >= fabs(after)) {
          const double peak = ed_peak_between(o, before, middle, after);
          best[k] = peak > best[k] ? peak : best[k];
        }
      }
    }
  }
}

/* 0 if the state after the motion is not finite. */
static int look_after(pair *p, int l)
{
  double y[ED_KINDS], y_rate[ED_KINDS], z[ED_KINDS], z_rate[ED_KINDS];
  ed_lane_end(&p->first, l, y, y_rate);
  ed_lane_end(&p->second, l, z, z_rate);
  for (int k = 0; k < p->n_angles; k++) {
    const double c = p->cosine[k], s = p->sine[k];
    const double peak = ed_free_peak(&p->first.oscillator[l], c * y[ED_SD] + s * z[ED_SD], c * y[ED_SV] + s * z[ED_SV]);
    p->best[l][k] = fmax(p->best[l][k], peak);
  }
  return isfinite(y[ED_SD]) && isfinite(y[ED_SV]) && isfinite(z[ED_SD]) && isfinite(z[ED_SV]);
}

static void run_piece(pair *p, int lanes, int rows, const double *first, const double *second)
{
  ed_lanes_advance(&p->first, lanes, rows, first);
  ed_lanes_advance(&p->second, lanes, rows, second);
  for (int l = 0; l < lanes; l++)
    look_around(p, l);
}

/* ED_LANES oscillators, or as many as are left. ED_E_NOT_FINITE if a sample is not finite. */
static int run_block(pair *p, int lanes, int n, const double *first, const double *second, ed_watch *watch)
{
  static const double silence = 0.0;
  memset(p->best, 0, sizeof p->best);
  for (long at = 0; at < n; at += ED_PIECE) {
    run_piece(p, lanes, n - at < ED_PIECE ? (int)(n - at) : ED_PIECE, first + at, second + at);
    if (ed_watch_step(watch))
      return ED_E_STOPPED;
  }
  for (int l = 0; l < lanes; l++)
    if (!look_after(p, l))
      return ED_E_NOT_FINITE;
  run_piece(p, lanes, 1, &silence, &silence); /* what lies beside the last sample */
  return ED_OK;
}

int ed_rotated_spectrum(int n, double dt, const double *first, const double *second, int n_oscillators,
                        const double *period, const double *damping, int n_angles, double *sd, const ed_stop *stop)
{
  ed_watch watch = ed_watch_of(stop);
  if (!ed_oscillators_valid(n, dt, n_oscillators, period, damping) || n_angles < 1 || n_angles > ED_MAX_ANGLES || !sd)
    return ED_E_ARGUMENT;
  pair *p = aligned_alloc(_Alignof(pair), sizeof *p); /* too large for the stack of a thread on some systems */
  if (!p)
    return ED_E_MEMORY;
  p->n_angles = n_angles;
  for (int k = 0; k < n_angles; k++)
    p->cosine[k] = cos(M_PI * k / n_angles), p->sine[k] = sin(M_PI * k / n_angles);
  int status = ED_OK;
  for (long from = 0; from < n_oscillators && status == ED_OK; from += ED_LANES) {
    const int lanes = ed_lanes_begin(&p->first, (int)from, n_oscillators, dt, period, damping, first[0], 1);
    ed_lanes_begin(&p->second, (int)from, n_oscillators, dt, period, damping, second[0], 1);
    status = run_block(p, lanes, n, first, second, &watch);
    for (int l = 0; l < lanes && status == ED_OK; l++)
      for (int k = 0; k < n_angles; k++) {
        const double value = p->best[l][k] * fabs(p->first.oscillator[l].Q[0]) * dt * dt;
        sd[(from + l) * n_angles + k] = value;
        if (!isfinite(value))
          status = ED_E_NOT_FINITE;
      }
  }
  free(p);
  return status;
}
