/* Random calls of the public interface, in the order of its life cycles and out of it: what they are given is right, wrong or absurd.
 * A seed fixes all of it. What must hold: a status of the list, finite results with ED_OK, nothing changed by a step that failed; and
 * no sanitizer has anything to say. */
#ifndef RANDOM_CALLS_H
#define RANDOM_CALLS_H

#include "edcore.h"
#include "numbers.h"

typedef struct {
  numbers source;
  double wild; /* share of absurd values */
  long calls;
  long out_of_memory; /* how often a call said so */
} caller;

/* ---- choices ---- */

int chance(caller *c, double share);
int whole(caller *c, int from, int to);                   /* both included */
double size_between(caller *c, double from, double to);   /* even in its logarithm, > 0 */
double or_absurd(caller *c, double value);                /* the value, or now and then one that nobody means */
double signed_size(caller *c, double from, double to);    /* with either sign; may be absurd */
int some_id(caller *c, int count);                        /* of `count` things, now and then of none */
int samples(caller *c, int most);                         /* a count: 1, about multiples of 64, now and then 0 or less */

/* n doubles to be freed, so that one read or written beside them is seen; NULL: n <= 0. Filled with what is not a number. */
double *room(int n);
double *values_between(caller *c, int n, double from, double to);
double *ascending(caller *c, int n, double step);

/* ---- checks ---- */

/* Counts the call; the status must be in the list. Returns it. */
int expect_listed(caller *c, int status);
/* With ED_OK or above all n values must be finite. */
#define expect_finite(status, value, n) expect_finite_at(__FILE__, __LINE__, (status), (value), (n))
void expect_finite_at(const char *file, int line, int status, const double *value, int n);

/* Ends calls that take longer than two seconds. */
extern const ed_stop IMPATIENT;

/* ---- life cycles ---- */

void call_signals(caller *c); /* spectra, recursions, fading */
void call_damper(caller *c);
void call_frame(caller *c);
void call_frame_in_space(caller *c); /* models of 3 dimensions */
void call_space(caller *c); /* space frames, combination of modes */
/* A law with parameters that suit it, or nearly: 64 doubles. Returns how many it gets. */
int some_law(caller *c, int *law, double *parameters);
int some_effect(caller *c, int *form, double *parameters);
int some_placement(caller *c);

#endif
