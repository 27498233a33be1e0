/* A system of dampers and its segments: from one event to the next. Private to ode_*.c. */
#ifndef ED_ODE_SEGMENT_H
#define ED_ODE_SEGMENT_H

#include "damper/ode_integrator.h"
#include "damper/ode_system.h"

#include <stddef.h>

enum { ED_MOST_SEGMENTS = 1000 }; /* of one step, for each damper */

struct ed_ode_system {
  int n;
  ed_ode_block *block;
  ed_ode_work *work;
  double *memory_slopes;
  double *before; /* variables at the beginning of a segment */
  SUNContext context;
  ed_ode_integrator step, history; /* with and without sensitivities; the second only for one damper */
};

/* Events closer together than this share of a path are one. */
double ed_ode_instants_apart(const ed_path *path);
/* The first event of a damper on a path behind `from`; infinity: none. */
double ed_ode_next_event(const ed_damper *damper, const ed_path *path, const double *memory, double from);
/* Begins a segment at t that ends at `stop`. */
int ed_ode_begin(ed_ode_system *system, ed_ode_integrator *integrator, double t, double stop);
/* Goes on to `stop` in it, or to where a block turns. t: now, and where that led. */
int ed_ode_go(ed_ode_system *system, ed_ode_integrator *integrator, double stop, double *t);

#endif
