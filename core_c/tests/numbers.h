/* Numbers that look random and are the same on every machine. */
#ifndef NUMBERS_H
#define NUMBERS_H

typedef struct {
  unsigned long long state;
} numbers;

/* Uniform in [from, to). */
double next_number(numbers *source, double from, double to);
double largest_of(const double *values, int n); /* largest magnitude */

#endif
