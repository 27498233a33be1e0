/* Equations of the free degrees: which degree each belongs to, what moves with it. */
#ifndef ED_NUMBERING_H
#define ED_NUMBERING_H

#include "system/model.h"

typedef struct {
  int n;                         /* equations */
  int degrees;                   /* of all nodes */
  int *equation;                 /* degrees: -1 where supported */
  int n_supports;                /* supported degrees, tied ones counted once */
  int *support;                  /* degrees: number of a supported degree, -1 where free */
  ed_in_plan *plan;              /* degrees: how they go with the masters of diaphragms; NULL where there is none */
  double *mass;                  /* n */
  double *influence[3];          /* n: 1 where the equation moves with the ground along x, y, z; z is NULL in the plane */
  double length;                 /* mean element length: makes moments comparable with forces */
  int *rotational;               /* n */
  double *scale;                 /* n: 1, or 1 / length where rotational */
  int *name;                     /* n: degree that names the equation */
} ed_numbering;

int ed_number(ed_analysis *a);
int ed_set_length(ed_numbering *numbering, double length); /* ED_OK, ED_E_MEMORY */
void ed_numbering_free(ed_numbering *numbering);
/* node.ux and so on; "?" where there is no such equation */
const char *ed_equation_name(const ed_model *model, const ed_numbering *numbering, int equation, char *buffer, int size);

/* Where the value of a degree lies, among those of equations or of supports. */
static inline double *ed_at_equation(const ed_numbering *numbering, double *of_equations, double *of_supports, int degree)
{
  const int equation = numbering->equation[degree];
  return equation >= 0 ? of_equations + equation : of_supports + numbering->support[degree];
}

/* Adds what acts at a degree, where a diaphragm moves it on the degrees of its master. `of_supports` may be NULL. */
static inline void ed_add_at_degree(const ed_numbering *numbering, int degree, double value, double *of_equations, double *of_supports)
{
  const int equation = numbering->equation[degree];
  if (equation >= 0)
    of_equations[equation] += value;
  else if (of_supports)
    of_supports[numbering->support[degree]] += value;
  if (!numbering->plan || numbering->plan[degree].turn < 0)
    return;
  const int turn = numbering->plan[degree].turn, turns = numbering->equation[turn];
  if (turns >= 0)
    of_equations[turns] += numbering->plan[degree].lever * value;
  else if (of_supports)
    of_supports[numbering->support[turn]] += numbering->plan[degree].lever * value;
}

#endif
