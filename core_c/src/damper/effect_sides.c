/* Springs and dashpots of a law apart: F = F_s + F_d, F_s the force of the same law without its dashpots, which goes along as a damper of its
 * own. Factors phi_s and phi_d add (phi_s - 1) F_s + (phi_d - 1) F_d; in a law that relaxes all of its forces they act inside, each side
 * with its own F + tau F'. */
#include "damper/effect.h"

#include <stdlib.h>
#include <string.h>

/* offsets in the state of the sides; RELAXED: of each side what relaxes, and behind it its last factor less 1 */
enum { SPRINGS_FORCE, RELAXED, OF_SPRINGS = RELAXED + 2 * ED_SIDES };

int ed_sides_new(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  ed_damper *springs = calloc(1, sizeof *springs);
  if (!springs)
    return ED_E_MEMORY;
  springs->law = damper->law;
  springs->n_parameters = damper->n_parameters;
  memcpy(springs->parameter, damper->parameter, sizeof springs->parameter);
  memcpy(springs->prior_extremes, damper->prior_extremes, sizeof springs->prior_extremes);
  damper->law->without_dashpots(springs);
  const int status = springs->law->prepare(springs, message);
  if (status == ED_OK) {
    damper->springs = springs;
    return ED_OK;
  }
  ed_damper_clear(springs);
  free(springs);
  return status;
}

int ed_sides_size(const ed_damper *damper)
{
  return OF_SPRINGS + ed_damper_own_size(damper->springs);
}

void ed_sides_start(const ed_damper *damper, const double factor[ED_SIDES], double *own)
{
  const ed_damper *springs = damper->springs;
  if (springs->law->start)
    springs->law->start(springs, own + OF_SPRINGS);
  for (int i = 0; i < ED_SIDES; i++)
    own[RELAXED + 2 * i + 1] = factor[i] - 1.0;
}

void ed_sides_jump(double *own, const double *after)
{
  own[SPRINGS_FORCE] = after[SPRINGS_FORCE];
}

void ed_sides_keep(const double *before, double *own)
{
  memcpy(own + RELAXED, before + RELAXED, 2 * ED_SIDES * sizeof *own);
}

void ed_sides_keep_law(const ed_damper *damper, const double *before, double *own)
{
  const ed_damper *springs = damper->springs;
  if (springs->law->keep)
    springs->law->keep(springs, before + OF_SPRINGS, own + OF_SPRINGS);
}

int ed_sides_act(const ed_damper *damper, const double *before, double law0, const ed_path *path, const ed_path direction[2],
                 const ed_effect_value factor[ED_SIDES], double *after, const ed_damper_force *law, ed_damper_force *out)
{
  const ed_damper *springs = damper->springs;
  const double h = path->h, tau = damper->law->relaxation_time ? damper->law->relaxation_time(damper) : 0.0;
  const double first[ED_SIDES] = {before[SPRINGS_FORCE], law0 - before[SPRINGS_FORCE]};
  ed_damper_force side[ED_SIDES] = {{0}};
  const int status = springs->law->step(springs, before + OF_SPRINGS, path, direction, after + OF_SPRINGS, &side[0]);
  if (status != ED_OK)
    return status;
  after[SPRINGS_FORCE] = side[0].force;
  side[1].force = law->force - side[0].force;
  for (int j = 0; j < 2; j++) {
    side[1].slope[j] = law->slope[j] - side[0].slope[j];
    side[1].chord[j] = law->chord[j] - side[0].chord[j];
  }
  for (int i = 0; i < ED_SIDES; i++) {
    const double less = factor[i].value - 1.0, force = side[i].force;
    const int own = RELAXED + 2 * i;
    ed_effect_value made = {.value = less * force, .by_u1 = factor[i].by_u1 * force, .by_v1 = factor[i].by_v1 * force};
    double by_side = less;
    if (tau > 0.0) {
      made = (ed_effect_value){0};
      by_side = 0.0;
      ed_effect_relaxed_factor(tau, &factor[i], h, first[i], force, before + own, after + own, &made, &by_side);
    }
    out->force += made.value;
    for (int j = 0; j < 2; j++) {
      out->slope[j] += by_side * side[i].slope[j] + made.by_u1 * ed_path_u(&direction[j], h) + made.by_v1 * ed_path_v(&direction[j], h);
      out->chord[j] += by_side * side[i].chord[j];
    }
  }
  return ED_OK;
}
