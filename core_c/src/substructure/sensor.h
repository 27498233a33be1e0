/* What a sensor reads: normal noise, then whole steps of quantisation within a range. The noise is a sequence that its seed alone decides. */
#ifndef ED_SENSOR_H
#define ED_SENSOR_H

#include <math.h>

typedef struct {
  double noise, quantisation, range;
  unsigned long long state;
  double spare; /* the second of a pair of normal numbers */
  int has_spare;
} ed_sensor;

/* Equally distributed in (0, 1): splitmix64 (Steele, Lea & Flood 2014). */
static inline double ed_sensor_uniform(ed_sensor *sensor)
{
  unsigned long long z = sensor->state += 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return ((double)((z ^ (z >> 31)) >> 11) + 0.5) / 9007199254740992.0;
}

/* Marsaglia's polar method. */
static inline double ed_sensor_normal(ed_sensor *sensor)
{
  if (sensor->has_spare) {
    sensor->has_spare = 0;
    return sensor->spare;
  }
  for (;;) {
    const double x = 2.0 * ed_sensor_uniform(sensor) - 1.0, y = 2.0 * ed_sensor_uniform(sensor) - 1.0, square = x * x + y * y;
    if (square < 1.0 && square > 0.0) {
      const double factor = sqrt(-2.0 * log(square) / square);
      sensor->spare = y * factor;
      sensor->has_spare = 1;
      return x * factor;
    }
  }
}

/* *clipped: 1 where the range ends the reading, else as it was. */
static inline double ed_sensor_read(ed_sensor *sensor, double value, int *clipped)
{
  if (sensor->noise > 0.0)
    value += sensor->noise * ed_sensor_normal(sensor);
  if (sensor->quantisation > 0.0)
    value = sensor->quantisation * rint(value / sensor->quantisation);
  if (fabs(value) > sensor->range) {
    *clipped = 1;
    value = copysign(sensor->range, value);
  }
  return value;
}

#endif
