/* The table of laws, and dampers made of them. */
#include "damper/law.h"

#include "damper/brace.h"
#include "damper/laws.h"
#include "damper/ode_system.h"
#include "edcore.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ed_law *ed_law_of(int id)
{
  static const ed_law *const laws[] = {
      [ED_LAW_KELVIN_VOIGT] = &ed_kelvin_voigt,
      [ED_LAW_ZENER] = &ed_zener,
      [ED_LAW_GENERALISED_MAXWELL] = &ed_generalised_maxwell,
      [ED_LAW_FRACTIONAL_KELVIN] = &ed_fractional_kelvin,
      [ED_LAW_FRACTIONAL_ZENER] = &ed_fractional_zener,
      [ED_LAW_VISCOUS] = &ed_viscous,
      [ED_LAW_VISCOUS_POWER] = &ed_viscous_power,
      [ED_LAW_MAXWELL] = &ed_maxwell,
      [ED_LAW_MAXWELL_POWER] = &ed_maxwell_power,
      [ED_LAW_FRACTIONAL_MAXWELL] = &ed_fractional_maxwell,
      [ED_LAW_FRICTION] = &ed_friction,
      [ED_LAW_ELASTIC_PLASTIC] = &ed_elastic_plastic,
      [ED_LAW_RAMBERG_OSGOOD] = &ed_ramberg_osgood,
      [ED_LAW_BOUC_WEN] = &ed_bouc_wen,
      [ED_LAW_MODIFIED_BOUC_WEN] = &ed_modified_bouc_wen,
      [ED_LAW_ASYMPTOTE] = &ed_asymptote,
      [ED_LAW_LINEARISED] = &ed_linearised,
      [ED_LAW_MGMM] = &ed_mgmm,
      [ED_LAW_BILINEAR_OIL] = &ed_bilinear_oil,
      [ED_LAW_ASYMMETRIC_VISCOUS] = &ed_asymmetric_viscous,
      [ED_LAW_LEAD_RUBBER] = &ed_lead_rubber,
      [ED_LAW_FRICTION_PENDULUM] = &ed_friction_pendulum,
      [ED_LAW_SELF_CENTRING] = &ed_self_centring,
      [ED_LAW_GAP] = &ed_gap,
      [ED_LAW_BUCKLING_RESTRAINED] = &ed_buckling_restrained,
      [ED_LAW_CHABOCHE] = &ed_chaboche,
  };
  return id >= 0 && id < (int)(sizeof laws / sizeof *laws) ? laws[id] : NULL;
}

int ed_damper_prepare(ed_damper *damper, int law, int n_parameters, const double *parameters, double brace, double play,
                      char message[ED_DAMPER_MESSAGE])
{
  memset(damper, 0, sizeof *damper);
  damper->law = ed_law_of(law);
  if (!damper->law) {
    snprintf(message, ED_DAMPER_MESSAGE, "there is no damper law %d", law);
    return ED_E_ID;
  }
  int status = ed_check_parameters(&ed_law_parameters[law], n_parameters, parameters, message);
  if (status != ED_OK)
    return status;
  if (!(brace >= 0.0) || !isfinite(brace))
    return ed_refuse_parameter(message, "brace", brace, "a stiffness above zero, or 0 for none");
  if (!(play >= 0.0) || !isfinite(play))
    return ed_refuse_parameter(message, "play", play, "a length above zero, or 0 for none");
  if (play > 0.0 && brace == 0.0)
    return ed_refuse_parameter(message, "play", play, "play stands with the stiffness of a brace");
  damper->n_parameters = n_parameters;
  *(play > 0.0 ? &damper->joint : &damper->brace) = brace;
  damper->play = play;
  damper->rate_independent = damper->law->rate_independent;
  memcpy(damper->parameter, parameters, (size_t)n_parameters * sizeof *parameters);
  status = damper->law->prepare ? damper->law->prepare(damper, message) : ED_OK;
  if (status == ED_OK && play > 0.0 && !ed_damper_has_exact_step(damper)) {
    snprintf(message, ED_DAMPER_MESSAGE, "law %s is integrated without exact step, so that no play can stand in series with it",
             damper->law->name);
    status = ED_E_ARGUMENT;
  }
  if (status == ED_OK && damper->brace > 0.0 && damper->law->with_brace) {
    ed_damper_clear(damper);
    damper->law->with_brace(damper);
    status = damper->law->prepare(damper, message);
  }
  if (status != ED_OK)
    ed_damper_clear(damper);
  return status;
}

void ed_damper_clear(ed_damper *damper)
{
  if (damper->springs) {
    ed_damper_clear(damper->springs);
    free(damper->springs);
  }
  free(damper->derived);
  free(damper->effects);
  damper->springs = NULL;
  damper->derived = NULL;
  damper->effects = NULL;
  damper->n_effects = damper->n_effect_state = 0;
}

int ed_damper_state_size(const ed_damper *damper)
{
  return ed_damper_own_size(damper) + (ed_damper_is_braced(damper) ? ED_BRACE_STATE : 0);
}

void ed_damper_start(const ed_damper *damper, double *state)
{
  const int size = ed_damper_state_size(damper);
  if (size == 0)
    return;
  memset(state, 0, (size_t)size * sizeof *state);
  if (damper->law->start)
    damper->law->start(damper, state);
  ed_effects_start(damper, state, 1);
}

int ed_damper_try(const ed_damper *damper, int rough, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out)
{
  if (!isnormal(path->h)) /* a part of it could be nothing, and has no path */
    return ED_E_ARGUMENT;
  if (ed_damper_is_braced(damper))
    return ed_brace_step(damper, rough, committed, path, direction, trial, out);
  return ed_damper_own_step(damper, committed, path, direction, trial, out);
}

int ed_damper_advance(const ed_damper *damper, ed_ode_system *system, const double *committed, const ed_path *path,
                      const ed_path direction[2], double *trial, ed_damper_force *out)
{
  if (!ed_damper_has_exact_step(damper))
    return ed_ode_system_step(system, &committed, path, (const ed_path(*)[2])direction, &trial, out);
  return ed_damper_try(damper, 0, committed, path, direction, trial, out);
}
