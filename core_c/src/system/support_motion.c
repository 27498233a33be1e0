/* Supported degrees that move during a history, relative to the ground: elements and dampers see where they are, the equations of the
 * free degrees stay as they are.
 *
 * Proportional and modal damping act on v - sum shape v_s. The shape of a support is how the structure follows it slowly, with what its
 * dampers resist then. For damping proportional to the stiffness that the shape is of, this is the damping of all degrees, K_ff v +
 * K_fs v_s. Damping proportional to mass, and of modes, has no other meaning where supports move apart (Chopra, Dynamics of
 * Structures, 9.7). */
#include "system/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Forces on the free degrees when a support moves by 1, with the opposite sign. */
static void add_pull(ed_analysis *a, int support, double *pull)
{
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    int touches = 0;
    for (int i = 0; i < e->degrees; i++)
      touches |= a->numbering.support[e->dof[i]] == support;
    if (!touches)
      continue;
    double t[ED_MAX_DEGREES * ED_MAX_DEGREES];
    ed_member_tangent(a, m, a->trial.elements + e->state, t);
    for (int i = 0; i < e->degrees; i++)
      for (int j = 0; j < e->degrees; j++)
        if (a->numbering.equation[e->dof[i]] >= 0 && a->numbering.support[e->dof[j]] == support)
          pull[a->numbering.equation[e->dof[i]]] -= t[e->degrees * i + j];
  }
  for (int i = 0; ed_installed(a) && i < a->model->n_devices; i++) {
    const ed_device *device = &a->model->devices[i], *other = device->other < 0 ? NULL : &a->model->devices[device->other];
    for (int k = 0; k < device->n_terms; k++) {
      if (a->numbering.support[device->degree[k]] != support)
        continue;
      ed_add_along_device(&a->numbering, device, -ed_device_slope(&a->devices, &a->trial, i) * device->coefficient[k], pull);
      if (other)
        ed_add_along_device(&a->numbering, device, -ed_device_cross_slope(&a->devices, &a->trial, i) * other->coefficient[k], pull);
    }
  }
}

static int find_shape(ed_analysis *a, int support, double *shape)
{
  const double factor = a->devices.velocity_factor, duration = a->devices.duration;
  a->devices.velocity_factor = 0.0;
  a->run.kind = ED_RUN_STATIC; /* of dampers what they resist slowly */
  int status = ed_first_slopes(a);
  a->run.kind = ED_RUN_HISTORY;
  a->devices.duration = duration;
  if (status != ED_OK)
    return status;
  add_pull(a, support, shape);
  status = ed_factor_effective(a, 1.0, 0.0, 0.0);
  if (status == ED_OK)
    status = ed_solve_effective(a, 1, shape);
  a->devices.velocity_factor = factor;
  a->factors.stamp = -1; /* a history needs others */
  for (int i = 0; status == ED_OK && i < a->numbering.n; i++)
    if (!isfinite(shape[i]))
      status = ED_E_NOT_FINITE;
  return status;
}

int ed_history_support(ed_analysis *a, int node, int degree, const double *displacement, const double *velocity,
                       const double *acceleration)
{
  ed_run *run = &a->run;
  if (run->kind != ED_RUN_HISTORY || run->done > 0 || run->row > 0)
    return ed_fail(a, ED_E_STATE, "supports are given their motion between the beginning of a history and its first step");
  if (node < 0 || node >= a->model->n_nodes || degree < 0 || degree >= ed_degrees(a->model))
    return ed_fail(a, ED_E_ID, "there is no degree %d of node %d", degree, node);
  const int at = ed_degrees(a->model) * node + degree, support = a->numbering.support[at];
  if (support < 0)
    return ed_fail(a, ED_E_ARGUMENT, "degree %d of node %s has no support", degree, a->model->nodes[node].name);
  if (a->numbering.plan && a->numbering.plan[at].turn >= 0)
    return ed_fail(a, ED_E_ARGUMENT, "node %s is moved by a diaphragm; move its master %s", a->model->nodes[node].name,
                   a->model->nodes[a->model->nodes[node].master[degree]].name);
  for (int i = 0; i < run->n_motions; i++)
    if (run->motion[i].support == support)
      return ed_fail(a, ED_E_ARGUMENT, "degree %d of node %s has its motion already", degree, a->model->nodes[node].name);
  for (int i = 0; i < run->n_forces; i++)
    if (run->force[i].n_fixed > 0)
      return ed_fail(a, ED_E_ARGUMENT, "supports cannot move under a force of the history that acts on some");
  const size_t samples = (size_t)run->steps + 1;
  for (size_t i = 0; i < samples; i++)
    if (!isfinite(displacement[i]) || !isfinite(velocity[i]) || !isfinite(acceleration[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "motion of %s: sample %ld is not a finite number", a->model->nodes[node].name, (long)i + 1);
  if (displacement[0] != 0.0 || velocity[0] != 0.0)
    return ed_fail(a, ED_E_ARGUMENT, "the motion of %s does not begin at rest where it is", a->model->nodes[node].name);
  ed_support_motion *motions = realloc(run->motion, ((size_t)run->n_motions + 1) * sizeof *motions);
  if (!motions)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  run->motion = motions;
  double *block = calloc(3 * samples + (size_t)a->numbering.n, sizeof *block);
  if (!block)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  ed_support_motion motion = {.support = support,
                              .origin = a->committed.support_u[support],
                              .displacement = block,
                              .velocity = block + samples,
                              .acceleration = block + 2 * samples,
                              .shape = block + 3 * samples};
  memcpy(motion.displacement, displacement, samples * sizeof(double));
  memcpy(motion.velocity, velocity, samples * sizeof(double));
  memcpy(motion.acceleration, acceleration, samples * sizeof(double));
  const int status = find_shape(a, support, motion.shape);
  if (status != ED_OK) {
    free(block);
    return ed_fail(a, status, "motion of %s: the structure does not follow it slowly, it is unstable", a->model->nodes[node].name);
  }
  a->committed.support_a[support] = a->trial.support_a[support] = acceleration[0];
  motions[run->n_motions++] = motion;
  return ED_OK;
}

void ed_move_supports(ed_analysis *a, double position)
{
  const double p = fmin(position, 1.0), q = 1.0 - p, h = a->run.dt;
  const int i = a->run.done;
  for (int k = 0; k < a->run.n_motions; k++) {
    const ed_support_motion *motion = &a->run.motion[k];
    const double *d = motion->displacement + i, *v = motion->velocity + i, *acceleration = motion->acceleration + i;
    const double rise = d[1] - d[0];
    double u = d[1], speed = v[1];
    if (p < 1.0) { /* the cubic of Hermite */
      u = d[0] + p * p * (3.0 - 2.0 * p) * rise + h * p * q * (q * v[0] - p * v[1]);
      speed = 6.0 * p * q * rise / h + q * (1.0 - 3.0 * p) * v[0] + p * (3.0 * p - 2.0) * v[1];
    }
    a->trial.support_u[motion->support] = motion->origin + u;
    a->trial.support_v[motion->support] = speed;
    a->trial.support_a[motion->support] = q * acceleration[0] + p * acceleration[1];
  }
}

void ed_subtract_slow_motion(const ed_run *run, int n, const double *of_supports, double *vector)
{
  for (int k = 0; k < run->n_motions; k++) {
    const ed_support_motion *motion = &run->motion[k];
    const double moved = of_supports[motion->support];
    for (int i = 0; moved != 0.0 && i < n; i++)
      vector[i] -= motion->shape[i] * moved;
  }
}

/* Damping forces push the supports back by what they do on the shapes. */
double ed_support_work(const ed_analysis *a, double *damping)
{
  double work = 0.0;
  *damping = 0.0;
  for (int k = 0; k < a->run.n_motions; k++) {
    const ed_support_motion *motion = &a->run.motion[k];
    const int s = motion->support;
    const double moved = a->trial.support_u[s] - a->committed.support_u[s];
    double force = 0.0;
    for (int i = 0; i < a->numbering.n; i++)
      force += 0.5 * motion->shape[i] * (a->committed.damping[i] + a->trial.damping[i]);
    work += moved * (0.5 * (a->committed.support_force[s] + a->trial.support_force[s]) - force);
    *damping -= force * moved;
  }
  return work;
}

void ed_free_support_motions(ed_run *run)
{
  for (int k = 0; k < run->n_motions; k++)
    free(run->motion[k].displacement);
  free(run->motion);
  run->motion = NULL;
  run->n_motions = 0;
}
