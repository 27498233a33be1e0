/* Channels: declaration, extremes, limits and rows of the caller's buffers. */
#include "system/analysis.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A channel without terms; its number, or ED_E_MEMORY. */
static int append(ed_channels *channels, int keep_history)
{
  ed_channel_head *head = realloc(channels->head, ((size_t)channels->n + 1) * sizeof *head);
  if (head)
    channels->head = head;
  double **extremes[] = {&channels->maximum, &channels->minimum, &channels->time_maximum, &channels->time_minimum, &channels->last,
                         &channels->angle};
  int ok = head != NULL;
  for (size_t i = 0; i < sizeof extremes / sizeof *extremes; i++) {
    double *grown = realloc(*extremes[i], ((size_t)channels->n + 1) * sizeof *grown);
    if (grown) {
      *extremes[i] = grown;
      grown[channels->n] = 0.0;
    }
    ok = ok && grown;
  }
  if (!ok)
    return ED_E_MEMORY;
  channels->head[channels->n] = (ed_channel_head){.history = keep_history ? channels->n_history++ : -1, .limit = INFINITY};
  return channels->n++;
}

int ed_channel(ed_analysis *a, int n, const double *coefficient, const int *kind, const int *object,
               const int *component, int keep_history)
{
  if (a->run.row > 0)
    return ed_fail(a, ED_E_STATE, "channels cannot be added once a run has advanced");
  if (n < 1 || n > INT_MAX - a->channels.n_terms)
    return ed_fail(a, ED_E_ARGUMENT, "a channel of %d terms", n);
  for (int i = 0; i < n; i++)
    if (!ed_is_quantity(a, kind[i], object[i], component[i]) || !isfinite(coefficient[i]))
      return ed_fail(a, ED_E_ID, "channel %d: no quantity of kind %d, object %d, component %d", a->channels.n, kind[i],
                     object[i], component[i]);
  ed_channels *channels = &a->channels;
  ed_term *terms = realloc(channels->terms, ((size_t)channels->n_terms + (size_t)n) * sizeof *terms);
  if (terms)
    channels->terms = terms;
  const int channel = terms ? append(channels, keep_history) : ED_E_MEMORY;
  if (channel < 0)
    return ed_fail(a, channel, "out of memory");
  channels->head[channel].n_terms = n;
  channels->head[channel].first = channels->n_terms;
  for (int i = 0; i < n; i++)
    channels->terms[channels->n_terms++] = (ed_term){coefficient[i], kind[i], object[i], component[i]};
  return channel;
}

int ed_channel_root(ed_analysis *a, int first, int second, int keep_history)
{
  if (a->run.row > 0)
    return ed_fail(a, ED_E_STATE, "channels cannot be added once a run has advanced");
  const int missing = first < 0 || first >= a->channels.n ? first : second;
  if (missing < 0 || missing >= a->channels.n)
    return ed_fail(a, ED_E_ID, "there is no channel %d", missing);
  const int channel = append(&a->channels, keep_history);
  if (channel < 0)
    return ed_fail(a, channel, "out of memory");
  a->channels.head[channel].first = first;
  a->channels.head[channel].second = second;
  return channel;
}

int ed_channel_limit(ed_analysis *a, int channel, double limit)
{
  if (a->run.row > 0)
    return ed_fail(a, ED_E_STATE, "limits cannot be set once a run has advanced");
  if (channel < 0 || channel >= a->channels.n)
    return ed_fail(a, ED_E_ID, "there is no channel %d", channel);
  if (!(limit > 0.0))
    return ed_fail(a, ED_E_ARGUMENT, "channel %d: the limit %g is not positive", channel, limit);
  a->channels.head[channel].limit = limit;
  return ED_OK;
}

int ed_beyond_limit(const ed_channels *channels)
{
  int furthest = -1;
  double most = 1.0;
  for (int i = 0; i < channels->n; i++)
    if (fabs(channels->last[i]) > most * channels->head[i].limit) {
      most = fabs(channels->last[i]) / channels->head[i].limit;
      furthest = i;
    }
  return furthest;
}

void ed_channels_free(ed_channels *channels)
{
  void *blocks[] = {channels->head,         channels->terms,        channels->maximum, channels->minimum,
                    channels->time_maximum, channels->time_minimum, channels->last,    channels->angle};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
    free(blocks[i]);
}

void ed_clear_channels(ed_analysis *a)
{
  a->channels.n = a->channels.n_terms = a->channels.n_history = 0;
}

static int not_finite(ed_analysis *a, const char *what, int index)
{
  return ed_fail(a, ED_E_NOT_FINITE, "%s: %s %d after step %d, at %.6g", ed_status_text(ED_E_NOT_FINITE), what, index, a->run.done,
                 a->committed.head->time);
}

/* Extremes of every channel, and a row of the caller's buffers. What is not finite enters neither. */
int ed_sample(ed_analysis *a, int keep_row)
{
  const double time = a->committed.head->time;
  const int first = a->run.done == 0;
  const size_t place = (size_t)(a->run.row - a->run.taken);
  double *row = keep_row && a->run.values ? a->run.values + place * (size_t)a->channels.n_history : NULL;
  for (int i = 0; i < a->channels.n; i++) {
    const ed_channel_head *head = &a->channels.head[i];
    const double *last = a->channels.last; /* a root comes after what it is of */
    const double value = head->n_terms ? ed_channel_sum(a, head) : hypot(last[head->first], last[head->second]);
    if (!isfinite(value))
      return not_finite(a, "channel", i);
    a->channels.last[i] = value;
    if (first || value > a->channels.maximum[i]) {
      a->channels.maximum[i] = value;
      a->channels.time_maximum[i] = time;
      if (!head->n_terms)
        a->channels.angle[i] = atan2(last[head->second], last[head->first]);
    }
    if (first || value < a->channels.minimum[i]) {
      a->channels.minimum[i] = value;
      a->channels.time_minimum[i] = time;
    }
    if (row && head->history >= 0)
      row[head->history] = value;
  }
  const int close = keep_row && a->run.energy && a->settings.energy;
  if (close)
    ed_close_energy(a);
  for (int i = 0; a->settings.energy && i < ED_N_ENERGY; i++)
    if (!isfinite(a->committed.head->energy[i]))
      return not_finite(a, "energy", i);
  if (!keep_row)
    return ED_OK;
  if (a->run.abscissa)
    a->run.abscissa[place] = time;
  if (a->run.energy) {
    memcpy(a->run.energy + place * ED_N_ENERGY, a->committed.head->energy, ED_N_ENERGY * sizeof(double));
  }
  a->run.row++;
  return ED_OK;
}

void ed_extremes(const ed_analysis *a, double *maximum, double *time_of_maximum, double *minimum,
                 double *time_of_minimum, double *last)
{
  const size_t bytes = (size_t)a->channels.n * sizeof(double);
  if (bytes == 0)
    return;
  memcpy(maximum, a->channels.maximum, bytes);
  memcpy(time_of_maximum, a->channels.time_maximum, bytes);
  memcpy(minimum, a->channels.minimum, bytes);
  memcpy(time_of_minimum, a->channels.time_minimum, bytes);
  memcpy(last, a->channels.last, bytes);
}

void ed_angles(const ed_analysis *a, double *angle)
{
  if (a->channels.n > 0)
    memcpy(angle, a->channels.angle, (size_t)a->channels.n * sizeof *angle);
}
