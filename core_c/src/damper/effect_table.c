/* The table of the forms of effects, and what a damper takes of them. */
#include "damper/effect.h"

#include <stdio.h>

const ed_effect_form *ed_effect_form_of(int id)
{
  static const ed_effect_form *const forms[] = {
      [ED_EFFECT_CONSTANT] = &ed_effect_constant,
      [ED_EFFECT_PAYNE_WHOLE] = &ed_effect_payne_whole,
      [ED_EFFECT_PAYNE_ELASTIC] = &ed_effect_payne_elastic,
      [ED_EFFECT_MULLINS_PATH] = &ed_effect_mullins_path,
      [ED_EFFECT_MULLINS_MAXIMUM] = &ed_effect_mullins_maximum,
      [ED_EFFECT_MULLINS_ELASTIC] = &ed_effect_mullins_elastic,
      [ED_EFFECT_DEGRADATION_ENERGY] = &ed_effect_degradation_energy,
      [ED_EFFECT_SELF_HEATING_RATE] = &ed_effect_self_heating_rate,
      [ED_EFFECT_HARDENING_POWER] = &ed_effect_hardening_power,
      [ED_EFFECT_HARDENING_THRESHOLD] = &ed_effect_hardening_threshold,
      [ED_EFFECT_ONE_SIDED_FACTOR] = &ed_effect_one_sided_factor,
      [ED_EFFECT_ONE_SIDED_SPRING] = &ed_effect_one_sided_spring,
      [ED_EFFECT_RELAXATION_BRANCH_MAXWELL] = &ed_effect_relaxation_branch_maxwell,
      [ED_EFFECT_VELOCITY_EXPONENT_DASHPOT] = &ed_effect_velocity_exponent_dashpot,
      [ED_EFFECT_PAYNE_NETWORK] = &ed_effect_payne_network,
      [ED_EFFECT_MULLINS_DAMAGE] = &ed_effect_mullins_damage,
      [ED_EFFECT_VELOCITY_EXPONENT_FLOW] = &ed_effect_velocity_exponent_flow,
      [ED_EFFECT_DEGRADATION_PATH] = &ed_effect_degradation_path,
      [ED_EFFECT_ONE_SIDED_CONTACT] = &ed_effect_one_sided_contact,
      [ED_EFFECT_ONE_SIDED_EVEN] = &ed_effect_one_sided_even,
      [ED_EFFECT_PAYNE_EXPONENTIAL] = &ed_effect_payne_exponential,
      [ED_EFFECT_HARDENING_EXPONENTIAL] = &ed_effect_hardening_exponential,
      [ED_EFFECT_FRICTION_COULOMB] = &ed_effect_friction_coulomb,
      [ED_EFFECT_FRICTION_PRESLIDING] = &ed_effect_friction_presliding,
      [ED_EFFECT_FRICTION_STRIBECK] = &ed_effect_friction_stribeck,
      [ED_EFFECT_FRICTION_LOADED] = &ed_effect_friction_loaded,
      [ED_EFFECT_ONE_SIDED_VALVE] = &ed_effect_one_sided_valve,
      [ED_EFFECT_GAS_SPRING_POLYTROPIC] = &ed_effect_gas_spring_polytropic,
      [ED_EFFECT_ONE_SIDED_FORCE] = &ed_effect_one_sided_force,
      [ED_EFFECT_HARDENING_SATURATING] = &ed_effect_hardening_saturating,
      [ED_EFFECT_VELOCITY_EXPONENT_POSITION] = &ed_effect_velocity_exponent_position,
      [ED_EFFECT_HYSTERESIS_STRETCH] = &ed_effect_hysteresis_stretch,
      [ED_EFFECT_HYSTERESIS_BOUC_WEN] = &ed_effect_hysteresis_bouc_wen,
      [ED_EFFECT_PINCHING_SLIP] = &ed_effect_pinching_slip,
      [ED_EFFECT_LIMIT_FORCE] = &ed_effect_limit_force,
  };
  return id >= 0 && id < (int)(sizeof forms / sizeof *forms) ? forms[id] : NULL;
}

static int check_placement(const ed_damper *damper, const ed_effect_form *form, int placement, char message[ED_DAMPER_MESSAGE])
{
  const char *law = damper->law->name;
  if (placement == ED_PLACE_INSIDE && !damper->law->relaxation_time)
    snprintf(message, ED_DAMPER_MESSAGE,
             "effect %s: it can stand inside a law that relaxes all of its forces, as mgmm does, but law %s does not", form->name, law);
  else if (ed_of_side(placement) && !form->is_factor)
    snprintf(message, ED_DAMPER_MESSAGE, "effect %s: it is a force of its own, and only factors act on springs or dashpots alone",
             form->name);
  else if (ed_of_side(placement) && form->by_force)
    snprintf(message, ED_DAMPER_MESSAGE, "effect %s: it is proportional to the law's force, and does not act on springs or dashpots alone",
             form->name);
  else if (ed_of_side(placement) && !damper->law->without_dashpots)
    snprintf(message, ED_DAMPER_MESSAGE,
             "effect %s: it can act on springs or dashpots alone of a law whose force is a sum of both, as that of kelvin_voigt or mgmm "
             "is, but that of law %s is not", form->name, law);
  else
    return ED_OK;
  return ED_E_ARGUMENT;
}

int ed_effect_check(const ed_damper *damper, const ed_effect_form *form, int id, int placement, int n_parameters,
                       const double *parameters, char message[ED_DAMPER_MESSAGE])
{
  const int placed = check_placement(damper, form, placement, message);
  if (placed != ED_OK)
    return placed;
  if (damper->brace > 0.0 && !ed_damper_is_braced(damper)) {
    snprintf(message, ED_DAMPER_MESSAGE,
             "effect %s: law %s is integrated together with its brace, so that no effect can stand between them; the brace "
             "must be rigid", form->name, damper->law->name);
    return ED_E_ARGUMENT;
  }
  char why[ED_DAMPER_MESSAGE];
  const int status = ed_check_parameters(&ed_effect_parameters[id], n_parameters, parameters, why);
  if (status != ED_OK)
    snprintf(message, ED_DAMPER_MESSAGE, "effect %s: %.*s", form->name, ED_DAMPER_MESSAGE / 2, why);
  return status;
}
