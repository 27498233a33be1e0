#include "damper/ode_system.h"

#include "damper/ode_segment.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double difference_share = 1e-7; /* of the deformation, in difference quotients */

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
  system->before = calloc((size_t)variables * (1 + ED_ODE_DIRECTIONS) + 1, sizeof(double));
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

void ed_ode_system_watch(ed_ode_system *system, ed_watch *watch)
{
  system->step.watch = system->history.watch = watch;
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

int ed_ode_system_step(ed_ode_system *system, const double *const *committed, const ed_path *path,
                       const ed_path (*direction)[2], double *const *trial, ed_damper_force *out)
{
  ed_ode_integrator *integrator = &system->step;
  const int n = system->n, stride = integrator->n;
  const double h = path[0].h;
  double *y = ed_ode_variables(integrator), t = 0.0;
  memset(y, 0, (size_t)stride * (size_t)integrator->copies * sizeof *y);
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
    block->next = ed_ode_next_event(damper, block->path, block->memory, 0.0);
    look_at_directions(block);
  }
  for (int segments = 0; t < h; segments++) {
    double stop = h;
    for (int i = 0; i < n; i++)
      stop = fmin(stop, system->block[i].next);
    if (segments >= ED_MOST_SEGMENTS * n)
      return ED_E_NOT_CONVERGED;
    int status = ed_ode_begin(system, integrator, t, stop);
    if (status == ED_OK)
      status = ed_ode_go(system, integrator, stop, &t);
    if (status != ED_OK)
      return status;
    if (t >= h)
      break;
    for (int i = 0; i < n; i++) {
      ed_ode_block *block = &system->block[i];
      if (block->next > t + ed_ode_instants_apart(block->path) && !block->turned)
        continue;
      ed_ode_remember(block, system->work, t, y + block->first, stride, 1);
      block->next = ed_ode_next_event(block->damper, block->path, block->memory, t);
    }
  }
  for (int i = 0; i < n; i++) {
    ed_ode_block *block = &system->block[i];
    if (!ed_ode_force(block, system->work, h, y + block->first, stride, &out[i]))
      return ED_E_NOT_FINITE;
    memcpy(trial[i], y + block->first, (size_t)block->damper->n_ode * sizeof *y);
    ed_ode_remember(block, system->work, h, y + block->first, stride, 0);
    const int status = block->damper->n_effects > 0
                           ? ed_effects_apply(block->damper, committed[i], &path[i], direction[i], trial[i], &out[i])
                           : ED_OK;
    if (status != ED_OK)
      return status;
  }
  return ED_OK;
}
