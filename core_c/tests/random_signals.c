#include "random_calls.h"

#include "checks.h"

#include <stdlib.h>

enum { MOST_SAMPLES = 700, MOST_OSCILLATORS = 70 };

static void call_spectra(caller *c)
{
  const int n = samples(c, MOST_SAMPLES), m = chance(c, 0.1) ? whole(c, -1, 0) : whole(c, 1, MOST_OSCILLATORS);
  const int n_angles = chance(c, 0.05) ? whole(c, -1, 400) : whole(c, 1, 20);
  const double dt = or_absurd(c, size_between(c, 1e-3, 1e-1));
  double *a = values_between(c, n, 1e-3, 10.0), *b = values_between(c, n, 1e-3, 10.0);
  double *period = room(m), *damping = room(m), *sd = room(m), *sv = room(m), *sa = room(m);
  for (int i = 0; i < m; i++) {
    period[i] = dt * size_between(c, 4.0, 1e4);
    damping[i] = chance(c, 0.1) ? 0.0 : next_number(&c->source, 0.0, 0.999);
  }
  if (m > 0 && chance(c, c->wild))
    (chance(c, 0.5) ? period : damping)[whole(c, 0, m - 1)] = or_absurd(c, 0.0);
  for (int i = n / 2; i < n && chance(c, 0.9); i++)
    a[i] = 0.0; /* a motion that ends early */
  const int all = chance(c, 0.5);
  int status = expect_listed(c, ed_response_spectrum(n, dt, a, m, period, damping, sd, all ? sv : NULL, all ? sa : NULL, &IMPATIENT));
  expect_finite(status, sd, m);
  if (all) {
    expect_finite(status, sv, m);
    expect_finite(status, sa, m);
  }
  double *rotated = room(m > 0 && n_angles > 0 ? m * n_angles : 0);
  status = expect_listed(c, ed_rotated_spectrum(n, dt, a, b, m, period, damping, n_angles, rotated, chance(c, 0.5) ? &IMPATIENT : NULL));
  expect_finite(status, rotated, m > 0 && n_angles > 0 ? m * n_angles : 0);
  free(a), free(b), free(period), free(damping), free(sd), free(sv), free(sa), free(rotated);
}

static void call_peaks(caller *c)
{
  const int n = samples(c, MOST_SAMPLES), m = whole(c, 0, 20), most = chance(c, 0.05) ? whole(c, -1, 0) : whole(c, 1, 30);
  double *x = values_between(c, n, 1e-3, 10.0), *b = values_between(c, 3 * m, 1e-2, 1.0);
  double *a = values_between(c, 2 * m, 1e-2, chance(c, 0.8) ? 0.5 : 3.0);
  const int rows = most > 0 ? m * most : 0;
  double *place = room(rows), *value = room(rows);
  int *count = calloc((size_t)m + 1, sizeof *count);
  const double share = or_absurd(c, next_number(&c->source, 0.0, 1.0));
  const int status = expect_listed(c, ed_recursion_peaks(n, x, m, b, a, share, most, count, place, value, &IMPATIENT));
  for (int i = 0; status == ED_OK && i < m; i++) {
    CHECK(count[i] >= 0 && count[i] <= most);
    expect_finite(status, place + i * most, count[i]);
    expect_finite(status, value + i * most, count[i]);
  }
  free(x), free(b), free(a), free(place), free(value), free(count);
}

static void call_fading(caller *c)
{
  const int n = samples(c, MOST_SAMPLES);
  double *decay = values_between(c, 2 * n, 0.1, 1.0), *made = values_between(c, 2 * n, 1e-3, 1.0), *q = room(2 * n), before[2];
  before[0] = signed_size(c, 1e-3, 1.0), before[1] = signed_size(c, 1e-3, 1.0);
  expect_finite(expect_listed(c, ed_fading(n, decay, made, before[0], q)), q, n);
  expect_finite(expect_listed(c, ed_fading_complex(n, decay, made, before, q)), q, 2 * n);
  free(decay), free(made), free(q);
}

void call_signals(caller *c)
{
  call_spectra(c);
  call_peaks(c);
  call_fading(c);
  CHECK(ed_status_name(whole(c, -20, 100)) && ed_status_text(whole(c, -20, 100)) && ed_version());
  char versions[2][8];
  expect_listed(c, ed_library_versions(whole(c, -1, 8), versions[0], versions[1]));
}
