/* The hysteretic variable of the Bouc-Wen laws (thesis Eq. 2.68), Y z' = A v - gamma |v| z |z|^(n-1) - beta v |z|^n, as its rate
 * per deformation: z' = slope v. */
#ifndef ED_BOUC_WEN_H
#define ED_BOUC_WEN_H

#include "damper/law.h"
#include "damper/path.h"

#include <math.h>

typedef struct {
  double Y, A, beta, gamma, n;
} ed_bouc_wen_shape;

/* way: sign of the velocity (0 when it stands: what both ways have in common). */
static inline void ed_bouc_wen_slope(const ed_bouc_wen_shape *shape, double z, double way, double *slope, double *slope_z)
{
  const double size = fabs(z), n = shape->n;
  const double lower = n == 1.0 ? 1.0 : n == 2.0 ? size : pow(size, n - 1.0); /* |z|^(n-1) */
  const double side = z > 0.0 ? 1.0 : z < 0.0 ? -1.0 : 0.0;
  *slope = (shape->A - (shape->gamma * way * side + shape->beta) * lower * size) / shape->Y;
  *slope_z = -(shape->gamma * way + shape->beta * side) * n * lower / shape->Y;
}

static inline double ed_way(double v)
{
  return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0;
}

/* Whether beta and gamma go together: ED_OK, ED_E_ARGUMENT. */
int ed_bouc_wen_check(const ed_bouc_wen_shape *shape, char message[ED_DAMPER_MESSAGE]);

/* Moves z along a path, exactly to rounding whatever its length (bouc_wen_path.c). slope: derivatives of z at its end to the two
 * unknowns; zero where no direction moves the path. ED_OK; ED_E_ARGUMENT: z lies where no motion leads; ED_E_NOT_CONVERGED. */
int ed_bouc_wen_follow(const ed_bouc_wen_shape *shape, const ed_path *path, const ed_path direction[2], double *z, double slope[2]);
/* The same in two directions (bouc_wen_pair.c). slope: derivatives [of z along][to the motion along][to its two unknowns], by
 * differences of half the digits. ED_OK, ED_E_NOT_CONVERGED, ED_E_NOT_FINITE. */
int ed_bouc_wen_follow_pair(const ed_bouc_wen_shape *shape, const ed_path path[2], const ed_path direction[2], double z[2],
                            double slope[2][2][2]);

#endif
