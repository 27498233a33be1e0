/* The differential equations of one damper inside a system: its rates along a given motion, one stage of an implicit Runge-Kutta
 * method solved for it, and the sensitivities to the two unknowns of its path. Private to ode_*.c. */
#ifndef ED_ODE_BLOCK_H
#define ED_ODE_BLOCK_H

#include "damper/law.h"

enum { ED_ODE_DIRECTIONS = 2 };

/* Deformation given by samples, cubic between them. */
typedef struct {
  int n, at; /* at: interval of the last question */
  const double *time, *u, *v;
  ed_path path; /* in that interval */
} ed_ode_samples;

typedef struct {
  const ed_damper *damper;
  int first;                 /* place of its variables in the system's */
  const ed_path *path;       /* its motion, or NULL: the samples */
  ed_ode_samples *samples;
  const ed_path *direction;  /* two, or NULL: no sensitivities */
  double *memory;
  double *memory_slope[ED_ODE_DIRECTIONS]; /* derivatives of the memory to the unknowns, for `moved` */
  int moved;                               /* the memory was set at an instant inside the path, so it depends on the unknowns */
  double difference[ED_ODE_DIRECTIONS];    /* change of the unknowns for difference quotients of the memory */
  double reach[ED_ODE_DIRECTIONS];         /* largest derivative of the deformation to the unknowns */
  double next;               /* instant of its next event */
  double way;                /* sign of the velocity in this segment: at its ends, where v = 0, rounding must not choose */
  double turn, turn_level;   /* direction of its own velocity (+1, -1), and how much of it is none */
  int turned;                /* it has turned at the end of the last segment */
} ed_ode_block;

/* Room for the work on one block at a time. */
typedef struct {
  ed_damper_rate rate, other;
  double matrix[ED_MAX_ODE * ED_MAX_ODE];
  double step[ED_MAX_ODE], before[ED_MAX_ODE];
  double memory[2][ED_MAX_ODE];
  int pivot[ED_MAX_ODE];
} ed_ode_work;

/* Whether the damper's reversals are not those of the path: it has a brace of its own, whose elongation is its first variable, and
 * remembers deformations. */
int ed_ode_turns_itself(const ed_damper *damper);
/* Its own velocity at instant t and y. 0: not finite. */
int ed_ode_own_velocity(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, double *velocity);

/* Deformation and velocity at instant t, of the segment that was begun (block->way). */
void ed_ode_motion(const ed_ode_block *block, double t, double *u, double *v);
/* Rates at instant t and y, with all partial derivatives. 0: not finite. */
int ed_ode_rate(const ed_ode_block *block, double t, const double *y, ed_damper_rate *rate);

/* Time derivatives of y and, with directions, of the sensitivities behind it (s0 at y + stride, s1 at y + 2 stride). */
int ed_ode_derivatives(const ed_ode_block *block, ed_ode_work *work, double t, double scale, const double *y, int stride,
                       double *derivative);

/* Solves z = a + gamma f(t, z) with z a first guess; likewise the sensitivities, which are linear. weight: of changes of z, 1 is
 * small enough. 0: no convergence, or not finite. */
int ed_ode_stage(const ed_ode_block *block, ed_ode_work *work, double t, double gamma, const double *a, const double *weight,
                 int stride, double *z);

/* Begins a segment: size of the change of y and its sensitivities from t0 to t1 (change) and the rate at which y forgets, roughly.
 * 0: not finite. */
int ed_ode_estimate(ed_ode_block *block, ed_ode_work *work, double t0, double t1, const double *y, int stride,
                    double *change, double *rate);

/* Force at instant t and its derivatives to the unknowns. 0: not finite. */
int ed_ode_force(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, int stride, ed_damper_force *out);

/* Moves the memory to instant t; inside: an event that moves with the unknowns. */
void ed_ode_remember(ed_ode_block *block, ed_ode_work *work, double t, const double *y, int stride, int inside);

#endif
