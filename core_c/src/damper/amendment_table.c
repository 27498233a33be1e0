/* The table of amendments, and what a damper takes of them. */
#include "damper/amendment.h"

#include <stdio.h>

const ed_amendment_kind *ed_amendment_kind_of(int id)
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
      [ED_AMEND_PAYNE_EXPONENTIAL] = &ed_amend_payne_exponential,
      [ED_AMEND_HARDENING_EXPONENTIAL] = &ed_amend_hardening_exponential,
      [ED_AMEND_FRICTION_COULOMB] = &ed_amend_friction_coulomb,
      [ED_AMEND_FRICTION_PRESLIDING] = &ed_amend_friction_presliding,
      [ED_AMEND_FRICTION_STRIBECK] = &ed_amend_friction_stribeck,
      [ED_AMEND_ONE_SIDED_VALVE] = &ed_amend_one_sided_valve,
      [ED_AMEND_GAS_SPRING_POLYTROPIC] = &ed_amend_gas_spring_polytropic,
      [ED_AMEND_ONE_SIDED_FORCE] = &ed_amend_one_sided_force,
      [ED_AMEND_HARDENING_SATURATING] = &ed_amend_hardening_saturating,
      [ED_AMEND_VELOCITY_EXPONENT_POSITION] = &ed_amend_velocity_exponent_position,
      [ED_AMEND_HYSTERESIS_STRETCH] = &ed_amend_hysteresis_stretch,
      [ED_AMEND_HYSTERESIS_BOUC_WEN] = &ed_amend_hysteresis_bouc_wen,
      [ED_AMEND_PINCHING_SLIP] = &ed_amend_pinching_slip,
  };
  return id >= 0 && id < (int)(sizeof kinds / sizeof *kinds) ? kinds[id] : NULL;
}

static int check_placement(const ed_damper *damper, const ed_amendment_kind *kind, int placement, char message[ED_DAMPER_MESSAGE])
{
  const char *law = damper->law->name;
  if (placement == ED_PLACE_INSIDE && !damper->law->relaxation_time)
    snprintf(message, ED_DAMPER_MESSAGE,
             "amendment %s: it can stand inside a law that relaxes all of its forces, as mgmm does, but law %s does not", kind->name, law);
  else if (ed_of_side(placement) && !kind->is_factor)
    snprintf(message, ED_DAMPER_MESSAGE, "amendment %s: it is a force of its own, and only factors act on springs or dashpots alone",
             kind->name);
  else if (ed_of_side(placement) && kind->by_force)
    snprintf(message, ED_DAMPER_MESSAGE, "amendment %s: it goes with the law's force, and does not act on springs or dashpots alone",
             kind->name);
  else if (ed_of_side(placement) && !damper->law->without_dashpots)
    snprintf(message, ED_DAMPER_MESSAGE,
             "amendment %s: it can act on springs or dashpots alone of a law whose force is a sum of both, as that of kelvin_voigt or mgmm "
             "is, but that of law %s is not", kind->name, law);
  else
    return ED_OK;
  return ED_E_ARGUMENT;
}

int ed_check_amendment(const ed_damper *damper, const ed_amendment_kind *kind, int id, int placement, int n_parameters,
                       const double *parameters, char message[ED_DAMPER_MESSAGE])
{
  const int placed = check_placement(damper, kind, placement, message);
  if (placed != ED_OK)
    return placed;
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
