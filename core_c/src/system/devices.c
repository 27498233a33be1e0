/* Dampers in the frame: deformation and velocity from the degrees, force and tangent back to them.
 *
 * Over a step a damper sees the cubic through deformation and velocity at both ends, starting from its committed state in every
 * trial. Its tangent for Newton is dF/du + (dv/du of the step) dF/dv. Those whose law has no exact step go through SUNDIALS as one
 * system. Before ed_install_dampers they carry nothing; then the deformation of that moment is their zero. Those that carry from the
 * beginning are installed in the structure without loads. */
#include "damper/ode_system.h"
#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int ed_device_block_size(const ed_device *device)
{
  return ED_DEVICE_LAW_STATE + ed_damper_state_size(&device->damper);
}

static int allocate(ed_devices *devices, int n)
{
  const size_t count = (size_t)n;
  devices->path = calloc(count, sizeof *devices->path);
  devices->path_direction = calloc(count, sizeof *devices->path_direction);
  devices->out = calloc(count, sizeof *devices->out);
  devices->chord = calloc(count, sizeof *devices->chord);
  devices->oscillates = calloc(count, sizeof *devices->oscillates);
  devices->reach = calloc(count, sizeof *devices->reach);
  devices->old = calloc(count, sizeof *devices->old);
  devices->new = calloc(count, sizeof *devices->new);
  devices->by_ode = calloc(count, sizeof *devices->by_ode);
  return devices->path && devices->path_direction && devices->out && devices->chord && devices->oscillates && devices->reach &&
                 devices->old && devices->new && devices->by_ode
             ? ED_OK
             : ED_E_MEMORY;
}

static double find_reach(const ed_analysis *a, const ed_device *device)
{
  double most = 0.0;
  for (int k = 0; k < device->n_terms; k++)
    most = fmax(most, fabs(device->coefficient[k]) / (ed_is_rotation(a->model, device->degree[k]) ? a->numbering.length : 1.0));
  return most;
}

int ed_devices_allocate(ed_analysis *a)
{
  const int n = a->model->n_devices;
  if (n == 0)
    return ED_OK;
  const ed_damper **by_ode = malloc((size_t)n * sizeof *by_ode);
  int status = by_ode ? allocate(&a->devices, n) : ED_E_MEMORY;
  for (int i = 0; status == ED_OK && i < n; i++) {
    const ed_device *device = &a->model->devices[i];
    a->devices.bearings |= device->other >= 0;
    a->devices.reach[i] = find_reach(a, device);
    ed_damper_start(&device->damper, ed_device_block(&a->devices, &a->trial, i) + ED_DEVICE_LAW_STATE);
    ed_device_block(&a->devices, &a->trial, i)[ED_DEVICE_INSTALLED] = device->carries;
    if (!ed_damper_has_exact_step(&device->damper)) {
      by_ode[a->devices.n_by_ode] = &device->damper;
      a->devices.by_ode[a->devices.n_by_ode++] = i;
    }
  }
  if (status == ED_OK && a->devices.n_by_ode > 0)
    a->devices.ode_system = ed_ode_system_new(a->devices.n_by_ode, by_ode, a->devices.tolerance, &status);
  if (a->devices.ode_system)
    ed_ode_system_watch(a->devices.ode_system, &a->watch);
  free(by_ode);
  return status;
}

void ed_devices_free(ed_devices *devices)
{
  ed_ode_system_free(devices->ode_system);
  void *blocks[] = {devices->block, devices->path, devices->path_direction, devices->out,   devices->old,
                    devices->new,   devices->by_ode, devices->chord,        devices->oscillates, devices->reach};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
    free(blocks[i]);
}

/* Three years in seconds: nothing is left then of what the slowest laws remember, 2e3 s (edcore.h). */
static const double SLOWLY = 1e8;

void ed_slowly(ed_devices *devices)
{
  devices->duration = SLOWLY;
  devices->velocity_factor = 0.0;
}

double ed_along_device(const ed_numbering *numbering, const ed_device *device, const double *vector)
{
  double sum = 0.0;
  for (int k = 0; k < device->n_terms; k++) {
    const int equation = numbering->equation[device->degree[k]];
    if (equation >= 0)
      sum += device->coefficient[k] * vector[equation];
  }
  return sum;
}

/* The same of a state, with what supported degrees have of it. */
double ed_state_along_device(const ed_numbering *numbering, const ed_device *device, const double *vector, const double *of_supports)
{
  double sum = ed_along_device(numbering, device, vector);
  for (int k = 0; k < device->n_terms; k++) {
    const int support = numbering->support[device->degree[k]];
    if (support >= 0)
      sum += device->coefficient[k] * of_supports[support];
  }
  return sum;
}

void ed_add_along_device(const ed_numbering *numbering, const ed_device *device, double factor, double *vector)
{
  for (int k = 0; k < device->n_terms; k++) {
    const int equation = numbering->equation[device->degree[k]];
    if (equation >= 0)
      vector[equation] += factor * device->coefficient[k];
  }
}

double ed_device_force(const ed_devices *devices, const ed_state *state, int i)
{
  return ed_device_block(devices, state, i)[ED_DEVICE_FORCE];
}

double ed_expected_device_force(const ed_devices *devices, const ed_state *committed, int i)
{
  const double *before = ed_device_block(devices, committed, i);
  return before[ED_DEVICE_FORCE] + devices->duration * (2.0 * before[ED_DEVICE_FORCE_PACE] - before[ED_DEVICE_FORCE_PACE_BEFORE]);
}

double ed_device_slope(const ed_devices *devices, const ed_state *trial, int i)
{
  const double *slope = ed_device_block(devices, trial, i) + ED_DEVICE_SLOPE, *chord = devices->chord[i];
  const double tangent = slope[0] + devices->velocity_factor * slope[1];
  return devices->oscillating && devices->oscillates[i] ? tangent + chord[0] + devices->velocity_factor * chord[1] : tangent;
}

double ed_device_cross_slope(const ed_devices *devices, const ed_state *trial, int i)
{
  const double *cross = ed_device_block(devices, trial, i) + ED_DEVICE_CROSS;
  return cross[0] + devices->velocity_factor * cross[1];
}

/* The law's path over this step, from the degrees. A static step goes slowly from rest to rest, also after a history that ended in
 * motion: its velocities would lead far away in so long a time. */
static void set_path(ed_analysis *a, int i, ed_path *path)
{
  const ed_device *device = &a->model->devices[i];
  const int slow = a->run.kind != ED_RUN_HISTORY;
  const double *before = ed_device_block(&a->devices, &a->committed, i);
  double *now = ed_device_block(&a->devices, &a->trial, i);
  if (now[ED_DEVICE_INSTALLED] == 0.0) {
    ed_path_hermite(path, a->devices.duration, 0.0, 0.0, 0.0, 0.0);
    return;
  }
  const double scale = device->deformation_scale;
  const double v0 = slow ? 0.0 : ed_state_along_device(&a->numbering, device, a->committed.v, a->committed.support_v);
  now[ED_DEVICE_DEFORMATION] = ed_state_along_device(&a->numbering, device, a->trial.u, a->trial.support_u) - now[ED_DEVICE_OFFSET];
  const double velocity = slow ? 0.0 : ed_state_along_device(&a->numbering, device, a->trial.v, a->trial.support_v);
  a->devices.oscillates[i] = velocity * now[ED_DEVICE_VELOCITY] < 0.25 * now[ED_DEVICE_VELOCITY] * now[ED_DEVICE_VELOCITY];
  now[ED_DEVICE_VELOCITY] = velocity;
  ed_path_hermite(path, a->devices.duration, scale * before[ED_DEVICE_DEFORMATION], scale * v0, scale * now[ED_DEVICE_DEFORMATION],
                  scale * now[ED_DEVICE_VELOCITY]);
}

/* What presses on a damper over the weight for which its law holds. */
static double pressed(const ed_analysis *a, const ed_device *device)
{
  if (device->axial_spring < 0 || a->run.kind != ED_RUN_HISTORY)
    return 1.0;
  const double *spring = a->trial.elements + a->members.element[device->axial_spring].state;
  return fmax(-spring[ED_BLOCK_Q], 0.0) / device->weight;
}

static void take(ed_analysis *a, int i, const ed_damper_force *out)
{
  const ed_device *device = &a->model->devices[i];
  double *now = ed_device_block(&a->devices, &a->trial, i);
  if (now[ED_DEVICE_INSTALLED] == 0.0) { /* in one system with others that are */
    memcpy(now, ed_device_block(&a->devices, &a->committed, i), (size_t)ed_device_block_size(device) * sizeof *now);
    return;
  }
  const double scale = device->force_scale * pressed(a, device);
  now[ED_DEVICE_FORCE] = scale * out->force;
  now[ED_DEVICE_FORCE_PACE] = (now[ED_DEVICE_FORCE] - ed_device_block(&a->devices, &a->committed, i)[ED_DEVICE_FORCE]) / a->devices.duration;
  now[ED_DEVICE_FORCE_PACE_BEFORE] = ed_device_block(&a->devices, &a->committed, i)[ED_DEVICE_FORCE_PACE];
  for (int k = 0; k < 2; k++) {
    now[ED_DEVICE_SLOPE + k] = scale * device->deformation_scale * out->slope[k];
    a->devices.chord[i][k] = scale * device->deformation_scale * out->chord[k];
  }
}

/* A bearing, by the first of its directions. */
static int update_bearing(ed_analysis *a, int first)
{
  const int both[2] = {first, a->model->devices[first].other};
  const double *committed[2];
  double *trial[2];
  ed_path path[2];
  ed_pair_force found;
  for (int c = 0; c < 2; c++) {
    set_path(a, both[c], &path[c]);
    committed[c] = ed_device_block(&a->devices, &a->committed, both[c]) + ED_DEVICE_LAW_STATE;
    trial[c] = ed_device_block(&a->devices, &a->trial, both[c]) + ED_DEVICE_LAW_STATE;
  }
  const ed_device *device = &a->model->devices[first];
  const int status = device->damper.law->step_pair(&device->damper, committed, path, a->devices.direction, trial, &found);
  const double scale = device->force_scale * device->deformation_scale * pressed(a, device);
  for (int c = 0; status == ED_OK && c < 2; c++) {
    take(a, both[c], &(ed_damper_force){.force = found.force[c], .slope = {found.slope[c][c][0], found.slope[c][c][1]}});
    for (int j = 0; j < 2; j++)
      ed_device_block(&a->devices, &a->trial, both[c])[ED_DEVICE_CROSS + j] = scale * found.slope[c][1 - c][j];
  }
  return status;
}

static int update_by_ode(ed_analysis *a)
{
  for (int k = 0; k < a->devices.n_by_ode; k++) {
    const int i = a->devices.by_ode[k];
    set_path(a, i, &a->devices.path[k]);
    a->devices.old[k] = ed_device_block(&a->devices, &a->committed, i) + ED_DEVICE_LAW_STATE;
    a->devices.new[k] = ed_device_block(&a->devices, &a->trial, i) + ED_DEVICE_LAW_STATE;
    memcpy(a->devices.path_direction[k], a->devices.direction, sizeof a->devices.direction);
    memset(&a->devices.out[k], 0, sizeof a->devices.out[k]);
  }
  const int status = ed_ode_system_step(a->devices.ode_system, a->devices.old, a->devices.path,
                                        (const ed_path(*)[2])a->devices.path_direction, a->devices.new, a->devices.out);
  for (int k = 0; status == ED_OK && k < a->devices.n_by_ode; k++)
    take(a, a->devices.by_ode[k], &a->devices.out[k]);
  return status;
}

static int fail(ed_analysis *a, int device, int status)
{
  if (status == ED_E_STOPPED)
    return status;
  a->devices.failed = device;
  a->devices.status = status;
  return ED_E_DAMPER;
}

int ed_update_devices(ed_analysis *a, int rough)
{
  if (!ed_installed(a))
    return ED_OK;
  a->statistics.damper_updates += a->model->n_devices;
  ed_path_hermite_directions(a->devices.direction, a->devices.duration);
  for (int i = 0; i < a->model->n_devices; i++) {
    const ed_device *device = &a->model->devices[i];
    if (!ed_damper_has_exact_step(&device->damper) || ed_device_block(&a->devices, &a->trial, i)[ED_DEVICE_INSTALLED] == 0.0)
      continue;
    if (device->other >= 0) {
      const int status = device->other > i ? update_bearing(a, i) : ED_OK;
      if (status != ED_OK)
        return fail(a, i, status);
      continue;
    }
    ed_damper_force out = {0};
    ed_path path;
    set_path(a, i, &path);
    const int status = ed_damper_try(&device->damper, rough, ed_device_block(&a->devices, &a->committed, i) + ED_DEVICE_LAW_STATE, &path,
                                     a->devices.direction, ed_device_block(&a->devices, &a->trial, i) + ED_DEVICE_LAW_STATE, &out);
    if (status != ED_OK)
      return fail(a, i, status);
    take(a, i, &out);
  }
  const int status = a->devices.n_by_ode > 0 ? update_by_ode(a) : ED_OK;
  return status == ED_OK ? ED_OK : fail(a, a->devices.n_by_ode > 1 ? -1 : a->devices.by_ode[0], status);
}

void ed_name_damper(const ed_model *model, const ed_devices *devices, char *buffer, int size)
{
  const char *cause = devices->status == ED_E_NOT_FINITE ? "a number is not finite" : "it did not converge";
  if (devices->failed >= 0)
    snprintf(buffer, (size_t)size, "damper %s (%s)", model->devices[devices->failed].name, cause);
  else
    snprintf(buffer, (size_t)size, "one of the %d dampers that SUNDIALS integrates (%s)", devices->n_by_ode, cause);
}

void ed_add_device_forces(ed_analysis *a)
{
  for (int i = 0; i < a->model->n_devices; i++) {
    const ed_device *device = &a->model->devices[i];
    const double force = ed_device_block(&a->devices, &a->trial, i)[ED_DEVICE_FORCE];
    for (int k = 0; k < device->n_terms; k++)
      a->members.resisting[device->degree[k]] += device->coefficient[k] * force;
  }
}

double ed_largest_device_force(const ed_analysis *a)
{
  double largest = 0.0;
  for (int i = 0; i < a->model->n_devices; i++)
    largest = fmax(largest, a->devices.reach[i] * fabs(ed_device_force(&a->devices, &a->trial, i)));
  return largest;
}

int ed_installed(const ed_analysis *a)
{
  for (int i = 0; i < a->model->n_devices; i++)
    if (ed_device_block(&a->devices, &a->trial, i)[ED_DEVICE_INSTALLED] != 0.0)
      return 1;
  return 0;
}

/* k times the slope of every device, into a matrix of the pattern (nnz + 1). */
void ed_add_device_tangent(const ed_analysis *a, double k, double *matrix)
{
  if (!ed_installed(a))
    return;
  const int *place = a->matrix.device_scatter;
  for (int i = 0; i < a->model->n_devices; i++) {
    const ed_device *device = &a->model->devices[i];
    const double slope = k * ed_device_slope(&a->devices, &a->trial, i);
    for (int p = 0; p < device->n_terms; p++)
      for (int q = 0; q < device->n_terms; q++)
        matrix[*place++] += slope * device->coefficient[p] * device->coefficient[q];
    if (device->other < 0)
      continue;
    const double cross = k * ed_device_cross_slope(&a->devices, &a->trial, i), *across = a->model->devices[device->other].coefficient;
    place -= device->n_terms * device->n_terms;
    for (int q = 0; q < device->n_terms; q++) /* columns, as ed_build_pattern has them */
      for (int p = 0; p < device->n_terms; p++)
        matrix[*place++] += cross * device->coefficient[p] * across[q];
  }
  matrix[a->matrix.nnz] = 0.0;
}

/* Work done on the devices over the step, by the trapezoidal rule as that of all other forces. */
double ed_count_device_work(ed_analysis *a)
{
  double sum = 0.0;
  for (int i = 0; i < a->model->n_devices; i++) {
    const double *before = ed_device_block(&a->devices, &a->committed, i);
    double *now = ed_device_block(&a->devices, &a->trial, i);
    const double work = 0.5 * (before[ED_DEVICE_FORCE] + now[ED_DEVICE_FORCE]) * (now[ED_DEVICE_DEFORMATION] - before[ED_DEVICE_DEFORMATION]);
    now[ED_DEVICE_WORK] += work;
    sum += work;
  }
  return sum;
}

double ed_device_value(const ed_analysis *a, int kind, int device, int component)
{
  const ed_device *d = &a->model->devices[device];
  const double *now = ed_device_block(&a->devices, &a->committed, device);
  if (kind == ED_DAMPER_FORCE)
    return now[ED_DEVICE_FORCE];
  if (kind == ED_DAMPER_WORK)
    return now[ED_DEVICE_WORK];
  if (component == 2)
    return now[ED_DEVICE_LAW_STATE + d->damper.law->plastic_path - 1] / d->deformation_scale;
  if (component == 1 && d->damper.joint > 0.0)
    return now[ED_DEVICE_LAW_STATE + ed_damper_own_size(&d->damper)] / d->deformation_scale;
  const double brace = d->damper.brace * d->force_scale * d->deformation_scale;
  return component == 1 && brace > 0.0 ? now[ED_DEVICE_DEFORMATION] - now[ED_DEVICE_FORCE] / brace : now[ED_DEVICE_DEFORMATION];
}
