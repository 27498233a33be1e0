/* Checks of parameters against the generated tables. */
#include "damper/parameter.h"

#include "edstatus.h"

#include <math.h>
#include <stdio.h>

int ed_refuse_parameter(char message[ED_DAMPER_MESSAGE], const char *name, double value, const char *allowed)
{
  snprintf(message, ED_DAMPER_MESSAGE, "%s = %g is not allowed: %s", name, value, allowed);
  return ED_E_ARGUMENT;
}

static int check_count(const ed_parameters *of, int n, char message[ED_DAMPER_MESSAGE])
{
  const int branches = of->n_branch > 0 ? (n - of->n) / of->n_branch : 0;
  if (n >= of->n && n == of->n + branches * of->n_branch && (of->n_branch == 0 || (branches >= 1 && branches <= of->most_branches)))
    return ED_OK;
  char allowed[ED_DAMPER_MESSAGE / 2];
  int used = 0;
  for (int i = 0; i < of->n + of->n_branch; i++)
    used += snprintf(allowed + used, sizeof allowed - (size_t)used, "%s%s", i == 0 ? "" : i == of->n ? ", then " : ", ",
                     i < of->n ? of->parameter[i].name : of->branch[i - of->n].name);
  if (of->n_branch > 0)
    snprintf(allowed + used, sizeof allowed - (size_t)used, " of each of 1 to %d branches", of->most_branches);
  return ed_refuse_parameter(message, "number of parameters", n, allowed);
}

static int is_allowed(const ed_parameter *of, double value)
{
  int chosen = of->n_choices == 0;
  for (int i = 0; i < of->n_choices; i++)
    chosen |= value == of->choice[i];
  return chosen && (value > of->lower || (of->lower_allowed && value == of->lower)) &&
         (value < of->upper || (of->upper_allowed && value == of->upper));
}

/* The bounds, or the values of a switch, for people. */
static void say_allowed(const ed_parameter *of, char *text, size_t size)
{
  int used = 0;
  text[0] = '\0';
  for (int i = 0; i < of->n_choices; i++)
    used += snprintf(text + used, size - (size_t)used, "%s%g", i == 0 ? "" : i == of->n_choices - 1 ? " or " : ", ", of->choice[i]);
  if (of->n_choices > 0)
    return;
  if (of->lower > -INFINITY)
    used = snprintf(text, size, "%s %g", of->lower_allowed ? "at least" : "greater than", of->lower);
  if (of->upper < INFINITY)
    snprintf(text + used, size - (size_t)used, "%s%s %g", used > 0 ? " and " : "", of->upper_allowed ? "at most" : "less than", of->upper);
}

int ed_check_parameters(const ed_parameters *of, int n, const double *value, char message[ED_DAMPER_MESSAGE])
{
  if (check_count(of, n, message) != ED_OK)
    return ED_E_ARGUMENT;
  for (int i = 0; i < n; i++) {
    const int beyond = i - of->n; /* among those of branches */
    const ed_parameter *one = beyond < 0 ? &of->parameter[i] : &of->branch[beyond % of->n_branch];
    const int finite = isfinite(value[i]);
    if (finite && is_allowed(one, value[i]))
      continue;
    char name[24], allowed[80];
    snprintf(name, sizeof name, beyond < 0 ? "%s" : "%s%d", one->name, beyond < 0 ? 0 : 1 + beyond / of->n_branch);
    if (finite)
      say_allowed(one, allowed, sizeof allowed);
    else
      snprintf(allowed, sizeof allowed, "a finite number");
    ed_refuse_parameter(message, name, value[i], allowed);
    return finite ? ED_E_ARGUMENT : ED_E_NOT_FINITE;
  }
  return ED_OK;
}
