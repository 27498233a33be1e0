/* Random calls (random_calls.h), one life cycle a seed: without arguments a fixed few. `test_random_calls SEED` repeats one,
 * `test_random_calls SEED SECONDS` goes on from it for so long. What is wrong is followed by the seed. */
#include "checks.h"
#include "random_calls.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { FEW = 400, CHECKS_FAILED = 2 };

static void tell_seed(unsigned long long seed)
{
  fflush(stdout);
  fprintf(stderr, "test_random_calls: that was seed %llu\n", seed);
}

/* Returns how many calls it was. */
static long live(unsigned long long seed)
{
  static const double wild[] = {0.0, 0.01, 0.05, 0.2};
  void (*const lives[])(caller *) = {call_signals, call_damper, call_damper, call_frame, call_frame, call_space, call_frame_in_space, call_frame_in_space};
  caller c = {.source = {seed * 0x9e3779b97f4a7c15ULL}, .wild = 0.0};
  for (int i = 0; i < 4; i++)
    next_number(&c.source, 0.0, 1.0); /* neighbours part */
  c.wild = wild[whole(&c, 0, 3)];
  const long before = checks_failed();
  lives[seed % (sizeof lives / sizeof *lives)](&c);
  if (checks_failed() > before)
    tell_seed(seed);
  return c.calls;
}

/* From the seed in *at on, which is moved on. */
static int live_on(volatile unsigned long long *at, unsigned long long last, time_t end)
{
  const unsigned long long first = *at;
  long calls = 0;
  for (; *at <= last && (!end || time(NULL) < end) && checks_failed() < 20; ++*at)
    calls += live(*at);
  printf("random calls: %ld, seeds %llu to %llu\n", calls, first, *at - 1);
  return checks_end("random calls");
}

int main(int arguments, char **argument)
{
  const unsigned long long first = arguments > 1 ? strtoull(argument[1], NULL, 10) : 1;
  const time_t end = arguments > 2 ? time(NULL) + atol(argument[2]) : 0;
  const unsigned long long last = end ? ULLONG_MAX : first + (arguments > 1 ? 0 : FEW - 1);
  /* a process of its own, so that the seed can be printed whatever ends it: a sanitizer, a signal, a call that hangs */
  volatile unsigned long long *at = mmap(NULL, sizeof *at, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (at == MAP_FAILED)
    return 1;
  *at = first;
  fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const int failed = live_on(at, last, end);
    alarm(0);
    return failed ? CHECKS_FAILED : 0;
  }
  int how = 1;
  if (child < 0 || waitpid(child, &how, 0) < 0)
    return 1;
  if (how != 0 && !(WIFEXITED(how) && WEXITSTATUS(how) == CHECKS_FAILED))
    tell_seed(*at);
  return how != 0;
}
