/* Force histories: from sample to sample in one integration, begun anew only where the motion turns. Every sample ends a step:
 * between them the forces of these laws may change too fast for interpolation. */
#include "damper/ode_segment.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

static int sign(double x)
{
  return (x > 0.0) - (x < 0.0);
}

/* Signs of velocity and acceleration just behind the beginning (side 0) or just before the end (1) of an interval; a turn at the
 * very edge, which rounding puts to either side, belongs to the sample there. */
static void senses(const ed_path *path, int side, int sense[2])
{
  const double apart = ed_ode_instants_apart(path), end = side ? path->h : 0.0;
  double at[2], from = 0.0, to = path->h;
  const int n = ed_path_reversals(path, at);
  for (int i = 0; i < n; i++)
    if (at[i] > apart && at[i] < path->h - apart) {
      if (side)
        from = at[i];
      else
        to = fmin(to, at[i]);
    }
  sense[0] = sign(ed_path_v(path, 0.5 * (from + to)));
  sense[1] = sign(2.0 * path->c[2] + 6.0 * path->c[3] * end);
}

/* The next event behind the instant `from`, in interval *at or later (*at: where); the end of the samples when there is none. */
static double next_of_samples(const ed_damper *damper, const ed_ode_samples *samples, const double *memory, double from, int *at)
{
  const int last = samples->n - 1;
  int before[2] = {0, 0}, behind[2];
  ed_path path;
  for (int k = *at; k < last; k++) {
    const double begin = samples->time[k];
    ed_path_hermite(&path, samples->time[k + 1] - begin, samples->u[k], samples->v[k], samples->u[k + 1], samples->v[k + 1]);
    if (k > *at) {
      senses(&path, 0, behind);
      /* a turn at a sample itself; laws with events of their own may also ask for those of the velocity */
      if (behind[0] != before[0] || (damper->law->events && behind[1] != before[1])) {
        *at = k;
        return begin;
      }
    }
    const double next = begin + ed_ode_next_event(damper, &path, memory, k > *at ? 0.0 : from - begin);
    if (next < samples->time[k + 1]) {
      *at = k;
      return next;
    }
    senses(&path, 1, before);
  }
  *at = last;
  return samples->time[last];
}

int ed_ode_system_history(ed_ode_system *system, double *state, int n, const double *time, const double *u, const double *v,
                          double *force, int *done)
{
  ed_ode_integrator *integrator = &system->history;
  ed_ode_block *block = &system->block[0];
  const ed_damper *damper = block->damper;
  *done = 0;
  if (system->n != 1)
    return ED_E_STATE;
  double *y = ed_ode_variables(integrator), t = time[0];
  ed_ode_samples samples = {.n = n, .at = 0, .time = time, .u = u, .v = v};
  ed_damper_force out;
  int interval = 0;
  long segments = 0;
  if (n > 1)
    ed_path_hermite(&samples.path, time[1] - time[0], u[0], v[0], u[1], v[1]);
  else
    samples.path = (ed_path){0.0, {u[0], v[0], 0.0, 0.0}};
  memcpy(y, state, (size_t)damper->n_ode * sizeof *y);
  block->path = NULL;
  block->samples = &samples;
  block->direction = NULL;
  block->memory = state + damper->n_ode;
  block->moved = block->turned = 0;
  block->way = 0.0;
  if (!ed_ode_force(block, system->work, t, y, 0, &out))
    return ED_E_NOT_FINITE;
  force[0] = out.force;
  for (*done = 1; *done < n;) {
    const double stop = next_of_samples(damper, &samples, block->memory, t, &interval);
    int status = ed_ode_begin(system, integrator, t, stop);
    while (status == ED_OK && t < stop && !block->turned) {
      const int sample = time[*done] <= stop;
      status = ed_ode_go(system, integrator, sample ? time[*done] : stop, &t);
      if (status != ED_OK || block->turned || !sample)
        continue;
      if (!ed_ode_force(block, system->work, t, y, 0, &out))
        return ED_E_NOT_FINITE;
      force[(*done)++] = out.force;
      if (integrator->watch && ed_watch_step(integrator->watch))
        return ED_E_STOPPED;
      if (*done == n)
        break;
    }
    if (status != ED_OK)
      return status;
    if (++segments > ED_MOST_SEGMENTS + 10L * n)
      return ED_E_NOT_CONVERGED;
    ed_ode_remember(block, system->work, t, y, 0, 0);
    while (interval > 0 && time[interval] > t)
      interval--;
  }
  memcpy(state, y, (size_t)damper->n_ode * sizeof *y);
  return ED_OK;
}
