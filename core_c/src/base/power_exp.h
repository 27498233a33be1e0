/* Powers and exponentials of many numbers at once: a vector of the processor takes four, and the library's functions one. */
#ifndef ED_POWER_EXP_H
#define ED_POWER_EXP_H

enum { ED_POWER_BLOCK = 4 };

/* result = base^power exp(rise), base > 0, of n numbers. Whole blocks are read and written: arrays have room for a multiple of
 * ED_POWER_BLOCK, all of it set. Relative error below 2e-14 where power ln(base) and rise are below 40 in size, growing with them; results
 * beyond e^+-700 are those there. */
void ed_power_exp(int n, double power, const double *base, const double *rise, double *result);

#endif
