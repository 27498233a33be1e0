/* Low-cycle fatigue of a fibre: Coffin (1954) and Manson, cycles counted by rainflow (ASTM E1049), summed by Miner (1945).
 * A cycle of the strain range r does the damage (r / strain)^exponent, half a cycle half of it. The fibre breaks at a damage of 1, in
 * tension: a crack that closes carries on. */
#ifndef ED_FATIGUE_H
#define ED_FATIGUE_H

#include "material/steel.h"

enum { ED_FATIGUE_STATE = 20 };

/* Follows a fibre to a strain; the return is the damage up to there. State: zeros before any strain. */
double ed_fatigue_follow(const ed_steel *steel, double *state, double strain);
/* Whether the fibre has broken, and that it does. */
int ed_fatigue_broken(const double *state);
void ed_fatigue_break(double *state);
int ed_fatigue_state_valid(const double *state);

#endif
