/* How dampers begin to act: installation, slopes before the first step, forces with the first velocities of a history. */
#include "system/analysis.h"

#include <math.h>
#include <string.h>

int ed_install_dampers(ed_analysis *a)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "dampers are installed before a run");
  for (int i = 0; i < a->model->n_devices; i++) {
    double *now = ed_device_block(&a->devices, &a->committed, i);
    if (now[ED_DEVICE_INSTALLED] != 0.0)
      continue;
    now[ED_DEVICE_INSTALLED] = 1.0;
    now[ED_DEVICE_OFFSET] = ed_state_along_device(&a->numbering, &a->model->devices[i], a->committed.u, a->committed.support_u);
  }
  ed_revert(a);
  return ED_OK;
}

int ed_first_slopes(ed_analysis *a)
{
  if (!ed_installed(a))
    return ED_OK;
  ed_slowly(&a->devices);
  const int status = ed_update_devices(a, 0);
  if (status != ED_OK) {
    char name[2 * ED_NAME];
    ed_name_damper(a->model, &a->devices, name, sizeof name);
    return ed_fail(a, status, "%s: no state was found at the start", name);
  }
  for (int i = 0; i < a->model->n_devices; i++) { /* on supports alone no matrix would show it */
    const double *slope = ed_device_block(&a->devices, &a->trial, i) + ED_DEVICE_SLOPE;
    if (!isfinite(slope[0]) || !isfinite(slope[1]))
      return ed_fail(a, ED_E_NOT_FINITE, "damper %s: its stiffness at the start is not a finite number", a->model->devices[i].name);
  }
  for (int i = 0; i < a->model->n_devices; i++) {
    double *first = ed_device_block(&a->devices, &a->committed, i), *slow = ed_device_block(&a->devices, &a->trial, i);
    memcpy(first + ED_DEVICE_SLOPE, slow + ED_DEVICE_SLOPE, (ED_DEVICE_WORK - ED_DEVICE_SLOPE) * sizeof *first);
    memcpy(slow, first, (size_t)ed_device_block_size(&a->model->devices[i]) * sizeof *slow);
  }
  return ED_OK;
}

/* A share of a step too short to deform anything, and long against the rounding of its own length. */
static const double AT_ONCE = 1e-6;

/* Forces that the present velocities bring at once, when a history begins. */
int ed_start_devices(ed_analysis *a)
{
  if (!ed_installed(a))
    return ED_OK;
  double speed = 0.0; /* now, or where the last run ended */
  for (int i = 0; i < a->model->n_devices; i++)
    speed += fabs(ed_along_device(&a->numbering, &a->model->devices[i], a->committed.v)) +
             fabs(ed_device_block(&a->devices, &a->committed, i)[ED_DEVICE_VELOCITY]);
  if (speed == 0.0)
    return ED_OK;
  a->devices.duration = AT_ONCE * a->run.dt;
  for (int i = 0; i < a->numbering.n; i++)
    a->trial.u[i] += a->devices.duration * a->trial.v[i];
  const int status = ed_update_devices(a, 0);
  memcpy(a->trial.u, a->committed.u, (size_t)a->numbering.n * sizeof(double));
  for (int i = 0; status == ED_OK && i < a->model->n_devices; i++) {
    double *before = ed_device_block(&a->devices, &a->committed, i);
    const double *after = ed_device_block(&a->devices, &a->trial, i);
    before[ED_DEVICE_FORCE] = after[ED_DEVICE_FORCE];
    ed_effects_jump(&a->model->devices[i].damper, before + ED_DEVICE_LAW_STATE, after + ED_DEVICE_LAW_STATE);
  }
  ed_revert(a);
  memcpy(a->committed.resisting, a->trial.resisting, (size_t)a->numbering.n * sizeof(double)); /* the first step takes its share */
  memcpy(a->committed.support_force, a->trial.support_force, (size_t)a->numbering.n_supports * sizeof(double));
  return status;
}
