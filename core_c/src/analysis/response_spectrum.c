/* Elastic response spectra: peaks of many oscillators under one ground acceleration. */
#include "analysis/oscillator_lanes.h"
#include "base/watch.h"
#include "edcore.h"

#include <math.h>

typedef struct {
  ed_lanes lanes;
  double best[ED_KINDS][ED_LANES];
  double limit[ED_KINDS][ED_LANES]; /* samples above it may have a larger value than the best beside them */
} block;

/* Looks beside those samples of a piece that may top the largest value so far. */
static void look_between(block *b, int kind, int l)
{
  const ed_oscillator *o = &b->lanes.oscillator[l];
  double(*y)[ED_LANES] = b->lanes.y[kind];
  double best = b->best[kind][l], limit = b->limit[kind][l];
  for (int i = 1; i <= b->lanes.rows; i++) {
    const double size = fabs(y[i][l]);
    if (size > limit && size >= fabs(y[i - 1][l]) && size >= fabs(y[i + 1][l])) {
      const double peak = ed_peak_between(o, y[i - 1][l], y[i][l], y[i + 1][l]);
      if (peak > best)
        best = peak, limit = o->worth * best;
    }
  }
  best = best > b->lanes.top[kind][l] ? best : b->lanes.top[kind][l];
  b->best[kind][l] = best;
  b->limit[kind][l] = o->worth * best;
}

static void run_piece(block *b, int lanes, int rows, const double *a)
{
  ed_lanes_advance(&b->lanes, lanes, rows, a);
  for (int k = 0; k < b->lanes.kinds; k++)
    for (int l = 0; l < lanes; l++)
      if (b->lanes.top[k][l] > b->limit[k][l] || fabs(b->lanes.y[k][1][l]) > b->limit[k][l])
        look_between(b, k, l);
}

/* The motion is over and the oscillator moves on. 0 if its state is not finite, as after a sample that is not. */
static int look_after(block *b, int l)
{
  double start[ED_KINDS], rate[ED_KINDS];
  ed_lane_end(&b->lanes, l, start, rate);
  for (int k = 0; k < b->lanes.kinds; k++)
    b->best[k][l] = fmax(b->best[k][l], ed_free_peak(&b->lanes.oscillator[l], start[k], rate[k]));
  return isfinite(start[ED_SA]) && isfinite(rate[ED_SA]);
}

int ed_response_spectrum(int n, double dt, const double *acceleration, int n_oscillators, const double *period,
                         const double *damping, double *sd, double *sv, double *sa, const ed_stop *stop)
{
  ed_watch watch = ed_watch_of(stop);
  static const double silence = 0.0;
  if (!ed_oscillators_valid(n, dt, n_oscillators, period, damping) || !sd || !sv != !sa)
    return ED_E_ARGUMENT;
  while (n > 1 && acceleration[n - 1] == 0.0)
    n--;
  for (long from = 0; from < n_oscillators; from += ED_LANES) {
    block b = {.best = {{0.0}}, .limit = {{0.0}}};
    const int lanes =
      ed_lanes_begin(&b.lanes, (int)from, n_oscillators, dt, period, damping, acceleration[0], sv ? ED_KINDS : 1);
    for (long at = 0; at < n; at += ED_PIECE) {
      run_piece(&b, lanes, n - at < ED_PIECE ? (int)(n - at) : ED_PIECE, acceleration + at);
      if (ed_watch_step(&watch))
        return ED_E_STOPPED;
    }
    for (int l = 0; l < lanes; l++)
      if (!look_after(&b, l))
        return ED_E_NOT_FINITE;
    run_piece(&b, lanes, 1, &silence); /* what lies beside the last sample */
    for (int l = 0; l < lanes; l++) {
      const double scale = fabs(b.lanes.oscillator[l].Q[0]);
      sd[from + l] = b.best[ED_SD][l] * scale * dt * dt;
      if (sv) {
        sv[from + l] = b.best[ED_SV][l] * scale * dt;
        sa[from + l] = b.best[ED_SA][l] * scale;
      }
      if (!isfinite(sd[from + l]) || (sv && !isfinite(sv[from + l] + sa[from + l])))
        return ED_E_NOT_FINITE;
    }
  }
  return ED_OK;
}
