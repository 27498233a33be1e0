/* The table of amendments, and a law's force with them. */
#include "damper/amendment.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* offsets in the amendments' state: force of the law with its factors, and without; those of the single ones follow */
enum { BEGUN, FORCE, LAW_FORCE, FIRST_STATE };

/* With a brace jumps of the force rise over this deformation, in the caller's unit of length (a hundredth of a millimetre). */
static const double JUMP = 1e-5;

static const ed_amendment_kind *kind_of(int id)
{
  static const ed_amendment_kind *const kinds[] = {
      [ED_AMEND_CONSTANT] = &ed_amend_constant,
      [ED_AMEND_PAYNE_WHOLE] = &ed_amend_payne_whole,
      [ED_AMEND_PAYNE_ELASTIC] = &ed_amend_payne_elastic,
      [ED_AMEND_MULLINS_PATH] = &ed_amend_mullins_path,
      [ED_AMEND_MULLINS_MAXIMUM] = &ed_amend_mullins_maximum,
      [ED_AMEND_MULLINS_ELASTIC] = &ed_amend_mullins_elastic,
      [ED_AMEND_DEGRADATION_ENERGY] = &ed_amend_degradation_energy,
      [ED_AMEND_SELF_HEATING_RATE] = &ed_amend_self_heating_rate,
      [ED_AMEND_HARDENING_POWER] = &ed_amend_hardening_power,
      [ED_AMEND_HARDENING_THRESHOLD] = &ed_amend_hardening_threshold,
      [ED_AMEND_ONE_SIDED_FACTOR] = &ed_amend_one_sided_factor,
      [ED_AMEND_ONE_SIDED_SPRING] = &ed_amend_one_sided_spring,
      [ED_AMEND_RELAXATION_BRANCH_MAXWELL] = &ed_amend_relaxation_branch_maxwell,
      [ED_AMEND_VELOCITY_EXPONENT_DASHPOT] = &ed_amend_velocity_exponent_dashpot,
      [ED_AMEND_PAYNE_NETWORK] = &ed_amend_payne_network,
      [ED_AMEND_MULLINS_DAMAGE] = &ed_amend_mullins_damage,
      [ED_AMEND_VELOCITY_EXPONENT_FLOW] = &ed_amend_velocity_exponent_flow,
      [ED_AMEND_DEGRADATION_PATH] = &ed_amend_degradation_path,
      [ED_AMEND_ONE_SIDED_CONTACT] = &ed_amend_one_sided_contact,
      [ED_AMEND_ONE_SIDED_EVEN] = &ed_amend_one_sided_even,
  };
  return id >= 0 && id < (int)(sizeof kinds / sizeof *kinds) ? kinds[id] : NULL;
}

static int check(const ed_damper *damper, const ed_amendment_kind *kind, int id, int inside, int n_parameters, const double *parameters,
                 char message[ED_DAMPER_MESSAGE])
{
  if (inside && !damper->law->relaxation_time) {
    snprintf(message, ED_DAMPER_MESSAGE,
             "amendment %s: it can stand inside a law that relaxes all of its forces, as mgmm does, but law %s does not", kind->name,
             damper->law->name);
    return ED_E_ARGUMENT;
  }
  if (damper->brace > 0.0 && !ed_damper_is_braced(damper)) {
    snprintf(message, ED_DAMPER_MESSAGE,
             "amendment %s: law %s is integrated together with its brace, so that no amendment can stand between them; the brace "
             "must be rigid", kind->name, damper->law->name);
    return ED_E_ARGUMENT;
  }
  char why[ED_DAMPER_MESSAGE];
  const int status = ed_check_parameters(&ed_amendment_parameters[id], n_parameters, parameters, why);
  if (status != ED_OK)
    snprintf(message, ED_DAMPER_MESSAGE, "amendment %s: %.*s", kind->name, ED_DAMPER_MESSAGE / 2, why);
  return status;
}

int ed_damper_add_amendment(ed_damper *damper, int id, int inside, int n_parameters, const double *parameters,
                            char message[ED_DAMPER_MESSAGE])
{
  const ed_amendment_kind *kind = kind_of(id);
  if (!kind) {
    snprintf(message, ED_DAMPER_MESSAGE, "there is no amendment %d", id);
    return ED_E_ID;
  }
  const int status = check(damper, kind, id, inside, n_parameters, parameters, message);
  if (status != ED_OK)
    return status;
  ed_amendment *grown = realloc(damper->amendments, ((size_t)damper->n_amendments + 1) * sizeof *grown);
  if (!grown) {
    snprintf(message, ED_DAMPER_MESSAGE, "out of memory");
    return ED_E_MEMORY;
  }
  if (damper->n_amendments == 0)
    damper->n_amended = FIRST_STATE;
  damper->amendments = grown;
  ed_amendment *added = &grown[damper->n_amendments++];
  *added = (ed_amendment){.kind = kind, .state = damper->n_amended};
  memcpy(added->parameter, parameters, (size_t)n_parameters * sizeof *parameters);
  damper->n_amended += kind->has_state;
  if (inside) {
    added->tau = damper->law->relaxation_time(damper);
    added->relaxed = damper->n_amended;
    damper->n_amended += 2;
  }
  damper->rate_independent &= !kind->on_speed && !inside;
  return ED_OK;
}

void ed_amendments_start(const ed_damper *damper, double *state, int begun)
{
  double *own = state + damper->n_ode + damper->n_memory, unused = 0.0;
  if (damper->n_amendments > 0)
    own[BEGUN] = begun;
  for (int i = 0; i < damper->n_amendments; i++) {
    const ed_amendment *one = &damper->amendments[i];
    const ed_ends rest = {.h = 1.0};
    ed_amended found = {0};
    if (one->tau > 0.0) {
      one->kind->at_end(one->parameter, 0.0, &rest, &unused, &found);
      own[one->relaxed + 1] = one->kind->is_factor ? found.value - 1.0 : found.value;
    }
  }
}

void ed_amendments_keep(const ed_damper *damper, const double *before, double *state)
{
  const int first = damper->n_ode + damper->n_memory;
  if (damper->n_amendments == 0)
    return;
  memcpy(state + first + FIRST_STATE, before + first + FIRST_STATE, (size_t)(damper->n_amended - FIRST_STATE) * sizeof *state);
  state[first + BEGUN] = 0.0;
}

void ed_amendments_jump(const ed_damper *damper, double *state, const double *after)
{
  const int first = damper->n_ode + damper->n_memory;
  if (damper->n_amendments == 0)
    return;
  state[first + FORCE] = after[first + FORCE];
  state[first + LAW_FORCE] = after[first + LAW_FORCE];
  for (int i = 0; i < damper->n_amendments; i++) {
    const ed_amendment *one = &damper->amendments[i];
    if (one->tau > 0.0 && !one->kind->is_factor)
      state[first + one->relaxed + 1] = after[first + one->relaxed + 1];
  }
}

static void multiply(ed_amended *product, const ed_amended *factor)
{
  product->by_u1 = product->by_u1 * factor->value + product->value * factor->by_u1;
  product->value *= factor->value;
}

static void add(ed_amended *sum, const ed_amended *force)
{
  sum->value += force->value;
  sum->by_u1 += force->by_u1;
  sum->by_v0 += force->by_v0;
  sum->by_v1 += force->by_v1;
  sum->chord += force->chord;
}

/* Factors depend on the deformation alone, parallel forces on the velocities too. All of the force works. */
int ed_amend(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
             ed_damper_force *out)
{
  const int first = damper->n_ode + damper->n_memory;
  const double *before = committed + first, h = path->h, u1 = ed_path_u(path, h);
  double *after = trial + first;
  const ed_ends ends = {.h = h, .du = before[BEGUN] != 0.0 ? u1 - path->c[0] : 0.0, .u1 = u1, .v0 = path->c[1],
                        .v1 = ed_path_v(path, h), .jump = damper->brace + damper->joint > 0.0 ? JUMP : 0.0};
  ed_amended factor = {.value = 1.0}, beside = {0};
  double by_law = 0.0;
  for (int i = 0; i < damper->n_amendments; i++) {
    const ed_amendment *one = &damper->amendments[i];
    double unused = 0.0, *state = one->kind->has_state ? &after[one->state] : &unused;
    ed_amended found = {0};
    one->kind->at_end(one->parameter, one->kind->has_state ? before[one->state] : 0.0, &ends, state, &found);
    if (one->tau > 0.0)
      ed_amend_inside(one, &found, h, before[LAW_FORCE], out->force, before, after, &beside, &by_law);
    else if (one->kind->is_factor)
      multiply(&factor, &found);
    else
      add(&beside, &found);
  }
  const double force = factor.value * out->force + beside.value, work = 0.5 * (before[FORCE] + force) * ends.du;
  for (int i = 0; i < damper->n_amendments; i++) {
    const ed_amendment *one = &damper->amendments[i];
    if (one->kind->worked)
      after[one->state] = one->kind->worked(one->parameter, before[one->state], h, work);
  }
  after[BEGUN] = 1.0;
  after[FORCE] = force;
  after[LAW_FORCE] = out->force;
  const double of_law = factor.value + by_law;
  for (int j = 0; j < 2; j++) {
    const double u = ed_path_u(&direction[j], h), v0 = direction[j].c[1], v1 = ed_path_v(&direction[j], h);
    out->slope[j] = of_law * out->slope[j] + out->force * factor.by_u1 * u + beside.by_u1 * u + beside.by_v0 * v0 +
                    beside.by_v1 * v1;
    out->chord[j] = of_law * out->chord[j] + beside.chord * v1;
  }
  out->force = force;
  return isfinite(out->force + out->slope[0] + out->slope[1]) ? ED_OK : ED_E_NOT_FINITE;
}
