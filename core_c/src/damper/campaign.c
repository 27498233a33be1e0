/* Many dampers in the tests of one campaign. */
#include "damper/run_of_test.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
  int n_tests;
  const ed_test *test;
  int method;
  double fineness;
  int carry;
  size_t samples; /* of all tests */
  double *own;    /* room for the deformations of a test that nobody asks for */
  double *law;    /* room for what the law alone carries in all tests; NULL: no two sets have that in common */
  int known;      /* the set whose law is known; -1: none */
  ed_watch watch;
} campaign;

/* One test of one damper; force, own: its samples, own NULL where not wanted. */
static int one_test(const campaign *of, ed_test_run *run, const ed_test *test, double *force, double *own, int *done)
{
  const int fixed = of->method == ED_DAMPER_FIXED;
  int status = ed_test_run_tune(run, test->rig && !fixed ? ED_SERIES_TOLERANCE : of->fineness);
  if (status != ED_OK)
    return status;
  if (test->rig)
    return ed_test_run_in_series(run, test, force, own ? own : of->own, done);
  status = ed_test_run_history(run, test->n, test->time, test->u, test->v, force, done);
  for (int i = 0; i < *done; i++) {
    if (test->factor)
      force[i] *= test->factor[i];
    if (test->added)
      force[i] += test->added[i];
    if (test->spring)
      force[i] += test->spring[i] * test->u[i];
    if (own)
      own[i] = test->u[i];
    if (!isfinite(force[i])) {
      *done = i;
      return ED_E_NOT_FINITE;
    }
  }
  return status;
}

/* Steps of a test beside those from sample to sample: to the first deformation, over a rest, and to the first velocity. */
enum { FIRST_STEPS = 3 };

static const ed_damper *in_test(const ed_test *test, const ed_damper *const *damper, int set)
{
  return test->damper ? test->damper[set] : damper[set];
}

/* Whether two sets differ in nothing but effects, and their law in no test minds these. */
static int share_law(const campaign *of, const ed_damper *const *damper, int one, int other)
{
  for (int i = 0; i < of->n_tests; i++)
    if (of->test[i].rig || !ed_test_run_shares_law(in_test(&of->test[i], damper, one), in_test(&of->test[i], damper, other)))
      return 0;
  return of->carry != ED_CARRY_ALL;
}

static int is_shared_later(const campaign *of, const ed_damper *const *damper, int n_sets, int set)
{
  for (int i = set + 1; i < n_sets; i++)
    if (share_law(of, damper, set, i))
      return 1;
  return 0;
}

/* All tests of one set. law: what its law carries alone, known or to be written; or NULL. */
static ed_campaign_end one_set(campaign *of, int set, const ed_damper *damper, ed_law_forces *law, double *force, double *own)
{
  ed_campaign_end end = {.status = ED_OK};
  ed_test_run run;
  size_t at = 0;
  end.status = ed_test_run_open(&run, damper, of->method, of->fineness, &of->watch);
  run.keeps_law = of->carry == ED_CARRY_ALL;
  run.law = run.stepper.fixed || run.stepper.system ? NULL : law;
  for (int i = 0; end.status == ED_OK && i < of->n_tests; i++) {
    if (of->carry && i > 0)
      ed_test_run_carry(&run, of->test[i].rest);
    end.test = i;
    end.sample = 0;
    end.status = ed_test_run_exchange(&run, of->test[i].damper ? of->test[i].damper[set] : damper);
    if (end.status != ED_OK)
      break;
    end.status = one_test(of, &run, &of->test[i], force + at, own ? own + at : NULL, &end.sample);
    at += (size_t)(end.status == ED_OK ? of->test[i].n : end.sample);
  }
  ed_test_run_close(&run);
  if (end.status == ED_OK)
    return (ed_campaign_end){.status = ED_OK};
  for (size_t i = at; i < of->samples; i++) {
    force[i] = NAN;
    if (own)
      own[i] = NAN;
  }
  return end;
}

/* Whether the tests are allowed; else where not. Counts their samples, and those of the longest. */
static ed_campaign_end check(campaign *of, int *longest)
{
  *longest = 0;
  for (int i = 0; i < of->n_tests; i++) {
    const ed_test *test = &of->test[i];
    int done;
    const int status = ed_check_test(test, &done);
    if (status != ED_OK)
      return (ed_campaign_end){status, i, done};
    if (of->carry && i > 0 && !(test->rest > 0.0 && isfinite(test->rest)))
      return (ed_campaign_end){ED_E_ARGUMENT, i, 0};
    of->samples += (size_t)test->n;
    *longest = test->n > *longest ? test->n : *longest;
  }
  return (ed_campaign_end){.status = ED_OK};
}

int ed_damper_campaign(int n_sets, const ed_damper *const *damper, int n_tests, const ed_test *test, int method, double fineness,
                       int carry, double *force, double *own, ed_campaign_end *end)
{
  if (n_sets < 1 || n_tests < 1)
    return ED_E_ARGUMENT;
  campaign of = {.n_tests = n_tests, .test = test, .method = method, .fineness = fineness, .carry = carry, .known = -1,
                 .watch = ed_watch_of(&damper[0]->stop)};
  int longest;
  const ed_campaign_end wrong = check(&of, &longest);
  for (int i = 0; i < n_sets; i++)
    end[i] = wrong;
  if (wrong.status != ED_OK)
    return wrong.status;
  of.own = own ? NULL : malloc((size_t)longest * sizeof *of.own);
  if (!own && !of.own)
    return ED_E_MEMORY;
  int status = ED_OK;
  for (int i = 0; i < n_sets && status == ED_OK; i++) {
    const size_t first = (size_t)i * of.samples;
    ed_law_forces law = {.force = of.law, .known = of.known >= 0 && share_law(&of, damper, of.known, i)};
    const int written = !law.known && is_shared_later(&of, damper, n_sets, i);
    if (written && !of.law) {
      of.law = law.force = malloc((of.samples + FIRST_STEPS * (size_t)n_tests) * sizeof *of.law);
      if (!of.law) {
        status = ED_E_MEMORY;
        break;
      }
    }
    const int shared = law.known || written;
    end[i] = one_set(&of, i, damper[i], shared ? &law : NULL, force + first, own ? own + first : NULL);
    if (written)
      of.known = end[i].status == ED_OK ? i : -1;
    if (end[i].status == ED_E_STOPPED)
      status = ED_E_STOPPED;
  }
  free(of.own);
  free(of.law);
  return status;
}
