#include "numbers.h"

#include <math.h>

double next_number(numbers *source, double from, double to)
{
  /* Knuth's MMIX linear congruential generator; the high bits are the good ones */
  source->state = source->state * 6364136223846793005ULL + 1442695040888963407ULL;
  return from + (to - from) * ((double)(source->state >> 11) / 9007199254740992.0);
}

double largest_of(const double *values, int n)
{
  double largest = 0.0;
  for (int i = 0; i < n; i++)
    largest = fmax(largest, fabs(values[i]));
  return largest;
}
