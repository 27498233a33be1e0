/* Terms of the MGMM (mgmm.c) over one step: those whose moduli soften with the running extremes. */
#ifndef ED_MGMM_TERMS_H
#define ED_MGMM_TERMS_H

#include "damper/law.h"
#include "damper/power_integral.h"
#include "damper/softening.h"

/* Memory of the law: extremes, and the moduli k_mod and c_mod that they leave as long as none grows. */
enum { ED_LARGEST_U, ED_SMALLEST_U, ED_LARGEST_V, ED_SMALLEST_V, ED_K_MOD, ED_C_MOD, ED_MGMM_MEMORY };

typedef struct {
  double tau, k0, c1, c_nl, alpha;
  double relaxing; /* share of k_mod u in Q: 1 as printed, 0 when consistent */
  ed_softening k_mod, c_mod;
  ed_power_rule power;
} ed_mgmm_constants;

static inline const ed_mgmm_constants *ed_mgmm_constants_of(const ed_damper *damper)
{
  return (const ed_mgmm_constants *)(const void *)damper->derived;
}

/* A step, or the end of it that is not forgotten. */
typedef struct {
  ed_path path, velocity;
  const ed_path *direction, *velocity_direction; /* NULL when no slopes are wanted */
  double value, slope[2];                        /* Q(h) without Q(0), as far as it is gathered */
} ed_mgmm_sums;

/* The terms k_mod u and (c1 + c_mod) v. of_u, of_v: pieces of the softening, of which the last ones go to the end of the step. 0: the path
 * is not finite. */
int ed_mgmm_add_softened(const ed_mgmm_constants *law, ed_mgmm_sums *sum, const ed_softening_piece *of_u,
                          const ed_softening_piece *of_v);

/* Extremes of the deformation (largest: ED_LARGEST_U) or of the velocity. */
static inline ed_running ed_mgmm_extremes(const double *memory, int largest)
{
  return (ed_running){memory[largest], memory[largest + 1]};
}

void ed_mgmm_remember(const ed_mgmm_constants *law, ed_running of_u, ed_running of_v, double *memory);

/* Whether no extreme grows over a step, so that both moduli are constant: by bounds of the cubic and its derivative. */
int ed_mgmm_still(const double *memory, const ed_path *path);

#endif
