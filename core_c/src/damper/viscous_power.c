#include "damper/laws.h"
#include "edcore.h"

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  (void)damper;
  return ed_refuse_parameter(message, "law", 0.0, "not there yet");
}

const ed_law ed_viscous_power = {.name = "viscous_power", .least_parameters = 1, .most_parameters = ED_MAX_PARAMETERS, .prepare = prepare};
