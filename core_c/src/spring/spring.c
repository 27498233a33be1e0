#include "spring/spring.h"

#include "edcore.h"

#include <math.h>
#include <string.h>

static const char *set_multilinear(ed_spring *spring, int n, const double *p)
{
  ed_multilinear *law = &spring->of.multilinear;
  if (n < 1 || n % 2 == 0 || n > 2 * ED_MAX_CORNERS + 1)
    return "a line of up to 4 corners has deformation and force of each, and its last slope";
  law->n = n / 2;
  law->elastic = p[n - 1];
  double before = 0.0, force_before = 0.0, slope[ED_MAX_CORNERS + 1];
  for (int i = 0; i < law->n; i++) {
    if (!(p[2 * i] > before && p[2 * i + 1] > force_before))
      return "deformations and forces of the corners must rise from 0";
    slope[i] = (p[2 * i + 1] - force_before) / (p[2 * i] - before);
    before = p[2 * i];
    force_before = p[2 * i + 1];
  }
  slope[law->n] = law->elastic;
  if (!(law->elastic >= 0.0 && slope[0] > 0.0))
    return "the first slope must be positive and the last one not negative";
  for (int i = 0; i < law->n; i++) {
    law->stiffness[i] = slope[i] - slope[i + 1];
    law->yield[i] = law->stiffness[i] * p[2 * i];
    if (!(law->stiffness[i] > 0.0))
      return "each slope must be less steep than the one before";
  }
  spring->stiffness = slope[0];
  return NULL;
}

static const char *set_contact(ed_spring *spring, int n, const double *p)
{
  if (n != 2 || !(p[0] > 0.0 && p[1] > 0.0) || !isfinite(p[0]))
    return "stiffness and capacity must be positive";
  spring->of.contact = (ed_contact){p[0], p[1]};
  spring->stiffness = p[0];
  return NULL;
}

static const char *set_deteriorating(ed_spring *spring, int n, const double *p)
{
  enum { SIDE = 7, SIDES = 1, CAPACITIES = SIDES + 2 * SIDE, EXPONENTS = CAPACITIES + ED_DETERIORATIONS, ALL = EXPONENTS + ED_DETERIORATIONS };
  ed_deteriorating *law = &spring->of.deteriorating;
  if (n != ALL || !(p[0] > 0.0))
    return "stiffness > 0, 7 values of each side, 3 capacities and 3 exponents are needed";
  law->stiffness = spring->stiffness = p[0];
  for (int i = 0; i < 2; i++) {
    const double *q = p + SIDES + i * SIDE;
    ed_deteriorating_side *side = &law->side[i];
    *side = (ed_deteriorating_side){q[0], q[1], q[2], q[3], q[4], q[5], q[6]};
    if (!(side->yield > 0.0 && side->plastic > 0.0 && side->capping > 0.0))
      return "yield force, deformation before capping and after it must be positive";
    if (!(side->ultimate > side->yield / law->stiffness))
      return "the ultimate deformation must be beyond that at yield";
    if (!(side->capped >= 1.0))
      return "the force at capping must not be below that at yield";
    if (!((side->capped - 1.0) * side->yield < law->stiffness * side->plastic))
      return "the slope after yielding must be below the stiffness";
    if (!(side->residual >= 0.0 && side->residual < side->capped))
      return "the residual strength must not be negative, and below that at capping";
    if (!(side->rate >= 0.0 && side->rate <= 1.0))
      return "rates of deterioration must be in 0..1";
  }
  for (int i = 0; i < ED_DETERIORATIONS; i++) {
    law->capacity[i] = p[CAPACITIES + i];
    law->exponent[i] = p[EXPONENTS + i];
    if (!(law->capacity[i] > 0.0 && law->exponent[i] > 0.0 && isfinite(law->exponent[i])))
      return "energy capacities and exponents must be positive";
  }
  return NULL;
}

const char *ed_spring_set(ed_spring *spring, int law, int n, const double *parameters)
{
  spring->law = law;
  for (int i = 0; i < n; i++)
    if (isnan(parameters[i]))
      return "a parameter is not a number";
  switch (law) {
    case ED_SPRING_MULTILINEAR:
      return set_multilinear(spring, n, parameters);
    case ED_SPRING_CONTACT:
      return set_contact(spring, n, parameters);
    case ED_SPRING_DETERIORATING:
      return set_deteriorating(spring, n, parameters);
    default:
      return "there is no such law";
  }
}

int ed_spring_state_size(const ed_spring *spring)
{
  switch (spring->law) {
    case ED_SPRING_MULTILINEAR:
      return spring->of.multilinear.n; /* plastic deformations */
    case ED_SPRING_CONTACT:
      return 1;                        /* how far it has given way */
    default:
      return ED_DETERIORATING_STATE;
  }
}

void ed_spring_initialise(const ed_spring *spring, double *state)
{
  if (spring->law == ED_SPRING_DETERIORATING)
    ed_deteriorating_initialise(&spring->of.deteriorating, state);
  else
    memset(state, 0, (size_t)ed_spring_state_size(spring) * sizeof *state);
}

int ed_spring_state_valid(const ed_spring *spring, const double *state)
{
  return spring->law != ED_SPRING_DETERIORATING || ed_deteriorating_valid(state);
}

static double within(double force, double limit)
{
  return force > limit ? limit : force < -limit ? -limit : force;
}

int ed_spring_trial(const ed_spring *spring, const double *state, double u, double *force, double *tangent)
{
  if (spring->law == ED_SPRING_DETERIORATING) {
    ed_deteriorating_trial(&spring->of.deteriorating, state, u, force, tangent);
    return *tangent == spring->stiffness;
  }
  if (spring->law == ED_SPRING_CONTACT) {
    const ed_contact *law = &spring->of.contact;
    const double push = law->stiffness * (u - state[0]);
    const int elastic = push <= 0.0 && push >= -law->capacity;
    *force = fmin(0.0, fmax(push, -law->capacity));
    *tangent = elastic ? law->stiffness : 0.0;
    return elastic;
  }
  const ed_multilinear *law = &spring->of.multilinear;
  int elastic = 1;
  *force = law->elastic * u;
  *tangent = law->elastic;
  for (int i = 0; i < law->n; i++) {
    const double trial = law->stiffness[i] * (u - state[i]), limited = within(trial, law->yield[i]);
    *force += limited;
    if (limited == trial)
      *tangent += law->stiffness[i];
    else
      elastic = 0;
  }
  if (elastic)
    *tangent = spring->stiffness;
  return elastic;
}

double ed_spring_commit(const ed_spring *spring, double *state, double u)
{
  if (spring->law == ED_SPRING_DETERIORATING)
    return ed_deteriorating_commit(&spring->of.deteriorating, state, u);
  if (spring->law == ED_SPRING_CONTACT) {
    const ed_contact *law = &spring->of.contact;
    const double given = fmin(0.0, u + law->capacity / law->stiffness - state[0]);
    state[0] += given;
    return given < 0.0 ? -given * law->capacity : 0.0;
  }
  const ed_multilinear *law = &spring->of.multilinear;
  double dissipated = 0.0;
  for (int i = 0; i < law->n; i++) {
    const double trial = law->stiffness[i] * (u - state[i]), limited = within(trial, law->yield[i]);
    const double flow = (trial - limited) / law->stiffness[i];
    state[i] += flow;
    dissipated += limited * flow;
  }
  return dissipated;
}

double ed_spring_stored(const ed_spring *spring, const double *state, double u)
{
  if (spring->law == ED_SPRING_DETERIORATING)
    return ed_deteriorating_stored(state);
  if (spring->law == ED_SPRING_CONTACT) {
    const double push = fmin(0.0, u - state[0]);
    return 0.5 * spring->stiffness * push * push;
  }
  const ed_multilinear *law = &spring->of.multilinear;
  double stored = 0.5 * law->elastic * u * u;
  for (int i = 0; i < law->n; i++)
    stored += 0.5 * law->stiffness[i] * (u - state[i]) * (u - state[i]);
  return stored;
}

double ed_spring_strength_left(const ed_spring *spring, const double *state)
{
  return spring->law == ED_SPRING_DETERIORATING ? ed_deteriorating_left(&spring->of.deteriorating, state) : 1.0;
}
