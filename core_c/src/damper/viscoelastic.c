/* Springs, dashpots and Maxwell branches side by side. */
#include "damper/laws.h"
#include "damper/prony.h"
#include "edcore.h"

enum { MOST_BRANCHES = 16 };

static int refuse_negative(char message[ED_DAMPER_MESSAGE], const char *name, double value)
{
  return value >= 0.0 ? ED_OK : ed_refuse_parameter(message, name, value, "it must be zero or above");
}

static int refuse_not_positive(char message[ED_DAMPER_MESSAGE], const char *name, double value)
{
  return value > 0.0 ? ED_OK : ed_refuse_parameter(message, name, value, "it must be above zero");
}

static int kelvin_voigt(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double k = damper->parameter[0], c = damper->parameter[1];
  if (refuse_negative(message, "k", k) || refuse_negative(message, "c", c))
    return ED_E_ARGUMENT;
  return ed_prony_prepare(damper, &(ed_prony){.spring = k, .dashpot = c}, message);
}

/* Zener and the generalised Maxwell model: a spring, then stiffness and dashpot of each branch. */
static int branches(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  static const char *const k_name[MOST_BRANCHES] = {"k1", "k2",  "k3",  "k4",  "k5",  "k6",  "k7",  "k8",
                                                    "k9", "k10", "k11", "k12", "k13", "k14", "k15", "k16"};
  static const char *const c_name[MOST_BRANCHES] = {"c1", "c2",  "c3",  "c4",  "c5",  "c6",  "c7",  "c8",
                                                    "c9", "c10", "c11", "c12", "c13", "c14", "c15", "c16"};
  ed_prony series = {.spring = damper->parameter[0], .branches = (damper->n_parameters - 1) / 2};
  if (damper->n_parameters % 2 == 0)
    return ed_refuse_parameter(message, "number of parameters", damper->n_parameters, "k0, then k and c of each branch");
  if (refuse_negative(message, "k0", series.spring))
    return ED_E_ARGUMENT;
  for (int i = 0; i < series.branches; i++) {
    const double k = damper->parameter[1 + 2 * i], c = damper->parameter[2 + 2 * i];
    if (refuse_not_positive(message, k_name[i], k) || refuse_not_positive(message, c_name[i], c))
      return ED_E_ARGUMENT;
    series.stiffness[i] = k;
    series.rate[i] = k / c;
  }
  return ed_prony_prepare(damper, &series, message);
}

static int viscous(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double c = damper->parameter[0];
  if (refuse_not_positive(message, "c", c))
    return ED_E_ARGUMENT;
  return ed_prony_prepare(damper, &(ed_prony){.dashpot = c}, message);
}

static int maxwell(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double c0 = damper->parameter[0], lambda = damper->parameter[1];
  if (refuse_not_positive(message, "c0", c0) || refuse_not_positive(message, "lambda", lambda))
    return ED_E_ARGUMENT;
  return ed_prony_prepare(damper, &(ed_prony){.branches = 1, .rate = {1.0 / lambda}, .stiffness = {c0 / lambda}}, message);
}

static int linearised(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const double k = damper->parameter[0], zeta = damper->parameter[1], omega = damper->parameter[2];
  if (refuse_not_positive(message, "k_eff", k) || refuse_negative(message, "zeta_eff", zeta) ||
      refuse_not_positive(message, "omega", omega))
    return ED_E_ARGUMENT;
  return ed_prony_prepare(damper, &(ed_prony){.spring = k, .dashpot = 2.0 * zeta * k / omega}, message);
}

#define LAW(law, least, most, prepares) \
  {.name = law, .least_parameters = least, .most_parameters = most, .prepare = prepares, .step = ed_prony_step, \
   .rate = ed_prony_rate}

const ed_law ed_kelvin_voigt = LAW("kelvin_voigt", 2, 2, kelvin_voigt);
const ed_law ed_zener = LAW("zener", 3, 3, branches);
const ed_law ed_generalised_maxwell = LAW("generalised_maxwell", 3, 1 + 2 * MOST_BRANCHES, branches);
const ed_law ed_viscous = LAW("viscous", 1, 1, viscous);
const ed_law ed_maxwell = LAW("maxwell", 2, 2, maxwell);
const ed_law ed_linearised = LAW("linearised", 3, 3, linearised);
