/* Laws of springs: force and deformation along one direction. A law is a pure function of the committed state and the
 * trial deformation, as those of steels are. */
#ifndef ED_SPRING_H
#define ED_SPRING_H

#include "spring/deteriorating.h"

enum { ED_MAX_CORNERS = 4 };

/* Elastic-plastic springs and an elastic one side by side: the force then follows the corners of a line, and Masing's rule. */
typedef struct {
  int n;                                      /* of the elastic-plastic ones */
  double stiffness[ED_MAX_CORNERS], yield[ED_MAX_CORNERS]; /* force */
  double elastic;
} ed_multilinear;

/* Pushes and does not pull; at its capacity it gives way. */
typedef struct {
  double stiffness, capacity;                 /* force; HUGE_VAL: never gives way */
} ed_contact;

typedef struct {
  int law;                                    /* ED_SPRING_* */
  double stiffness;                           /* at the start */
  union {
    ed_multilinear multilinear;
    ed_contact contact;
    ed_deteriorating deteriorating;
  } of;
} ed_spring;

/* NULL, or why the parameters (edmodel.h) are refused. */
const char *ed_spring_set(ed_spring *spring, int law, int n, const double *parameters);

int ed_spring_state_size(const ed_spring *spring); /* doubles */
void ed_spring_initialise(const ed_spring *spring, double *state);
int ed_spring_state_valid(const ed_spring *spring, const double *state);
/* The return is 1 where the tangent is the stiffness at the start. */
int ed_spring_trial(const ed_spring *spring, const double *state, double deformation, double *force, double *tangent);
/* Moves the state; the return is the energy dissipated on the way. */
double ed_spring_commit(const ed_spring *spring, double *state, double deformation);
/* Recoverable energy at a deformation to which the state has been committed. */
double ed_spring_stored(const ed_spring *spring, const double *state, double deformation);
/* What is left of the strength, 0..1. */
double ed_spring_strength_left(const ed_spring *spring, const double *state);

#endif
