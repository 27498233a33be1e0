/* Parameters of laws and effects as the generated tables have them, and their checks. */
#ifndef ED_PARAMETER_H
#define ED_PARAMETER_H

enum { ED_DAMPER_MESSAGE = 256 };

typedef struct {
  const char *name;
  double lower, upper;
  int lower_allowed, upper_allowed; /* the bound itself */
  int n_choices;                    /* of a switch: the values that it takes; 0: all within the bounds */
  const double *choice;
} ed_parameter;

/* n parameters, then n_branch of each of 1 to most_branches branches, whose number follows their names. */
typedef struct {
  int n, n_branch, most_branches;
  const ed_parameter *parameter, *branch;
} ed_parameters;

/* ED_OK if there are as many values as `of` wants, finite and each as it is allowed; else ED_E_ARGUMENT, or ED_E_NOT_FINITE, and
 * `message` says which, what was seen and what is allowed. */
int ed_check_parameters(const ed_parameters *of, int n, const double *value, char message[ED_DAMPER_MESSAGE]);
/* Writes what is said of a value that is not allowed. Returns ED_E_ARGUMENT. */
int ed_refuse_parameter(char message[ED_DAMPER_MESSAGE], const char *name, double value, const char *allowed);

#endif
