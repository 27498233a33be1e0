/* Uniaxial steels. A law is a pure function of the committed state and the trial strain; ed_steel_commit advances the
 * state to a converged strain. */
#ifndef ED_STEEL_H
#define ED_STEEL_H

typedef struct {
  int law; /* ED_ELASTIC, ED_BILINEAR, ED_MENEGOTTO_PINTO */
  double E;
  double fy;        /* HUGE_VAL for ELASTIC */
  double hardening; /* ratio b of the tangent after yield to E */
  double H;         /* kinematic modulus b E / (1 - b) */
  double R0, cR1, cR2;
  double fatigue_strain, fatigue_exponent; /* damage of a cycle: (range / strain)^exponent; 0: fibres do not break */
} ed_steel;

enum {
  ED_BILINEAR_STATE = 1,        /* plastic strain */
  ED_MENEGOTTO_PINTO_STATE = 46
};

/* Doubles of state that a fibre of its own keeps. */
int ed_steel_state_size(const ed_steel *steel);
/* The state before any strain. */
void ed_steel_initialise(const ed_steel *steel, double *state);
/* Whether a fibre may be in this state of finite numbers. */
int ed_steel_state_valid(const ed_steel *steel, const double *state);
/* Stress and tangent at the trial strain; the return is 1 when the answer is elastic. */
int ed_steel_trial(const ed_steel *steel, const double *state, double strain, double *stress, double *tangent);
/* Moves the state to `strain`; the return is the work a unit volume dissipated on the way (energy / volume). */
double ed_steel_commit(const ed_steel *steel, double *state, double strain);
/* Recoverable energy a unit volume, sigma^2 / 2E. */
double ed_steel_stored(const ed_steel *steel, double stress);

#endif
