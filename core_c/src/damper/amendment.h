/* Amendments of a damper law: effects that its tests showed and the law has not. The force is phi F_law + parallel forces, phi the
 * product of the factors. Drivers (largest deformation, path, work ...) are those of the ends of steps. Private to amend*.c. */
#ifndef ED_AMENDMENT_H
#define ED_AMENDMENT_H

#include "damper/amendment_parameters.h"
#include "damper/law.h"

/* A step by its two ends; du: from the one to the other, as far as it counts. jump: deformation over which a force that jumps rises,
 * 0 unless a brace must find its balance inside the jump. */
typedef struct {
  double h, du, u1, v0, v1, jump;
} ed_ends;

/* A factor or a force at the end of a step, with its derivatives; chord: what comes to by_v1 as in ed_damper_force. */
typedef struct {
  double value, by_u1, by_v0, by_v1, chord;
} ed_amended;

typedef struct {
  const char *name;
  int is_factor;  /* of the law's force; else a force beside it */
  int has_state;  /* one double */
  int on_speed;   /* depends on time or velocity */
  /* The value at the end of a step from the state before it; writes the state after it. `out` holds zeros. */
  void (*at_end)(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out);
  /* The state after a step in which the law, with all factors, has done this work. NULL: none is counted. */
  double (*worked)(const double *p, double before, double h, double work);
} ed_amendment_kind;

struct ed_amendment {
  const ed_amendment_kind *kind;
  int state;   /* its place among the amendments' state */
  double tau;  /* of the law that it stands inside; 0: it stands beside the law */
  int relaxed; /* inside: the place of what relaxes, and behind it of the last force, or factor less 1 */
  double parameter[ED_MOST_AMENDMENT_PARAMETERS];
};

/* amend_factor.c */
extern const ed_amendment_kind ed_amend_constant, ed_amend_payne_whole, ed_amend_mullins_path, ed_amend_mullins_maximum,
    ed_amend_degradation_energy, ed_amend_self_heating_rate, ed_amend_one_sided_factor, ed_amend_payne_network, ed_amend_mullins_damage,
    ed_amend_degradation_path;
/* amend_parallel.c */
extern const ed_amendment_kind ed_amend_payne_elastic, ed_amend_mullins_elastic, ed_amend_hardening_power,
    ed_amend_hardening_threshold, ed_amend_one_sided_spring, ed_amend_relaxation_branch_maxwell, ed_amend_velocity_exponent_dashpot,
    ed_amend_velocity_exponent_flow, ed_amend_one_sided_contact, ed_amend_one_sided_even;

static inline double ed_sign(double x)
{
  return (double)((x > 0.0) - (x < 0.0));
}

/* amend_inside.c: of what `one` is at the end of a step, `found`, the force that it makes inside the law. law0, law1: force of the law at
 * both ends; before, after: the amendments' state. Adds to the force beside the law with its derivatives, and to by_law its derivative to
 * law1. */
void ed_amend_inside(const ed_amendment *one, const ed_amended *found, double h, double law0, double law1, const double *before,
                     double *after, ed_amended *beside, double *by_law);

/* Payne effect: the share g of the softening at the envelope a of the deformation, which fades with time constant tau.
 * g = (a/a0)^m / (1 + (a/a0)^m) [Kraus 1984]. */
double ed_payne_share(double a0, double m, double tau, double before, const ed_ends *ends, double *after, double *by_u1);
/* The path of the deformation: exp(-s/s0). */
double ed_path_share(double s0, double before, const ed_ends *ends, double *after, double *by_u1);

#endif
