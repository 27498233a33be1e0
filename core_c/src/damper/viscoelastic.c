/* Springs, dashpots and Maxwell branches side by side. */
#include "damper/laws.h"
#include "damper/prony.h"
#include "edcore.h"

static int kelvin_voigt(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_KELVIN_VOIGT_PARAMETERS };
  const double *p = damper->parameter;
  return ed_prony_prepare(damper, &(ed_prony){.spring = p[K], .dashpot = p[C]}, message);
}

static int zener(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_ZENER_PARAMETERS };
  const double *p = damper->parameter;
  return ed_prony_prepare(damper, &(ed_prony){.spring = p[K0], .branches = 1, .rate = {p[K1] / p[C1]}, .stiffness = {p[K1]}}, message);
}

static int generalised_maxwell(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_GENERALISED_MAXWELL_PARAMETERS, OWN };
  enum { ED_LAW_GENERALISED_MAXWELL_BRANCH, OF_BRANCH };
  const double *p = damper->parameter;
  ed_prony series = {.spring = p[K0], .branches = (damper->n_parameters - OWN) / OF_BRANCH};
  for (int i = 0; i < series.branches; i++) {
    const double *branch = p + OWN + OF_BRANCH * i;
    series.stiffness[i] = branch[K];
    series.rate[i] = branch[K] / branch[C];
  }
  return ed_prony_prepare(damper, &series, message);
}

static int viscous(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_VISCOUS_PARAMETERS };
  return ed_prony_prepare(damper, &(ed_prony){.dashpot = damper->parameter[C]}, message);
}

static int maxwell(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_MAXWELL_PARAMETERS };
  const double *p = damper->parameter;
  return ed_prony_prepare(damper, &(ed_prony){.branches = 1, .rate = {1.0 / p[LAMBDA]}, .stiffness = {p[C0] / p[LAMBDA]}}, message);
}

static int linearised(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_LINEARISED_PARAMETERS };
  const double *p = damper->parameter, dashpot = 2.0 * p[ZETA_EFF] * p[K_EFF] / p[OMEGA];
  return ed_prony_prepare(damper, &(ed_prony){.spring = p[K_EFF], .dashpot = dashpot}, message);
}

#define LAW(law, prepares, springs) \
  {.name = law, .prepare = prepares, .step = ed_prony_step, \
   .rate = ed_prony_rate, .without_dashpots = springs}

const ed_law ed_kelvin_voigt = LAW("kelvin_voigt", kelvin_voigt, ed_prony_without_dashpots);
const ed_law ed_zener = LAW("zener", zener, ed_prony_without_dashpots);
const ed_law ed_generalised_maxwell = LAW("generalised_maxwell", generalised_maxwell, ed_prony_without_dashpots);
const ed_law ed_viscous = LAW("viscous", viscous, NULL);
const ed_law ed_maxwell = LAW("maxwell", maxwell, NULL);
const ed_law ed_linearised = LAW("linearised", linearised, ed_prony_without_dashpots);
