/* Running out of memory: the random calls (random_calls.h) of some seeds with sound numbers, in each of which one allocation of the core
 * fails, or all from it on. What must hold: some call says ED_E_MEMORY, the others what they say at any time, and nothing is lost. The
 * Makefile links this program with a core whose malloc, calloc, realloc and aligned_alloc are those below. */
#include "checks.h"
#include "random_calls.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

void *failing_malloc(size_t size);
void *failing_calloc(size_t count, size_t size);
void *failing_realloc(void *block, size_t size);
void *failing_aligned_alloc(size_t alignment, size_t size);

static long allocations, first_to_fail, last_to_fail;

static int fails(void)
{
  allocations++;
  return allocations >= first_to_fail && allocations <= last_to_fail;
}

void *failing_malloc(size_t size)
{
  return fails() ? NULL : malloc(size);
}

void *failing_calloc(size_t count, size_t size)
{
  return fails() ? NULL : calloc(count, size);
}

void *failing_realloc(void *block, size_t size)
{
  return fails() ? NULL : realloc(block, size);
}

void *failing_aligned_alloc(size_t alignment, size_t size)
{
  return fails() ? NULL : aligned_alloc(alignment, size);
}

/* Seeds a life cycle, and failures a seed, spread over its allocations. */
enum { SEEDS = 12, FAILURES = 25 };

/* How often a call said that memory was out. */
static long live(void (*life)(caller *), unsigned long long seed, long first, long last)
{
  caller c = {.source = {seed * 0x9e3779b97f4a7c15ULL}};
  allocations = 0;
  first_to_fail = first;
  last_to_fail = last;
  life(&c);
  return c.out_of_memory;
}

/* Springs and dashpots of a law apart, which the random calls seldom see; what is refused has changed nothing. */
static void call_sides(caller *c)
{
  const double mgmm[] = {0.515e6, 15.1e3, 0.107e6, 20974.0, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
  const double time[] = {0.0, 0.01, 0.02}, u[] = {0.0, 1e-3, 3e-3}, v[] = {0.0, 0.15, 0.2}, path[] = {0.3, 0.1, 0.8, 0.5};
  int status, done;
  char message[200];
  double force[3];
  ed_damper *damper = ed_damper_new(ED_LAW_MGMM, 12, mgmm, 0.0, 0.0, &status, message, sizeof message);
  expect_listed(c, status);
  for (int i = 0; damper && i < 4; i++) {
    const int size = ed_damper_state_size(damper), placement = i % 2 ? ED_PLACE_DASHPOTS : ED_PLACE_SPRINGS;
    status = expect_listed(c, ed_damper_add_effect(damper, ED_EFFECT_MULLINS_PATH, placement, 4, path, message, sizeof message));
    CHECK((ed_damper_state_size(damper) > size) == (status == ED_OK));
  }
  if (damper)
    expect_listed(c, ed_damper_history(damper, ED_DAMPER_BEST, 1e-6, 3, time, u, v, force, &done));
  ed_damper_free(damper);
}

int main(void)
{
  void (*const lives[])(caller *) = {call_signals, call_damper, call_frame, call_space, call_sides};
  long failures = 0;
  for (int kind = 0; kind < 5; kind++)
    for (unsigned long long seed = 1; seed <= SEEDS; seed++) {
      CHECK_INT(live(lives[kind], seed, LONG_MAX, LONG_MAX), 0);
      const long all = allocations;
      for (long i = 0; i < FAILURES && i < all; i++) {
        const long failing = all <= FAILURES ? i + 1 : 1 + i * (all - 1) / (FAILURES - 1);
        for (int on = 0; on < 2; on++) {
          const long before = checks_failed();
          const long counted = live(lives[kind], seed, failing, on ? LONG_MAX : failing);
          CHECK(counted > 0 || allocations < failing); /* a call of another speed may have been given up before */
          if (checks_failed() > before)
            printf("life cycle %d, seed %llu, allocation %ld of %ld%s\n", kind, seed, failing, all, on ? " and all after it" : "");
          failures++;
        }
      }
    }
  CHECK(failures > 1000);
  return checks_end("out of memory");
}
