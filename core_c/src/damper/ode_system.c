#include "damper/ode_system.h"

#include "damper/ode_integrator.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SEGMENTS = 1000 }; /* of one step, for each damper */
static const double instants_apart = 1e-10; /* of the step: events closer together are one */
static const double difference_share = 1e-7; /* of the deformation, in difference quotients */

struct ed_ode_system {
  int n;
  ed_ode_block *block;
  ed_ode_work *work;
  double *memory_slopes;
  double *before; /* variables at the beginning of a segment */
  SUNContext context;
  ed_ode_integrator step, history; /* with and without sensitivities; the second only for one damper */
};

static int make(ed_ode_system *system, const ed_damper *const *damper, double tolerance)
{
  const int n = system->n;
  size_t memories = 0;
  int first = 0, variables = 0;
  for (int i = 0; i < n; i++) {
    if (!damper[i]->law->rate || damper[i]->n_ode > ED_MAX_ODE || damper[i]->n_memory > ED_MAX_ODE)
      return ED_E_STATE;
    memories += (size_t)damper[i]->n_memory;
  }
  system->block = calloc((size_t)n + 1, sizeof *system->block);
  system->work = calloc(1, sizeof *system->work);
  system->memory_slopes = calloc(2 * memories + 1, sizeof(double));
  for (int i = 0; i < n; i++)
    variables += damper[i]->n_ode;
  system->before = calloc((size_t)(variables * (1 + ED_ODE_DIRECTIONS)) + 1, sizeof(double));
  if (!system->block || !system->work || !system->memory_slopes || !system->before)
    return ED_E_MEMORY;
  double *slopes = system->memory_slopes;
  for (int i = 0; i < n; i++) {
    ed_ode_block *block = &system->block[i];
    block->damper = damper[i];
    block->first = first;
    first += damper[i]->n_ode;
    for (int k = 0; k < ED_ODE_DIRECTIONS; k++, slopes += damper[i]->n_memory)
      block->memory_slope[k] = slopes;
  }
#if SUNDIALS_VERSION_MAJOR < 7
  if (SUNContext_Create(NULL, &system->context))
    return ED_E_MEMORY;
#else
  if (SUNContext_Create(SUN_COMM_NULL, &system->context) || SUNContext_ClearErrHandlers(system->context))
    return ED_E_MEMORY;
#endif
  int status = ed_ode_integrator_new(&system->step, system->context, n, system->block, system->work, 1 + ED_ODE_DIRECTIONS,
                                     tolerance);
  if (status == ED_OK && n == 1)
    status = ed_ode_integrator_new(&system->history, system->context, 1, system->block, system->work, 1, tolerance);
  return status;
}

ed_ode_system *ed_ode_system_new(int n, const ed_damper *const *damper, double tolerance, int *status)
{
  if (n < 1 || !(tolerance > 0.0) || !(tolerance < 1.0)) {
    *status = ED_E_ARGUMENT;
    return NULL;
  }
  ed_ode_system *system = calloc(1, sizeof *system);
  if (!system) {
    *status = ED_E_MEMORY;
    return NULL;
  }
  system->n = n;
  *status = make(system, damper, tolerance);
  if (*status == ED_OK)
    return system;
  ed_ode_system_free(system);
  return NULL;
}

void ed_ode_system_free(ed_ode_system *system)
{
  if (!system)
    return;
  ed_ode_integrator_clear(&system->step);
  ed_ode_integrator_clear(&system->history);
  if (system->context)
    SUNContext_Free(&system->context);
  free(system->before);
  free(system->memory_slopes);
  free(system->work);
  free(system->block);
  free(system);
}

/* The first event of a damper on a path behind `from`; infinity: none. */
static double next_event(const ed_damper *damper, const ed_path *path, const double *memory, double from)
{
  const double later = from + instants_apart * path->h;
  double at[8], next = INFINITY;
  int n = ed_path_reversals(path, at);
  for (int i = 0; i < n; i++)
    if (at[i] > later)
      next = fmin(next, at[i]);
  if (damper->law->events) {
    ed_path piece;
    ed_path_piece(path, from, path->h, &piece);
    n = damper->law->events(damper, &piece, memory, at);
    for (int i = 0; i < n; i++)
      if (from + at[i] > later)
        next = fmin(next, from + at[i]);
  }
  return next < path->h * (1.0 - instants_apart) ? next : INFINITY;
}

/* Which way a block moves that turns itself. */
static void look_which_way(ed_ode_block *block, ed_ode_work *work, double t, const double *y)
{
  if (!ed_ode_turns_itself(block->damper) || !ed_ode_rate(block, t, y, &work->rate))
    return;
  const double speed = work->rate.y[0];
  block->turn = block->turned ? -block->turn : speed < 0.0 ? -1.0 : 1.0;
  block->turn_level = 1e-12 * fmax(fabs(speed), block->turn_level * 1e12);
}

/* How far the unknowns move the path, and changes of them that move it by a small share of its own deformation. */
static void look_at_directions(ed_ode_block *block)
{
  const ed_path *path = block->path;
  double size = 0.0;
  for (int i = 0; i <= 4; i++)
    size = fmax(size, fabs(ed_path_u(path, 0.25 * i * path->h)));
  size = fmax(size, fabs(path->c[1] * path->h));
  for (int k = 0; k < ED_ODE_DIRECTIONS; k++) {
    double reach = 0.0;
    for (int i = 1; i <= 4; i++)
      reach = fmax(reach, fabs(ed_path_u(&block->direction[k], 0.25 * i * path->h)));
    block->reach[k] = reach;
    block->difference[k] = size > 0.0 && reach > 0.0 ? difference_share * size / reach : 1.0;
  }
}

static size_t size_of(const ed_ode_integrator *integrator)
{
  return (size_t)(integrator->n * integrator->copies) * sizeof(double);
}

/* When a block has turned behind `from`, goes there again: what was computed until now went past it with one smooth step. */
static int stop_at_turn(ed_ode_system *system, ed_ode_integrator *integrator, double from, double *t)
{
  double turn = *t;
  memcpy(ed_ode_variables(integrator), system->before, size_of(integrator));
  *t = from;
  if (turn <= from)
    return ED_OK;
  const int status = ed_ode_integrator_begin(integrator, from, turn);
  return status == ED_OK ? ed_ode_integrator_advance(integrator, turn, t) : status;
}

/* Remembers which blocks have turned while they are led there again. */
static int turned(const ed_ode_system *system)
{
  for (int i = 0; i < system->n; i++)
    if (system->block[i].turned)
      return 1;
  return 0;
}

int ed_ode_system_step(ed_ode_system *system, const double *const *committed, const ed_path *path,
                       const ed_path (*direction)[2], double *const *trial, ed_damper_force *out)
{
  ed_ode_integrator *integrator = &system->step;
  const int n = system->n, stride = integrator->n;
  const double h = path[0].h;
  double *y = ed_ode_variables(integrator), t = 0.0;
  memset(y, 0, (size_t)(stride * integrator->copies) * sizeof *y);
  for (int i = 0; i < n; i++) {
    ed_ode_block *block = &system->block[i];
    const ed_damper *damper = block->damper;
    memcpy(y + block->first, committed[i], (size_t)damper->n_ode * sizeof *y);
    block->path = &path[i];
    block->samples = NULL;
    block->direction = direction[i];
    block->memory = trial[i] + damper->n_ode;
    memcpy(block->memory, committed[i] + damper->n_ode, (size_t)damper->n_memory * sizeof *y);
    block->moved = block->turned = 0;
    block->way = 0.0;
    block->turn_level = 0.0;
    block->next = next_event(damper, block->path, block->memory, 0.0);
    look_at_directions(block);
    look_which_way(block, system->work, 0.0, y + block->first);
  }
  for (int segments = 0; t < h; segments++) {
    double stop = h;
    for (int i = 0; i < n; i++)
      stop = fmin(stop, system->block[i].next);
    if (segments >= MOST_SEGMENTS * n)
      return ED_E_NOT_CONVERGED;
    int status = ed_ode_integrator_begin(integrator, t, stop);
    if (status == ED_OK)
      status = ed_ode_integrator_advance(integrator, stop, &t);
    if (status != ED_OK)
      return status;
    if (t >= h)
      break;
    for (int i = 0; i < n; i++) {
      ed_ode_block *block = &system->block[i];
      if (block->next > t + instants_apart * h && !block->turned)
        continue;
      ed_ode_remember(block, system->work, t, y + block->first, stride, 1);
      block->next = next_event(block->damper, block->path, block->memory, t);
      look_which_way(block, system->work, t, y + block->first);
    }
  }
  for (int i = 0; i < n; i++) {
    ed_ode_block *block = &system->block[i];
    if (!ed_ode_force(block, system->work, h, y + block->first, stride, &out[i]))
      return ED_E_NOT_FINITE;
    memcpy(trial[i], y + block->first, (size_t)block->damper->n_ode * sizeof *y);
    ed_ode_remember(block, system->work, h, y + block->first, stride, 0);
  }
  return ED_OK;
}

/* ---- histories ---- */

static int sign(double x)
{
  return (x > 0.0) - (x < 0.0);
}

/* Signs of velocity and acceleration just behind (side 0) or just before (1) the ends of an interval. */
static void senses(const ed_path *path, int side, int sense[2])
{
  double at[2], edge[2] = {0.0, path->h};
  int n = ed_path_reversals(path, at);
  if (n > 0)
    edge[1 - side] = side ? at[n - 1] : at[0];
  const double inside = 0.5 * (edge[0] + edge[1]);
  sense[0] = sign(ed_path_v(path, inside));
  const double end = side ? path->h : 0.0, acceleration = 2.0 * path->c[2] + 6.0 * path->c[3] * end;
  sense[1] = sign(acceleration);
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
    if (k > *at || from >= samples->time[k + 1]) {
      senses(&path, 0, behind);
      /* a turn at a sample itself; laws with events of their own may also ask for those of the velocity */
      if (k > *at && (behind[0] != before[0] || (damper->law->events && behind[1] != before[1]))) {
        *at = k;
        return begin;
      }
    }
    const double next = begin + next_event(damper, &path, memory, k > *at ? 0.0 : from - begin);
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
  block->turn_level = 0.0;
  look_which_way(block, system->work, t, y);
  if (!ed_ode_force(block, system->work, t, y, 0, &out))
    return ED_E_NOT_FINITE;
  force[0] = out.force;
  for (*done = 1; *done < n;) {
    const double stop = next_of_samples(damper, &samples, block->memory, t, &interval);
    int status = ed_ode_integrator_begin(integrator, t, stop);
    if (status != ED_OK)
      return status;
    while (t < stop) {
      const int sample = *done < n && time[*done] <= stop;
      status = ed_ode_integrator_advance(integrator, sample ? time[*done] : stop, &t);
      if (status != ED_OK)
        return status;
      if (block->turned)
        break;
      if (sample) {
        if (!ed_ode_force(block, system->work, t, y, 0, &out))
          return ED_E_NOT_FINITE;
        force[(*done)++] = out.force;
      }
    }
    ed_ode_remember(block, system->work, t, y, 0, 0);
    look_which_way(block, system->work, t, y);
    while (interval > 0 && time[interval] > t)
      interval--;
  }
  memcpy(state, y, (size_t)damper->n_ode * sizeof *y);
  return ED_OK;
}
