/* Fallbacks of a step that does not converge: ever safer attempts, and a record of those that were used. */
#ifndef ED_FALLBACKS_H
#define ED_FALLBACKS_H

#include "edcore.h"

enum { ED_MAX_EVENTS = 10000 };

typedef struct {
  ed_event *events;              /* ED_MAX_EVENTS */
  int n_events;
} ed_fallbacks;

typedef int (*ed_attempt)(ed_analysis *a, double fraction, int fallback);

int ed_solve_step(ed_analysis *a, ed_attempt attempt);

#endif
