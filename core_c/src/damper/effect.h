/* Effects that the tests of a damper law showed and the law has not. An equation, which is a factor or a force, acts at a
 * placement: the force is phi F_law + parallel forces, phi the product of the factors of the whole law, or what stands inside the law or acts
 * on its springs or dashpots alone. Drivers (largest deformation, path, work ...) are those of the ends of steps. Private to effect*.c. */
#ifndef ED_EFFECT_H
#define ED_EFFECT_H

#include "damper/effect_parameters.h"
#include "damper/law.h"

/* A step by its two ends; du: from the one to the other, as far as it counts. law: the law's force at the end. jump: deformation over which a force that jumps rises,
 * 0 unless a brace must find its balance inside the jump. path, direction: the way between them, or NULL where it does not count. */
typedef struct {
  double h, du, u1, v0, v1, law, jump;
  const ed_path *path, *direction;
} ed_ends;

/* A factor or a force at the end of a step, with its derivatives; chord: what comes to by_v1 as in ed_damper_force. by_path: to the two
 * unknowns of the path, of a force that knows more of it than its ends; by_law: to the law's force. */
typedef struct {
  double value, by_u1, by_v0, by_v1, chord, by_path[2], by_law;
} ed_effect_value;

typedef struct {
  const char *name;
  int is_factor;  /* of the law's force; else a force beside it */
  int has_state;  /* one double */
  int on_speed;   /* depends on time or velocity */
  int by_force;   /* proportional to the law's force, so that none of springs or dashpots has it without a jump */
  /* The value at the end of a step from the state before it; writes the state after it. `out` holds zeros. */
  void (*at_end)(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out);
  /* The state after a step in which the law, with all factors, has done this work. NULL: none is counted. */
  double (*worked)(const double *p, double before, double h, double work);
  /* What the next test of a specimen begins with after this state, but for what time alone changes. NULL: all of it. */
  double (*rested)(const double *p, double before);
} ed_effect_form;

struct ed_effect {
  const ed_effect_form *form;
  int placement; /* ED_PLACE_* */
  int state;     /* its place among the effects' state */
  double tau;    /* of the law that it stands inside; 0: it does not stand inside it */
  int relaxed;   /* inside: the place of what relaxes, and behind it of the last force, or factor less 1 */
  double parameter[ED_MOST_EFFECT_PARAMETERS];
};

/* effect_factor.c */
extern const ed_effect_form ed_effect_constant, ed_effect_payne_whole, ed_effect_mullins_path, ed_effect_mullins_maximum,
    ed_effect_degradation_energy, ed_effect_self_heating_rate, ed_effect_one_sided_factor, ed_effect_payne_network, ed_effect_mullins_damage,
    ed_effect_degradation_path, ed_effect_payne_exponential, ed_effect_one_sided_valve, ed_effect_one_sided_force,
    ed_effect_pinching_slip, ed_effect_limit_force;
/* effect_parallel.c */
extern const ed_effect_form ed_effect_payne_elastic, ed_effect_mullins_elastic, ed_effect_hardening_power,
    ed_effect_hardening_threshold, ed_effect_one_sided_spring, ed_effect_relaxation_branch_maxwell, ed_effect_velocity_exponent_dashpot,
    ed_effect_velocity_exponent_flow, ed_effect_one_sided_contact, ed_effect_one_sided_even, ed_effect_hardening_exponential, ed_effect_gas_spring_polytropic,
    ed_effect_hardening_saturating, ed_effect_velocity_exponent_position;
/* effect_friction.c */
extern const ed_effect_form ed_effect_friction_coulomb, ed_effect_friction_presliding, ed_effect_friction_stribeck, ed_effect_friction_loaded,
    ed_effect_hysteresis_stretch, ed_effect_hysteresis_bouc_wen;

/* effect_table.c: the forms by their id in eddamper.h (ED_EFFECT_*). NULL: no such effect. */
const ed_effect_form *ed_effect_form_of(int id);
/* Whether a damper takes one of these parameters at a placement, of which there is one. */
int ed_effect_check(const ed_damper *damper, const ed_effect_form *form, int id, int placement, int n_parameters,
                       const double *parameters, char message[ED_DAMPER_MESSAGE]);

/* Whether a placement is that of one side of the law. */
static inline int ed_of_side(int placement)
{
  return placement == ED_PLACE_SPRINGS || placement == ED_PLACE_DASHPOTS;
}

static inline double ed_sign(double x)
{
  return (double)((x > 0.0) - (x < 0.0));
}

/* effect_inside.c: what a force, or a factor of a force, makes inside a law that relaxes with tau, of what it is at the end of a step,
 * `found`. before, after: what relaxes, and the last force, or factor less 1; law0, law1: the force with the factor at both ends. Adds to the
 * force beside the law with its derivatives, and to by_law its derivative to law1. */
void ed_effect_relaxed_force(double tau, const ed_effect_value *found, double h, const double before[2], double after[2], ed_effect_value *beside);
void ed_effect_relaxed_factor(double tau, const ed_effect_value *found, double h, double law0, double law1, const double before[2],
                             double after[2], ed_effect_value *beside, double *by_law);

/* effect_sides.c: the first side are the springs of the law, the other its dashpots; ED_PLACE_SPRINGS is that of the first. */
enum { ED_SIDES = 2 };
/* Gives a damper the law without dashpots, which has one. ED_E_MEMORY and what `prepare` returns. */
int ed_sides_new(ed_damper *damper, char message[ED_DAMPER_MESSAGE]);
int ed_sides_size(const ed_damper *damper); /* doubles of state */
/* Of a state that is all zero; factor: of each side at rest. */
void ed_sides_start(const ed_damper *damper, const double factor[ED_SIDES], double *own);
void ed_sides_jump(double *own, const double *after); /* as ed_effects_jump */
/* Of a state at the end of a test, `before`, what relaxes goes on, as ed_effects_keep says; and what the law of the springs keeps. */
void ed_sides_keep(const double *before, double *own);
void ed_sides_keep_law(const ed_damper *damper, const double *before, double *own);
/* Adds to `out`, with its derivatives, what the factors change of the law's force. before, after: the state of the sides; law0: the law's
 * force at the beginning of the path; law: that at its end. */
int ed_sides_act(const ed_damper *damper, const double *before, double law0, const ed_path *path, const ed_path direction[2],
                 const ed_effect_value factor[ED_SIDES], double *after, const ed_damper_force *law, ed_damper_force *out);

/* Payne effect: the share g of the softening at the envelope a of the deformation, which fades with time constant tau.
 * g = (a/a0)^m / (1 + (a/a0)^m) [Kraus 1984]. */
double ed_payne_share(double a0, double m, double tau, double before, const ed_ends *ends, double *after, double *by_u1);
/* The path of the deformation: exp(-(s/s0)^q). */
double ed_path_share(double s0, double q, double before, const ed_ends *ends, double *after, double *by_u1);
/* The path that counts in the next test, of which a rest has healed the share `recovery` of what the path took. */
double ed_path_rested(double s0, double q, double recovery, double before);

#endif
