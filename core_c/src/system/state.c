/* Committed and trial state, each one block copied whole. The layers' committed state is advanced only by a commit; trial
 * evaluations never write it, so that a failed attempt leaves nothing behind. */
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

static void point_into(ed_state *state, double *block, const ed_analysis *a)
{
  double *next = block;
  state->block = block;
  state->head = (ed_state_head *)(void *)next;
  next += head_size();
  double **vectors[] = {&state->u, &state->v, &state->a, &state->resisting, &state->damping, &state->pace, &state->pace_before};
  for (int i = 0; i < 7; i++) {
    *vectors[i] = next;
    next += a->n;
  }
  double **of_supports[] = {&state->support_u, &state->support_v, &state->support_a, &state->support_force};
  for (int i = 0; i < 4; i++) {
    *of_supports[i] = next;
    next += a->n_supports;
  }
  state->p_delta = next;
  state->elements = next + 2 * a->model->n_members;
  state->devices = state->elements + a->element_blocks;
}

int ed_state_allocate(ed_analysis *a)
{
  long blocks = 0, layers = 0, records = 0, devices = 0; /* offsets are whole numbers of 32 bits */
  for (int m = 0; m < a->model->n_members; m++) {
    ed_element *e = &a->elements[m];
    e->state = (int)blocks;
    e->layers = (int)layers;
    blocks += ed_element_block_size(e);
    layers += ed_element_layer_size(e);
    records += ed_element_record_size(e);
    if (blocks + layers > MOST_DOUBLES)
      return ED_E_MEMORY;
  }
  a->element_blocks = (int)blocks;
  a->device_block = calloc((size_t)a->model->n_devices + 1, sizeof *a->device_block);
  if (!a->device_block)
    return ED_E_MEMORY;
  for (int i = 0; i < a->model->n_devices; i++) {
    a->device_block[i] = (int)devices;
    devices += ed_device_block_size(&a->model->devices[i]);
    if (devices > MOST_DOUBLES)
      return ED_E_MEMORY;
  }
  const long size = head_size() + 7L * a->n + 4L * a->n_supports + 2L * a->model->n_members + blocks + devices;
  if (size + layers + a->model->n_patterns > MOST_DOUBLES)
    return ED_E_MEMORY;
  a->state_size = (int)size;
  a->layer_size = (int)layers;
  double *trial = calloc((size_t)a->state_size, sizeof *trial);
  double *committed = calloc((size_t)a->state_size, sizeof *committed);
  a->block_backup = malloc((size_t)a->state_size * sizeof(double));
  a->layers = calloc((size_t)layers + 1, sizeof(double));
  a->records = calloc((size_t)records + 1, sizeof(double));
  a->layers_backup = malloc(((size_t)layers + 1) * sizeof(double));
  point_into(&a->trial, trial, a);
  point_into(&a->committed, committed, a);
  if (!trial || !committed || !a->block_backup || !a->layers || !a->layers_backup || !a->records)
    return ED_E_MEMORY;
  double *next = a->records;
  for (int m = 0; m < a->model->n_members; m++) {
    ed_element *e = &a->elements[m];
    ed_element_initialise(e, a->trial.elements + e->state, a->layers + e->layers);
    ed_element_place_records(e, next);
    next += ed_element_record_size(e);
  }
  const int status = ed_devices_allocate(a);
  memcpy(a->committed.block, a->trial.block, (size_t)a->state_size * sizeof(double));
  return status;
}

static void copy_factors(ed_analysis *a, double *to, const double *from)
{
  memcpy(to, from, (size_t)a->model->n_patterns * sizeof *to);
}

void ed_commit(ed_analysis *a)
{
  double dissipated = 0.0;
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->elements[m];
    dissipated += ed_element_commit(e, a->trial.elements + e->state, a->layers + e->layers);
  }
  if (a->energy)
    ed_count_energy(a, dissipated);
  if (a->run.kind != ED_RUN_HISTORY)
    ed_remember_loads(a);
  else if (ed_installed(a))
    for (int i = 0; i < a->n; i++) {
      a->trial.pace_before[i] = a->committed.pace[i];
      a->trial.pace[i] = (a->trial.u[i] - a->committed.u[i]) / a->duration;
    }
  memcpy(a->committed.block, a->trial.block, (size_t)a->state_size * sizeof(double));
  copy_factors(a, a->factors_committed, a->factors);
  a->kept.valid = 0;
}

void ed_revert(ed_analysis *a)
{
  memcpy(a->trial.block, a->committed.block, (size_t)a->state_size * sizeof(double));
  copy_factors(a, a->factors, a->factors_committed);
  ed_set_factors(a);
  ed_collect_forces(a);
  ed_restore_factors(a);
}

void ed_backup(ed_analysis *a)
{
  memcpy(a->block_backup, a->committed.block, (size_t)a->state_size * sizeof(double));
  memcpy(a->layers_backup, a->layers, (size_t)a->layer_size * sizeof(double));
  copy_factors(a, a->factors_backup, a->factors_committed);
  ed_note_factors(a, &a->backed);
}

void ed_restore(ed_analysis *a)
{
  memcpy(a->committed.block, a->block_backup, (size_t)a->state_size * sizeof(double));
  memcpy(a->layers, a->layers_backup, (size_t)a->layer_size * sizeof(double));
  copy_factors(a, a->factors_committed, a->factors_backup);
  a->factored_stamp = -1;
  const ed_factored kept = a->kept; /* the two change places */
  a->kept = a->backed;
  a->backed = kept;
  ed_revert(a);
  ed_remember_loads(a);
}

static int all_finite(const double *value, int n)
{
  double nothing = 0.0; /* stays 0 unless a value is not finite; a sum needs no branch */
  for (int i = 0; i < n; i++)
    nothing += 0.0 * value[i];
  return nothing == 0.0;
}

int ed_state_finite(const ed_analysis *a)
{
  return all_finite(a->committed.block, a->state_size) && all_finite(a->layers, a->layer_size);
}

int ed_state_size(const ed_analysis *a)
{
  return a->state_size + a->layer_size + a->model->n_patterns;
}

void ed_state_get(const ed_analysis *a, double *state)
{
  memcpy(state, a->committed.block, (size_t)a->state_size * sizeof(double));
  memcpy(state + a->state_size, a->layers, (size_t)a->layer_size * sizeof(double));
  memcpy(state + a->state_size + a->layer_size, a->factors_committed, (size_t)a->model->n_patterns * sizeof(double));
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
    if (!ed_element_layers_valid(&a->elements[m], state + a->state_size + a->elements[m].layers))
      return ed_fail(a, ED_E_ARGUMENT, "the state is of another model: element %s", a->model->members[m].name);
  memcpy(a->committed.block, state, (size_t)a->state_size * sizeof(double));
  memcpy(a->layers, state + a->state_size, (size_t)a->layer_size * sizeof(double));
  memcpy(a->factors_committed, state + a->state_size + a->layer_size, (size_t)a->model->n_patterns * sizeof(double));
  ed_revert(a);
  ed_remember_loads(a);
  return ED_OK;
}
