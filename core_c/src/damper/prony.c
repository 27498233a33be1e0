#include "damper/laws.h"
#include "edcore.h"

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  (void)damper;
  return ed_refuse_parameter(message, "law", 0.0, "not there yet");
}

const ed_law ed_kelvin_voigt = {.name = "kelvin_voigt", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_zener = {.name = "zener", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_generalised_maxwell = {.name = "generalised_maxwell", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_viscous = {.name = "viscous", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_maxwell = {.name = "maxwell", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_linearised = {.name = "linearised", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_fractional_kelvin = {.name = "fractional_kelvin", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_fractional_zener = {.name = "fractional_zener", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
const ed_law ed_fractional_maxwell = {.name = "fractional_maxwell", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
