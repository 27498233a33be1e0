#include "damper/ode_segment.h"

#include "edcore.h"

#include <math.h>
#include <string.h>

double ed_ode_instants_apart(const ed_path *path)
{
  return 1e-10 * path->h;
}

double ed_ode_next_event(const ed_damper *damper, const ed_path *path, const double *memory, double from)
{
  const double later = from + ed_ode_instants_apart(path);
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
  return next < path->h - ed_ode_instants_apart(path) ? next : INFINITY;
}

/* Which way a block goes at t that turns itself. Where it has none, just after a turn of the path or of its own, the path decides. */
static void look_which_way(ed_ode_block *block, ed_ode_work *work, double t, double stop, const double *y)
{
  double speed = 0.0, u, v;
  ed_ode_own_velocity(block, work, t, y, &speed);
  ed_ode_motion(block, 0.5 * (t + stop), &u, &v);
  block->turn_level = 1e-12 * fmax(fabs(v), fabs(speed));
  if (block->turned)
    block->turn = -block->turn;
  else if (fabs(speed) > block->turn_level)
    block->turn = speed > 0.0 ? 1.0 : -1.0;
  else
    block->turn = block->way < 0.0 ? -1.0 : 1.0;
  block->turned = 0;
}

int ed_ode_begin(ed_ode_system *system, ed_ode_integrator *integrator, double t, double stop)
{
  const int status = ed_ode_integrator_begin(integrator, t, stop);
  for (int i = 0; status == ED_OK && i < system->n; i++) {
    ed_ode_block *block = &system->block[i];
    if (ed_ode_turns_itself(block->damper))
      look_which_way(block, system->work, t, stop, ed_ode_variables(integrator) + block->first);
  }
  return status;
}

/* A block that turns has been led past its turn by one smooth step: goes there again, and stops. */
int ed_ode_go(ed_ode_system *system, ed_ode_integrator *integrator, double stop, double *t)
{
  const double from = *t;
  double *y = ed_ode_variables(integrator);
  const size_t size = (size_t)integrator->n * (size_t)integrator->copies * sizeof *y;
  memcpy(system->before, y, size);
  int status = ed_ode_integrator_advance(integrator, stop, t), any = 0;
  if (status != ED_OK)
    return status;
  for (int i = 0; i < system->n; i++)
    any |= system->block[i].turned;
  if (!any)
    return ED_OK;
  const double turn = *t;
  memcpy(y, system->before, size);
  *t = from;
  if (turn <= from)
    return ED_OK;
  status = ed_ode_integrator_begin(integrator, from, turn);
  return status == ED_OK ? ed_ode_integrator_advance(integrator, turn, t) : status;
}
