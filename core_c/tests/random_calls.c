#include "random_calls.h"

#include "checks.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

static const double ABSURD[] = {0.0,   -0.0,   NAN,   INFINITY, -INFINITY, DBL_MAX, -DBL_MAX, DBL_MIN, 4.9e-324, -4.9e-324,
                                1e300, -1e300, 1e200, 1e-300,   1e154,     1e-30,   1e30,     1.0,     -1.0,     2147483648.0};

int chance(caller *c, double share)
{
  return next_number(&c->source, 0.0, 1.0) < share;
}

int whole(caller *c, int from, int to)
{
  return from + (int)next_number(&c->source, 0.0, (double)to - from + 1.0);
}

double size_between(caller *c, double from, double to)
{
  return from * pow(to / from, next_number(&c->source, 0.0, 1.0));
}

double or_absurd(caller *c, double value)
{
  return chance(c, c->wild) ? ABSURD[whole(c, 0, (int)(sizeof ABSURD / sizeof *ABSURD) - 1)] : value;
}

double signed_size(caller *c, double from, double to)
{
  const double value = size_between(c, from, to);
  return or_absurd(c, chance(c, 0.5) ? value : -value);
}

int some_id(caller *c, int count)
{
  static const int none[] = {-1, -2147483647 - 1, 2147483647, 99};
  return count == 0 || chance(c, c->wild) ? (chance(c, 0.5) ? count : none[whole(c, 0, 3)]) : whole(c, 0, count - 1);
}

int samples(caller *c, int most)
{
  if (chance(c, 0.5 * c->wild))
    return -whole(c, 0, 1);
  const int n = chance(c, 0.4) ? 64 * whole(c, 0, most / 64) + whole(c, -2, 2) : chance(c, 0.2) ? whole(c, 1, 3) : whole(c, 1, most);
  return n < 1 ? 1 : n > most ? most : n;
}

double *room(int n)
{
  double *values = n > 0 ? malloc((size_t)n * sizeof *values) : NULL;
  for (int i = 0; i < n; i++)
    values[i] = NAN;
  return values;
}

double *values_between(caller *c, int n, double from, double to)
{
  double *values = room(n);
  const double share = c->wild;
  c->wild = n > 20 ? share * 5.0 / n : share; /* a few in a long series */
  for (int i = 0; i < n; i++)
    values[i] = signed_size(c, from, to);
  c->wild = share;
  return values;
}

double *ascending(caller *c, int n, double step)
{
  double *values = room(n), time = chance(c, 0.5) ? 0.0 : or_absurd(c, 3.0);
  const int even = chance(c, 0.7);
  for (int i = 0; i < n; i++) {
    values[i] = time;
    time += even ? step : step * size_between(c, 1e-3, 1e2);
  }
  if (n > 0 && chance(c, c->wild))
    values[whole(c, 0, n - 1)] = or_absurd(c, 0.0);
  return values;
}

int expect_listed(caller *c, int status)
{
#define NOT_IT(name, value, text) &&status != value
  const int unlisted = 1 ED_STATUS_LIST(NOT_IT);
  c->calls++;
  c->out_of_memory += status == ED_E_MEMORY;
  alarm(60); /* the next call must have come by then: else it hangs */
  CHECK(!unlisted);
  return status;
}

void expect_finite_at(const char *file, int line, int status, const double *value, int n)
{
  if (status < 0)
    return;
  int finite = 0;
  while (finite < n && isfinite(value[finite]))
    finite++;
  check_int(file, line, finite, n > 0 ? n : 0, "finite results");
}

static int impatient(void *data)
{
  static struct timespec asked;
  struct timespec now;
  (void)data;
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double since = (double)(now.tv_sec - asked.tv_sec) + 1e-9 * (double)(now.tv_nsec - asked.tv_nsec);
  static double waited;
  waited = since < 1.0 ? waited + since : 0.0; /* asked five times a second within a call */
  asked = now;
  return waited > 2.0;
}

const ed_stop IMPATIENT = {impatient, NULL};
