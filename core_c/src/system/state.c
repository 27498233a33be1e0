/* Committed and trial state, each one block copied whole. The layers' committed state is advanced only by a commit; trial
 * evaluations never write it, so that a failed attempt leaves nothing behind. */
#include "base/lanes.h"
#include "system/analysis.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of a state: 16 GB. */
static const long MOST_DOUBLES = INT_MAX;

static int head_size(void)
{
  return (int)((sizeof(ed_state_head) + sizeof(double) - 1) / sizeof(double));
}

static void point_into_block(ed_state *state, const ed_analysis *a)
{
  double *next = state->block;
  state->head = (ed_state_head *)(void *)next;
  next += head_size();
  double **vectors[] = {&state->u, &state->v, &state->a, &state->resisting, &state->damping, &state->mean_velocity, &state->mean_velocity_before};
  for (int i = 0; i < 7; i++) {
    *vectors[i] = next;
    next += a->numbering.n;
  }
  double **of_supports[] = {&state->support_u, &state->support_v, &state->support_a, &state->support_force};
  for (int i = 0; i < 4; i++) {
    *of_supports[i] = next;
    next += a->numbering.n_supports;
  }
  state->p_delta = next;
  state->elements = next + ed_p_delta_size(a->model) * a->model->n_members;
  state->devices = state->elements + a->storage.element_blocks;
}

int ed_state_allocate(ed_analysis *a)
{
  long blocks = 0, layers = 0, records = 0, devices = 0; /* offsets are whole numbers of 32 bits */
  for (int m = 0; m < a->model->n_members; m++) {
    ed_element *e = &a->members.element[m];
    e->state = (int)blocks;
    e->layers = (int)layers;
    blocks += ed_element_block_size(e);
    layers += ed_element_layer_size(e);
    records += ed_element_record_size(e);
    if (blocks + layers > MOST_DOUBLES)
      return ED_E_MEMORY;
  }
  a->storage.element_blocks = (int)blocks;
  a->devices.block = calloc((size_t)a->model->n_devices + 1, sizeof *a->devices.block);
  if (!a->devices.block)
    return ED_E_MEMORY;
  for (int i = 0; i < a->model->n_devices; i++) {
    a->devices.block[i] = (int)devices;
    devices += ed_device_block_size(&a->model->devices[i]);
    if (devices > MOST_DOUBLES)
      return ED_E_MEMORY;
  }
  const long size = head_size() + 7L * a->numbering.n + 4L * a->numbering.n_supports + (long)ed_p_delta_size(a->model) * a->model->n_members + blocks + devices;
  if (size + layers + a->model->n_patterns > MOST_DOUBLES)
    return ED_E_MEMORY;
  a->storage.size = (int)size;
  a->storage.layer_size = (int)layers;
  a->trial.block = calloc((size_t)a->storage.size, sizeof(double));
  a->committed.block = calloc((size_t)a->storage.size, sizeof(double));
  a->storage.block_backup = malloc((size_t)a->storage.size * sizeof(double));
  a->storage.layers = calloc((size_t)layers + 1, sizeof(double));
  a->storage.records = calloc((size_t)records + 1, sizeof(double));
  a->storage.layers_backup = malloc(((size_t)layers + 1) * sizeof(double));
  if (!a->trial.block || !a->committed.block || !a->storage.block_backup || !a->storage.layers || !a->storage.layers_backup || !a->storage.records)
    return ED_E_MEMORY;
  point_into_block(&a->trial, a);
  point_into_block(&a->committed, a);
  double *next = a->storage.records;
  for (int m = 0; m < a->model->n_members; m++) {
    ed_element *e = &a->members.element[m];
    ed_element_initialise(e, a->trial.elements + e->state, a->storage.layers + e->layers);
    ed_element_place_records(e, next);
    next += ed_element_record_size(e);
  }
  const int status = ed_devices_allocate(a);
  memcpy(a->committed.block, a->trial.block, (size_t)a->storage.size * sizeof(double));
  return status;
}

void ed_storage_free(ed_storage *storage)
{
  free(storage->layers);
  free(storage->layers_backup);
  free(storage->block_backup);
  free(storage->records);
}

static void copy_factors(ed_analysis *a, double *to, const double *from)
{
  memcpy(to, from, (size_t)a->model->n_patterns * sizeof *to);
}

void ed_commit(ed_analysis *a)
{
  double dissipated = 0.0;
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    dissipated += ed_element_commit(e, a->trial.elements + e->state, a->storage.layers + e->layers);
  }
  if (a->settings.energy)
    ed_count_energy(a, dissipated);
  if (a->run.kind != ED_RUN_HISTORY)
    ed_remember_loads(a);
  else if (ed_installed(a))
    for (int i = 0; i < a->numbering.n; i++) {
      a->trial.mean_velocity_before[i] = a->committed.mean_velocity[i];
      a->trial.mean_velocity[i] = (a->trial.u[i] - a->committed.u[i]) / a->devices.duration;
    }
  memcpy(a->committed.block, a->trial.block, (size_t)a->storage.size * sizeof(double));
  copy_factors(a, a->loading.factors_committed, a->loading.factors);
  a->factors.kept.valid = 0;
}

void ed_revert(ed_analysis *a)
{
  memcpy(a->trial.block, a->committed.block, (size_t)a->storage.size * sizeof(double));
  copy_factors(a, a->loading.factors, a->loading.factors_committed);
  ed_set_factors(a);
  ed_collect_forces(a);
  ed_restore_factors(a);
}

void ed_backup(ed_analysis *a)
{
  memcpy(a->storage.block_backup, a->committed.block, (size_t)a->storage.size * sizeof(double));
  memcpy(a->storage.layers_backup, a->storage.layers, (size_t)a->storage.layer_size * sizeof(double));
  copy_factors(a, a->loading.factors_backup, a->loading.factors_committed);
  ed_note_factors(a, &a->factors.backed);
}

void ed_restore(ed_analysis *a)
{
  memcpy(a->committed.block, a->storage.block_backup, (size_t)a->storage.size * sizeof(double));
  memcpy(a->storage.layers, a->storage.layers_backup, (size_t)a->storage.layer_size * sizeof(double));
  copy_factors(a, a->loading.factors_committed, a->loading.factors_backup);
  a->factors.stamp = -1;
  const ed_kept_factors kept = a->factors.kept; /* the two change places */
  a->factors.kept = a->factors.backed;
  a->factors.backed = kept;
  ed_revert(a);
  ed_remember_loads(a);
}

static int all_finite(const double *value, int n)
{
  ed_lanes nothing = {0}; /* stays 0 unless a value is not finite; a sum needs no branch */
  int i = 0;
  for (; i + ED_LANE_WIDTH <= n; i += ED_LANE_WIDTH)
    nothing += 0.0 * ED_LOAD(value + i);
  for (; i < n; i++)
    nothing[0] += 0.0 * value[i];
  const ed_mask some = nothing != (ed_lanes){0};
  return !ED_ANY(some);
}

int ed_state_finite(const ed_storage *storage, const ed_state *state)
{
  return all_finite(state->block, storage->size) && all_finite(storage->layers, storage->layer_size);
}

int ed_state_size(const ed_analysis *a)
{
  return a->storage.size + a->storage.layer_size + a->model->n_patterns;
}

void ed_state_get(const ed_analysis *a, double *state)
{
  memcpy(state, a->committed.block, (size_t)a->storage.size * sizeof(double));
  memcpy(state + a->storage.size, a->storage.layers, (size_t)a->storage.layer_size * sizeof(double));
  memcpy(state + a->storage.size + a->storage.layer_size, a->loading.factors_committed, (size_t)a->model->n_patterns * sizeof(double));
}

int ed_state_set(ed_analysis *a, const double *state)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "the state cannot be set during a run");
  const int size = ed_state_size(a);
  for (int i = 0; i < size; i++)
    if (!isfinite(state[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "value %d of %d of the state is not a finite number", i + 1, size);
  for (int m = 0; m < a->model->n_members; m++)
    if (!ed_element_layers_valid(&a->members.element[m], state + a->storage.size + a->members.element[m].layers))
      return ed_fail(a, ED_E_ARGUMENT, "the state is of another model: element %s", a->model->members[m].name);
  memcpy(a->committed.block, state, (size_t)a->storage.size * sizeof(double));
  memcpy(a->storage.layers, state + a->storage.size, (size_t)a->storage.layer_size * sizeof(double));
  memcpy(a->loading.factors_committed, state + a->storage.size + a->storage.layer_size, (size_t)a->model->n_patterns * sizeof(double));
  ed_revert(a);
  ed_remember_loads(a);
  return ED_OK;
}
