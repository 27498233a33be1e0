/* Springs, dashpots and Maxwell branches side by side. */
#include "damper/laws.h"
#include "damper/prony.h"
#include "edcore.h"

static int kelvin_voigt(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double k = damper->parameter[0], c = damper->parameter[1];
  return ed_prony_prepare(damper, &(ed_prony){.spring = k, .dashpot = c}, message);
}

/* Zener and the generalised Maxwell model: a spring, then stiffness and dashpot of each branch. */
static int branches(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  ed_prony series = {.spring = damper->parameter[0], .branches = (damper->n_parameters - 1) / 2};
  for (int i = 0; i < series.branches; i++) {
    const double k = damper->parameter[1 + 2 * i], c = damper->parameter[2 + 2 * i];
    series.stiffness[i] = k;
    series.rate[i] = k / c;
  }
  return ed_prony_prepare(damper, &series, message);
}

static int viscous(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double c = damper->parameter[0];
  return ed_prony_prepare(damper, &(ed_prony){.dashpot = c}, message);
}

static int maxwell(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double c0 = damper->parameter[0], lambda = damper->parameter[1];
  return ed_prony_prepare(damper, &(ed_prony){.branches = 1, .rate = {1.0 / lambda}, .stiffness = {c0 / lambda}}, message);
}

static int linearised(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double k = damper->parameter[0], zeta = damper->parameter[1], omega = damper->parameter[2];
  return ed_prony_prepare(damper, &(ed_prony){.spring = k, .dashpot = 2.0 * zeta * k / omega}, message);
}

#define LAW(law, prepares) \
  {.name = law, .prepare = prepares, .step = ed_prony_step, \
   .rate = ed_prony_rate}

const ed_law ed_kelvin_voigt = LAW("kelvin_voigt", kelvin_voigt);
const ed_law ed_zener = LAW("zener", branches);
const ed_law ed_generalised_maxwell = LAW("generalised_maxwell", branches);
const ed_law ed_viscous = LAW("viscous", viscous);
const ed_law ed_maxwell = LAW("maxwell", maxwell);
const ed_law ed_linearised = LAW("linearised", linearised);
