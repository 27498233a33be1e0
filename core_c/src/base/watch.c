#include "base/watch.h"

#include <time.h>

/* Between questions, s: a person who wants to stop waits so long without noticing. */
static const double PATIENCE = 0.2;
/* Between looks at the clock, s: a look takes up to 1.5 us, where the system is asked for the time, 1/300 of the shorter one. Steps that
 * become a thousand times longer in between are still noticed within seconds. */
static const double SHORT = 0.5e-3, LONG = 2e-3;
enum { FIRST = 16 }; /* steps before the first look; they double from one to the next as long as these are too many */

static double now(void)
{
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

ed_watch ed_watch_of(const ed_stop *stop)
{
  return (ed_watch){.stop = stop ? *stop : (ed_stop){0}, .every = FIRST, .left = FIRST};
}

int ed_watch_look(ed_watch *watch)
{
  if (watch->stopped || !watch->stop.asked)
    return watch->stopped;
  const double time = now(), since = time - watch->last;
  if (watch->next == 0.0)
    watch->next = time + PATIENCE;
  else if (since < SHORT)
    watch->every *= 2;
  else if (since > LONG && watch->every > 1)
    watch->every /= 2;
  watch->last = time;
  watch->left = watch->every;
  if (time < watch->next)
    return 0;
  watch->next = time + PATIENCE;
  watch->stopped = watch->stop.asked(watch->stop.data) != 0;
  return watch->stopped;
}
