/* Damper laws, alone. */
#ifndef EDDAMPER_H
#define EDDAMPER_H

#include "edstatus.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Laws of dampers; parameters in this order (docs/reference/laws explains them). Any consistent units. */
enum {
  ED_LAW_KELVIN_VOIGT = 0,       /* k c */
  ED_LAW_ZENER = 1,              /* k0 k1 c1 */
  ED_LAW_GENERALISED_MAXWELL = 2,/* k0, then k_i c_i of each branch (1..16) */
  ED_LAW_FRACTIONAL_KELVIN = 3,  /* k0 c alpha: F = k0 (u + c D^alpha u) */
  ED_LAW_FRACTIONAL_ZENER = 4,   /* k0 a b alpha: F + a D^alpha F = k0 (u + b D^alpha u) */
  ED_LAW_VISCOUS = 5,            /* c */
  ED_LAW_VISCOUS_POWER = 6,      /* c alpha: F = c |v|^alpha sgn v */
  ED_LAW_MAXWELL = 7,            /* c0 lambda: F + lambda F' = c0 v */
  ED_LAW_MAXWELL_POWER = 8,      /* c alpha k: c |v|^alpha sgn v in series with the spring k */
  ED_LAW_FRACTIONAL_MAXWELL = 9, /* c0 lambda nu: F + lambda D^nu F = c0 v */
  ED_LAW_FRICTION = 10,          /* mu N k: slip at mu N, stiffness k of the connection before */
  ED_LAW_ELASTIC_PLASTIC = 11,   /* k Fy b: kinematic hardening ratio 0 <= b < 1 */
  ED_LAW_RAMBERG_OSGOOD = 12,    /* k Fy a n: u = F/k (1 + a |F/Fy|^(n-1)), Masing */
  ED_LAW_BOUC_WEN = 13,          /* Fy Y alpha A beta gamma n */
  ED_LAW_MODIFIED_BOUC_WEN = 14, /* k1 k2 u_ref Y alpha A beta gamma n C alpha_d */
  ED_LAW_ASYMPTOTE = 15,         /* f0 k1 k2 k3 kappa n c: rate-dependent asymptote law of Sause and Lee */
  ED_LAW_LINEARISED = 16,        /* k_eff zeta_eff omega: F = k_eff u + 2 zeta_eff k_eff / omega v */
  ED_LAW_MGMM = 17,              /* k1 c1 k0 c_NL alpha k_a k_b u_ref c_a c_b v_ref consistent(0, 1) */
  ED_LAW_BILINEAR_OIL = 18,      /* c F_r p: F = c v up to the relief force F_r, p c per velocity beyond */
  ED_LAW_ASYMMETRIC_VISCOUS = 19,/* c_plus c_minus alpha: F = c |v|^alpha sgn v, c_plus where v > 0 */
  ED_LAW_LEAD_RUBBER = 20,       /* Q K_d Y: elastic-plastic by characteristic strength, stiffness beyond and yield deformation */
  ED_LAW_FRICTION_PENDULUM = 21, /* W R f_slow f_fast a Y */
  ED_LAW_SELF_CENTRING = 22,     /* k Fy b beta: a gap opens at Fy and closes at (1 - beta) Fy */
  ED_LAW_GAP = 23,               /* k gap d side(0 both, 1, -1): F = k x (1 + d x'), x = side u - gap > 0 */
  ED_LAW_BUCKLING_RESTRAINED = 24, /* A_sc F_ysc E L_wp L_y KF alpha R_y, then strain_i omega_i beta_i of each point (1..16); R_y: of no force */
  ED_LAW_CHABOCHE = 25           /* k Fy C1 gamma1 C2 gamma2 Q b: X_i' = C_i p' - gamma_i X_i |p'|, R = Q (1 - exp(-b s)) */
};

typedef struct ed_damper ed_damper;

/* A damper: a law with its parameters, and the stiffness of a brace in series with it (0: rigid), whose pins have play from end to end
 * (0: none; laws without exact step refuse it). On failure *status and `message` (size bytes) say why and NULL is returned:
 * ED_E_ID, no such law; ED_E_ARGUMENT, ED_E_NOT_FINITE, a parameter is not allowed; ED_E_MEMORY. */
ed_damper *ed_damper_new(int law, int n_parameters, const double *parameters, double brace, double play, int *status,
                         char *message, int size);
void ed_damper_free(ed_damper *damper);

/* Effects that a law has not, each an equation (factor or force) at a placement. F = phi F_law + parallel forces, phi the
 * product of the factors. Their drivers are those of the ends of steps, all zero at rest: envelope a1 = max(|u1|, a exp(-h/tau_a)),
 * largest deformation M, path s += |u1 - u0|, work E of F by the trapezoidal rule, heat q1 = q exp(-h/tau_h) + beta dE. E and q act from
 * the next step on; g = (a/a0)^m / (1 + (a/a0)^m). recovery: the share that a specimen regains from one test to the next
 * (ed_damper_campaign); within one it has no use. */
enum {
  ED_EFFECT_CONSTANT = 0,                  /* factor: phi = factor */
  ED_EFFECT_PAYNE_WHOLE = 1,               /* d a0 m tau_a: phi = 1 - d g(a) */
  ED_EFFECT_PAYNE_ELASTIC = 2,             /* k a0 m tau_a: -k g(a) u */
  ED_EFFECT_MULLINS_PATH = 3,              /* m s0 q recovery: phi = 1 + m exp(-(s/s0)^q) */
  ED_EFFECT_MULLINS_MAXIMUM = 4,           /* m r beta recovery: phi = 1 - m erf((M^2 - u^2)/(r^2 + beta M^2)) */
  ED_EFFECT_MULLINS_ELASTIC = 5,           /* k s0 q recovery: k exp(-(s/s0)^q) u */
  ED_EFFECT_DEGRADATION_ENERGY = 6,        /* d E0 q: phi = 1 - d (1 - exp(-(max(E, 0)/E0)^q)) */
  ED_EFFECT_SELF_HEATING_RATE = 7,         /* beta tau_h: phi = exp(-q) */
  ED_EFFECT_HARDENING_POWER = 8,           /* k p r: k u (|u|/r)^(p-1) */
  ED_EFFECT_HARDENING_THRESHOLD = 9,       /* k u0: k max(|u| - u0, 0) sgn u */
  ED_EFFECT_ONE_SIDED_FACTOR = 10,         /* b side(1, -1): phi = 1 + b where side u > 0; with a brace rising over 1e-5 m */
  ED_EFFECT_ONE_SIDED_SPRING = 11,         /* k u0 side(1, -1): k max(side u - u0, 0) side */
  ED_EFFECT_RELAXATION_BRANCH_MAXWELL = 12,/* k tau: Q' + Q/tau = k v, v linear over the step */
  ED_EFFECT_VELOCITY_EXPONENT_DASHPOT = 13,/* c alpha: c |v|^alpha sgn v */
  ED_EFFECT_PAYNE_NETWORK = 14,            /* d s0 tau: phi = 1 - d x, x' = (1 - x) |v|/s0 - x/tau, |v| constant over the step */
  ED_EFFECT_MULLINS_DAMAGE = 15,           /* m r p recovery: phi = 1 - m (1 - exp(-(M/r)^p)) */
  ED_EFFECT_VELOCITY_EXPONENT_FLOW = 16,   /* f v0: f asinh(v/v0) */
  ED_EFFECT_DEGRADATION_PATH = 17,         /* d s0 q: phi = 1 - d (1 - exp(-(s/s0)^q)) */
  ED_EFFECT_ONE_SIDED_CONTACT = 18,        /* k u0 n side(1, -1) r: k x (x/r)^(n-1) side, x = max(side u - u0, 0) */
  ED_EFFECT_ONE_SIDED_EVEN = 19,           /* k n r: k |u| (|u|/r)^(n-1) */
  ED_EFFECT_PAYNE_EXPONENTIAL = 20,        /* d a0 m tau_a: phi = 1 - d (1 - exp(-(a/a0)^m)) */
  ED_EFFECT_HARDENING_EXPONENTIAL = 21,    /* k u0: k u (exp((u/u0)^2) - 1) */
  ED_EFFECT_FRICTION_COULOMB = 22,         /* F_c v0: F_c tanh(v/v0) */
  ED_EFFECT_FRICTION_PRESLIDING = 23,      /* F_c x0 n: F_c z, x0 z' = v - |v| z |z|^(n-1), exact over the way of the path (Dahl) */
  ED_EFFECT_FRICTION_STRIBECK = 24,        /* F_c s v_s: F_c (1 + s exp(-(v/v_s)^2)) tanh(10 v/v_s) */
  ED_EFFECT_ONE_SIDED_VALVE = 25,          /* b v0 side(1, -1): phi = 1 + b max(tanh(side v/v0), 0) */
  ED_EFFECT_GAS_SPRING_POLYTROPIC = 26,    /* P c n: P (1 - c u)^-n; beyond c u = 0.95 straight */
  ED_EFFECT_ONE_SIDED_FORCE = 27,          /* b side(1, -1): phi = 1 + b where side F_law > 0 */
  ED_EFFECT_HARDENING_SATURATING = 28,     /* k u0: k u0 tanh(u/u0) */
  ED_EFFECT_VELOCITY_EXPONENT_POSITION = 29, /* c alpha q r: c (|u|/r)^q |v|^alpha sgn v */
  ED_EFFECT_HYSTERESIS_STRETCH = 30,       /* F_y Y n r: F_y (|u|/r)^n z/Y, z' = v - |v| z/Y, exact over the way of the path */
  ED_EFFECT_HYSTERESIS_BOUC_WEN = 31,      /* k beta gamma: k z, z' = v - gamma |v| z - beta v |z|, exact over the way of the path */
  ED_EFFECT_PINCHING_SLIP = 32,            /* d w: phi = 1 - d exp(-(u/(w M))^2) */
  ED_EFFECT_FRICTION_LOADED = 33,          /* mu F_c v0: (F_c + mu |F_law|) tanh(v/v0) */
  ED_EFFECT_LIMIT_FORCE = 34               /* s F_l side(1, -1): phi F_law = F_law - s max(|F_law| - F_l, 0) sgn F_law; side 0: both */
};
/* Where an equation acts.
 * WHOLE: a factor on all of the law's force, a force beside it.
 * INSIDE: in a law that relaxes all of its forces, F_law + tau F_law' = everything (ED_LAW_MGMM, tau = c1/k1): it adds Q to the force,
 * Q + tau Q' = force, or (phi - 1)(F_law + tau F_law') for a factor; force, phi and F_law linear over the step.
 * SPRINGS, DASHPOTS: a factor on that part of the force alone. F_law = F_s + F_d, F_s that of the same law without dashpots: the spring of
 * ED_LAW_KELVIN_VOIGT, LINEARISED, ZENER, GENERALISED_MAXWELL, FRACTIONAL_KELVIN and FRACTIONAL_ZENER; of ED_LAW_MGMM the force with F_s + tau
 * F_s' = (k0 + k_mod) u. F_law becomes phi_s F_s + phi_d F_d, phi_s and phi_d the products of such factors; in the MGMM they act inside. */
enum { ED_PLACE_WHOLE = 0, ED_PLACE_INSIDE = 1, ED_PLACE_SPRINGS = 2, ED_PLACE_DASHPOTS = 3 };
/* Adds one to a damper, before its first state is made; several act together. A brace stands in series with both; laws
 * without exact step refuse effects with a brace. `message` (size bytes) says why it is refused, and then nothing has changed: ED_E_ID,
 * ED_E_ARGUMENT (the law has no such placement, or the equation is a force and the placement for factors), ED_E_NOT_FINITE, ED_E_MEMORY. */
int ed_damper_add_effect(ed_damper *damper, int form, int placement, int n_parameters, const double *parameters, char *message, int size);
int ed_effect_remembers(int form); /* whether an effect has a state: 1 or 0; ED_E_ID: there is no such effect */
/* What a damper went through before it starts, for laws that extremes soften (ED_LAW_MGMM; others do not mind): largest deformation
 * and velocity (>= 0), smallest ones (<= 0), in the order largest u, smallest u, largest v, smallest v. ED_E_ARGUMENT: they are not so. */
int ed_damper_set_prior_extremes(ed_damper *damper, const double extremes[4]);
/* Whom calls with this damper ask whether to stop; NULL, or before this call: nobody. */
void ed_damper_ask(ed_damper *damper, const ed_stop *stop);
int ed_damper_state_size(const ed_damper *damper);            /* doubles */
void ed_damper_start(const ed_damper *damper, double *state); /* at rest */

/* ED_DAMPER_BEST: the exact step where the law has one, else SUNDIALS; ED_DAMPER_ODE: SUNDIALS; ED_DAMPER_FIXED: the exact step where the
 * law has one that is not itself an integration in parts (ED_LAW_MAXWELL_POWER), else a method of order 2 in as many sub-steps as the
 * motion asks for, 1 to 64 from one turn to the next. With it forces are a smooth function of the parameters.
 * A state goes on by the method that made it. */
enum { ED_DAMPER_BEST = 0, ED_DAMPER_ODE = 1, ED_DAMPER_FIXED = 2 };
/* One step of duration h from `committed`, along the cubic through deformation and velocity at both ends. Writes the state at its
 * end, the force there, and its derivatives to u1 and v1 (slope). Repeated calls give the same. fineness: of SUNDIALS its relative
 * tolerance; of ED_DAMPER_FIXED a length > 0 in which the law changes, such as the deformation at yield: a sub-step moves a quarter of
 * it at most. */
int ed_damper_step(const ed_damper *damper, int method, double fineness, const double *committed, double h, double u0, double v0,
                   double u1, double v1, double *trial, double *force, double *slope);
/* Force under n samples of deformation u and velocity v at ascending times, from rest; held at u[0] for long before. force: n.
 * *done: samples that were reached when it fails. */
int ed_damper_history(const ed_damper *damper, int method, double fineness, int n, const double *time, const double *u,
                      const double *v, double *force, int *done);
/* What stands in series with a damper. It carries within (e - z) + stiffness * side * z (1 + bend z^2) at a stretch e, z: e beyond play/2,
 * either way; side: 1, or `back` where e < 0. With another power than 1 (at least that) it is stiffness * side * z |sqrt(bend) z|^(power
 * - 1) beyond the play, bend > 0, play = 0. Beside all of it damping e'. stiffness, back > 0; bend, within, play, damping >= 0, play from
 * end to end. */
typedef struct {
  double stiffness, back; /* N/m */
  double bend;            /* 1/m^2 */
  double power;           /* 1 */
  double within;          /* N/m */
  double play;            /* m */
  double damping;         /* N s/m */
} ed_rig;
/* One test of a campaign: the deformation u is u_d of the damper and the stretch e of the rig, whose force is factor F(u_d) + added +
 * spring u_d. factor (>= 0), added, spring (>= 0): n, or NULL for 1, 0 and 0; rig: NULL, none. e is a parabola between samples, and linear
 * over parts of a step in which it comes to an end of the play. */
typedef struct {
  int n;
  const double *time, *u, *v;
  const double *factor, *added, *spring;
  const ed_rig *rig;
  double rest; /* s since the test before, > 0 where the specimen carries something over; not asked for of the first one */
  const struct ed_damper *const *damper; /* n_sets of the same law and effects, with other values, in place of the campaign's; or NULL */
} ed_test;
/* What ed_damper_campaign carries from test to test: nothing; all that it says; of that the states of effects alone. */
enum { ED_CARRY_NOTHING = 0, ED_CARRY_ALL = 1, ED_CARRY_EFFECTS = 2 };
/* How a damper came through a campaign: ED_OK, or why it did not, in which test and at which sample, both from 0. */
typedef struct {
  int status, test, sample;
} ed_campaign_end;
/* Forces of n_sets dampers in the same n_tests tests, without rig as from ed_damper_history to the last bit. force: [set][test][sample],
 * the samples of tests one behind the other; own: the deformations u_d in the same order, or NULL. end: n_sets; a damper that fails leaves
 * NaN from there on and does not stop the others. fineness: behind a rig SUNDIALS has the tolerance that the balance asks for.
 * carry: the tests are those of one specimen, in this order. Extremes that soften a law (ED_LAW_MGMM, ED_LAW_MODIFIED_BOUC_WEN) and the
 * states of effects go on from test to test; over a rest, held at the next first deformation, envelope, network, heat and what relaxes
 * fade, and no way or work is counted. With `recovery` exp(-s/s0) comes back to l + recovery (1 - l), l what was left of it, and M to (1 -
 * recovery) M; friction that builds up over a way begins anew, as all else of the law does. carry = 0: each test has a new specimen.
 * ED_E_ARGUMENT, ED_E_NOT_FINITE: a test that is not allowed, and every `end` says which; ED_E_STOPPED. Calls for different dampers
 * may run in parallel. */
int ed_damper_campaign(int n_sets, const ed_damper *const *damper, int n_tests, const ed_test *test, int method, double fineness,
                       int carry, double *force, double *own, ed_campaign_end *end);

/* One test of a linear structure with dampers as links: n >= 2 samples, h apart. Matrices by rows; from sample to sample
 * x_(i+1) = a x_i + pushed_i + from_links[0] f_i + from_links[1] f_(i+1)
 * with x the state (n_states), f the forces of the links, whose effect is linear between samples, and pushed what the motion of the
 * ground adds to the state in a step: the caller may sum up in it a motion that is known at more instants than the samples. */
typedef struct {
  int n;
  double h;
  const double *pushed;        /* (n - 1) x n_states */
  const double *a;             /* n_states x n_states */
  const double *from_links[2]; /* n_states x n_links each */
} ed_linked_test;
/* Tests of one structure in their order, each from rest. damper: n_links; link k has the deformation seen[k] x and the velocity
 * seen[n_links + k] x, rows of n_states. The forces at the end of a step are found by Newton's method; steps shall be so short that a
 * link's tangent stiffness changes little of a step. carry, rest (s, > 0): as of ed_damper_campaign, of the links. state: [test][sample]
 * [n_states], force: [test][sample][n_links]. method, fineness: as in ed_damper_step. *end: how it ended, also returned; ED_E_NOT_CONVERGED:
 * no balance. What comes after that is not written. */
int ed_linked_history(int n_states, int n_links, const ed_damper *const *damper, const double *seen, int n_tests,
                      const ed_linked_test *test, int carry, double rest, int method, double fineness, double *state, double *force,
                      ed_campaign_end *end);

/* q_0 = before, q_i = decay_(i-1) q_(i-1) + made_(i-1). q: n >= 1; decay, made: n - 1. What is not finite is passed on to all that
 * follows, and ED_E_NOT_FINITE says that there is some. */
int ed_fading(int n, const double *decay, const double *made, double before, double *q);
/* The same of complex numbers, real and imaginary part side by side. */
int ed_fading_complex(int n, const double *decay, const double *made, const double *before, double *q);

#ifdef __cplusplus
}
#endif

#endif
