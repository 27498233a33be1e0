#include "checks.h"

#include "edcore.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SHOWN = 20 }; /* a loop that fails everywhere should not fill the screen */

static long checks, failures;

static int failed(const char *file, int line)
{
  failures++;
  if (failures == SHOWN + 1)
    printf("further failures are only counted\n");
  if (failures > SHOWN)
    return 0;
  printf("%s:%d: ", file, line);
  return 1;
}

void check_true(const char *file, int line, int condition, const char *text)
{
  checks++;
  if (!condition && failed(file, line))
    printf("expected %s, got false\n", text);
}

void check_int(const char *file, int line, long got, long expected, const char *text)
{
  checks++;
  if (got != expected && failed(file, line))
    printf("%s: expected %ld, got %ld\n", text, expected, got);
}

void check_near(const char *file, int line, double got, double expected, double tolerance, const char *text)
{
  checks++;
  if (!(fabs(got - expected) <= tolerance) && failed(file, line))
    printf("%s: expected %.17g, got %.17g (off by %.3g, allowed %.3g)\n", text, expected, got,
           got - expected, tolerance);
}

void check_same(const char *file, int line, const double *got, const double *expected, int n, const char *text)
{
  checks++;
  for (int i = 0; i < n; i++)
    if (got[i] != expected[i]) {
      if (failed(file, line))
        printf("%s: expected the same bits, [%d of %d] expected %.17g, got %.17g\n", text, i, n, expected[i], got[i]);
      return;
    }
}

void check_status(const char *file, int line, int got, int expected, const char *text)
{
  checks++;
  if (got != expected && failed(file, line))
    printf("%s: expected %s, got %s (%d)\n", text, ed_status_name(expected), ed_status_name(got), got);
}

void check_contains(const char *file, int line, const char *text, const char *part)
{
  checks++;
  if (!strstr(text, part) && failed(file, line))
    printf("expected a text with \"%s\", got \"%s\"\n", part, text);
}

long checks_failed(void)
{
  return failures;
}

int checks_end(const char *subject)
{
  if (failures)
    printf("%s: %ld of %ld checks failed\n", subject, failures, checks);
  else
    printf("%s: %ld checks passed\n", subject, checks);
  return failures ? 1 : 0;
}
