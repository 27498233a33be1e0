/* The failure ladder: ever safer attempts at a step, and a record of those that were used. */
#ifndef ED_LADDER_H
#define ED_LADDER_H

#include "edcore.h"

enum { ED_MAX_EVENTS = 10000 };

typedef struct {
  ed_event *events;              /* ED_MAX_EVENTS */
  int n_events;
} ed_ladder;

typedef int (*ed_attempt)(ed_analysis *a, double fraction, int rung);

int ed_climb(ed_analysis *a, ed_attempt attempt);

#endif
