/* Laws with fractional derivatives as Prony series: quadrature of their relaxation spectra. */
#include "damper/laws.h"
#include "damper/prony.h"
#include "damper/spectrum.h"
#include "edcore.h"

static void scale(ed_prony *series, double factor)
{
  series->spring *= factor;
  series->dashpot *= factor;
  for (int i = 0; i < series->branches; i++)
    series->stiffness[i] *= factor;
}

/* F = k0 (u + c D^alpha u): beside the spring a relaxation modulus k0 c t^-alpha / Gamma(1 - alpha). */
static int kelvin(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_FRACTIONAL_KELVIN_PARAMETERS };
  const double *p = damper->parameter;
  ed_prony series;
  ed_spectrum_of_power(&series, p[ALPHA]);
  scale(&series, p[K0] * p[C]);
  series.spring += p[K0];
  return ed_prony_prepare(damper, &series, message);
}

/* F + a D^alpha F = k0 (u + b D^alpha u): relaxation modulus k0 (1 + (b/a - 1) E_alpha(-t^alpha / a)). */
static int zener(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_FRACTIONAL_ZENER_PARAMETERS };
  const double *p = damper->parameter;
  if (!(p[B] > p[A]))
    return ed_refuse_parameter(message, "b", p[B], "it must be above a, or the device would give more energy than it took");
  ed_prony series;
  ed_spectrum_of_mittag_leffler(&series, p[ALPHA], p[A], 0);
  scale(&series, p[K0] * ((p[B] - p[A]) / p[A]));
  series.spring += p[K0];
  return ed_prony_prepare(damper, &series, message);
}

/* F + lambda D^nu F = c0 v: relaxation modulus c0/lambda t^(nu - 1) E_nu,nu(-t^nu / lambda) = -c0 d/dt E_nu(-t^nu / lambda). */
static int maxwell(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  enum { ED_LAW_FRACTIONAL_MAXWELL_PARAMETERS };
  const double *p = damper->parameter;
  ed_prony series;
  ed_spectrum_of_mittag_leffler(&series, p[NU], p[LAMBDA], 1);
  scale(&series, p[C0]);
  return ed_prony_prepare(damper, &series, message);
}

#define LAW(law, prepares, springs) \
  {.name = law, .prepare = prepares, .step = ed_prony_step, \
   .rate = ed_prony_rate, .without_dashpots = springs}

const ed_law ed_fractional_kelvin = LAW("fractional_kelvin", kelvin, ed_prony_without_dashpots);
const ed_law ed_fractional_zener = LAW("fractional_zener", zener, ed_prony_without_dashpots);
const ed_law ed_fractional_maxwell = LAW("fractional_maxwell", maxwell, NULL);
