/* A law's force with its effects. */
#include "damper/effect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* offsets in the effects' state: force of the law with its factors, and without; those of the single ones follow */
enum { BEGUN, FORCE, LAW_FORCE, FIRST_STATE };

/* With a brace jumps of the force rise over this deformation, in the caller's unit of length (a hundredth of a millimetre). */
static const double JUMP = 1e-5;

int ed_effect_add(ed_damper *damper, int id, int placement, int n_parameters, const double *parameters,
                            char message[ED_DAMPER_MESSAGE])
{
  const ed_effect_form *form = ed_effect_form_of(id);
  if (!form) {
    snprintf(message, ED_DAMPER_MESSAGE, "there is no effect %d", id);
    return ED_E_ID;
  }
  if (placement != ED_PLACE_WHOLE && placement != ED_PLACE_INSIDE && !ed_of_side(placement)) {
    snprintf(message, ED_DAMPER_MESSAGE, "effect %s: there is no placement %d", form->name, placement);
    return ED_E_ID;
  }
  int status = ed_effect_check(damper, form, id, placement, n_parameters, parameters, message);
  if (status != ED_OK)
    return status;
  ed_effect *grown = realloc(damper->effects, ((size_t)damper->n_effects + 1) * sizeof *grown);
  if (grown)
    damper->effects = grown;
  const int splits = ed_of_side(placement) && !damper->springs;
  status = !grown ? ED_E_MEMORY : splits ? ed_sides_new(damper, message) : ED_OK;
  if (status == ED_E_MEMORY)
    snprintf(message, ED_DAMPER_MESSAGE, "out of memory");
  if (status != ED_OK)
    return status;
  if (damper->n_effects == 0)
    damper->n_effect_state = FIRST_STATE;
  if (splits) {
    damper->at_sides = damper->n_effect_state;
    damper->n_effect_state += ed_sides_size(damper);
  }
  ed_effect *added = &grown[damper->n_effects++];
  *added = (ed_effect){.form = form, .placement = placement, .state = damper->n_effect_state};
  memcpy(added->parameter, parameters, (size_t)n_parameters * sizeof *parameters);
  damper->n_effect_state += form->has_state;
  if (placement == ED_PLACE_INSIDE) {
    added->tau = damper->law->relaxation_time(damper);
    added->relaxed = damper->n_effect_state;
    damper->n_effect_state += 2;
  }
  damper->rate_independent &= !form->on_speed && placement == ED_PLACE_WHOLE;
  return ED_OK;
}

int ed_effect_remembers(int id)
{
  const ed_effect_form *form = ed_effect_form_of(id);
  return form ? form->has_state : ED_E_ID;
}

void ed_effects_start(const ed_damper *damper, double *state, int begun)
{
  double *own = state + damper->n_ode + damper->n_memory, unused = 0.0, side[ED_SIDES] = {1.0, 1.0};
  if (damper->n_effects > 0)
    own[BEGUN] = begun;
  for (int i = 0; i < damper->n_effects; i++) {
    const ed_effect *one = &damper->effects[i];
    const ed_ends rest = {.h = 1.0};
    ed_effect_value found = {0};
    if (one->placement == ED_PLACE_WHOLE)
      continue;
    one->form->at_end(one->parameter, 0.0, &rest, &unused, &found);
    if (one->placement == ED_PLACE_INSIDE)
      own[one->relaxed + 1] = one->form->is_factor ? found.value - 1.0 : found.value;
    else
      side[one->placement - ED_PLACE_SPRINGS] *= found.value;
  }
  if (damper->springs)
    ed_sides_start(damper, side, own + damper->at_sides);
}

void ed_effects_keep(const ed_damper *damper, const double *before, double *state)
{
  const int first = damper->n_ode + damper->n_memory;
  const double *from = before + first;
  double *own = state + first;
  for (int i = 0; i < damper->n_effects; i++) {
    const ed_effect *one = &damper->effects[i];
    if (one->form->has_state)
      own[one->state] = one->form->rested ? one->form->rested(one->parameter, from[one->state]) : from[one->state];
    if (one->placement == ED_PLACE_INSIDE)
      memcpy(own + one->relaxed, from + one->relaxed, 2 * sizeof *own);
  }
  if (damper->n_effects > 0)
    own[BEGUN] = 0.0;
  if (damper->springs)
    ed_sides_keep(from + damper->at_sides, own + damper->at_sides);
}

void ed_effects_keep_law(const ed_damper *damper, const double *before, double *state)
{
  const int sides = damper->n_ode + damper->n_memory + damper->at_sides;
  if (damper->springs)
    ed_sides_keep_law(damper, before + sides, state + sides);
}

void ed_effects_jump(const ed_damper *damper, double *state, const double *after)
{
  const int first = damper->n_ode + damper->n_memory;
  if (damper->n_effects == 0)
    return;
  state[first + FORCE] = after[first + FORCE];
  state[first + LAW_FORCE] = after[first + LAW_FORCE];
  if (damper->springs)
    ed_sides_jump(state + first + damper->at_sides, after + first + damper->at_sides);
  for (int i = 0; i < damper->n_effects; i++) {
    const ed_effect *one = &damper->effects[i];
    if (one->placement == ED_PLACE_INSIDE && !one->form->is_factor)
      state[first + one->relaxed + 1] = after[first + one->relaxed + 1];
  }
}

static void multiply(ed_effect_value *product, const ed_effect_value *factor)
{
  product->by_law = product->by_law * factor->value + product->value * factor->by_law;
  product->by_u1 = product->by_u1 * factor->value + product->value * factor->by_u1;
  product->by_v1 = product->by_v1 * factor->value + product->value * factor->by_v1;
  product->value *= factor->value;
}

static void add(ed_effect_value *sum, const ed_effect_value *force)
{
  sum->value += force->value;
  sum->by_u1 += force->by_u1;
  sum->by_v0 += force->by_v0;
  sum->by_v1 += force->by_v1;
  sum->chord += force->chord;
  sum->by_law += force->by_law;
  for (int j = 0; j < 2; j++)
    sum->by_path[j] += force->by_path[j];
}

/* What one that is `found` at the end of a step makes inside the law. */
static void add_inside(const ed_effect *one, const ed_effect_value *found, double h, double law0, double law1, const double *before,
                       double *after, ed_effect_value *beside, double *by_law)
{
  const int at = one->relaxed;
  if (one->form->is_factor)
    ed_effect_relaxed_factor(one->tau, found, h, law0, law1, before + at, after + at, beside, by_law);
  else
    ed_effect_relaxed_force(one->tau, found, h, before + at, after + at, beside);
}

/* Factors depend on the deformation and the velocity of the end, parallel forces on that of the beginning too. All of the force works. */
int ed_effects_apply(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
             ed_damper_force *out)
{
  const int first = damper->n_ode + damper->n_memory;
  const double *before = committed + first, h = path->h, u1 = ed_path_u(path, h);
  double *after = trial + first;
  const int counts = before[BEGUN] != 0.0;
  const ed_ends ends = {.h = h, .du = counts ? u1 - path->c[0] : 0.0, .u1 = u1, .v0 = path->c[1], .v1 = ed_path_v(path, h), .law = out->force,
                        .jump = damper->brace + damper->joint > 0.0 ? JUMP : 0.0, .path = counts ? path : NULL, .direction = direction};
  ed_effect_value factor = {.value = 1.0}, side[ED_SIDES] = {{.value = 1.0}, {.value = 1.0}}, beside = {0};
  ed_damper_force sides = {0};
  double by_law = 0.0;
  for (int i = 0; i < damper->n_effects; i++) {
    const ed_effect *one = &damper->effects[i];
    double unused = 0.0, *state = one->form->has_state ? &after[one->state] : &unused;
    ed_effect_value found = {0};
    one->form->at_end(one->parameter, one->form->has_state ? before[one->state] : 0.0, &ends, state, &found);
    if (one->placement == ED_PLACE_INSIDE)
      add_inside(one, &found, h, before[LAW_FORCE], out->force, before, after, &beside, &by_law);
    else if (ed_of_side(one->placement))
      multiply(&side[one->placement - ED_PLACE_SPRINGS], &found);
    else if (one->form->is_factor)
      multiply(&factor, &found);
    else
      add(&beside, &found);
  }
  const int status = damper->springs ? ed_sides_act(damper, before + damper->at_sides, before[LAW_FORCE], path, direction, side,
                                                    after + damper->at_sides, out, &sides)
                                     : ED_OK;
  if (status != ED_OK)
    return status;
  const double law = out->force + sides.force, force = factor.value * law + beside.value, work = 0.5 * (before[FORCE] + force) * ends.du;
  for (int i = 0; i < damper->n_effects; i++) {
    const ed_effect *one = &damper->effects[i];
    if (one->form->worked)
      after[one->state] = one->form->worked(one->parameter, before[one->state], h, work);
  }
  after[BEGUN] = 1.0;
  after[FORCE] = force;
  after[LAW_FORCE] = out->force;
  const double of_law = factor.value + factor.by_law * law + by_law + beside.by_law;
  for (int j = 0; j < 2; j++) {
    const double u = ed_path_u(&direction[j], h), v0 = direction[j].c[1], v1 = ed_path_v(&direction[j], h);
    out->slope[j] = of_law * out->slope[j] + factor.value * sides.slope[j] + law * (factor.by_u1 * u + factor.by_v1 * v1) +
                    beside.by_u1 * u + beside.by_v0 * v0 + beside.by_v1 * v1 + beside.by_path[j];
    out->chord[j] = of_law * out->chord[j] + factor.value * sides.chord[j] + beside.chord * v1;
  }
  out->force = force;
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}
