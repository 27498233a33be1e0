/* Long calls ask now and then whether they shall end (ed_stop in edstatus.h). The clock decides when, so that a short call never asks and
 * results do not depend on it; it is looked at so seldom that this cannot be measured, however short or long the steps are. */
#ifndef ED_WATCH_H
#define ED_WATCH_H

#include "edcore.h"

typedef struct {
  ed_stop stop;
  double last, next; /* s: when the clock was looked at, and when to ask; 0: not yet */
  long every, left;  /* steps from one look to the next, and to the next one */
  int stopped;       /* it has been asked to end */
} ed_watch;

/* `stop` may be NULL. */
ed_watch ed_watch_of(const ed_stop *stop);
/* Looks at the clock, and asks when the time has come. Returns `stopped`. */
int ed_watch_look(ed_watch *watch);

/* For loops, in each step. */
static inline int ed_watch_step(ed_watch *watch)
{
  return watch->stop.asked && --watch->left <= 0 && ed_watch_look(watch);
}

#endif
