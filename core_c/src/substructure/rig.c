#include "substructure/rig.h"

#include <math.h>
#include <string.h>

static double dot(int n, const double *a, const double *b)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* The piston cannot leave its stroke, nor go faster than its valve lets it. */
static int hold_within(const ed_rig_model *m, double h, double from, double *x, double *v)
{
  const double fastest = m->velocity * h;
  int met = 0;
  if (fabs(*x - from) > fastest) {
    *x = from + copysign(fastest, *x - from);
    met |= ED_SATURATED_VELOCITY;
  }
  if (fabs(*x) > m->stroke) {
    *x = copysign(m->stroke, *x);
    met |= ED_SATURATED_STROKE;
  }
  if (met)
    *v = (*x - from) / h;
  return met;
}

static void move_linear(const ed_rig_model *m, ed_rig_state *s, double h, double w, double *v_start, int *saturated)
{
  const double from = s->x;
  double r[ED_RIG_STATES];
  for (int i = 0; i < m->n; i++)
    r[i] = dot(m->n, m->A + i * m->n, s->r) + m->b0[i] * s->command + m->b1[i] * w;
  memcpy(s->r, r, sizeof *r * (size_t)m->n);
  *v_start = s->v;
  s->x = dot(m->n, m->c, r) + m->d * w;
  s->v = m->n ? dot(m->n, m->c_v, r) + m->d_v * w : (s->x - from) / h;
  const int met = hold_within(m, h, from, &s->x, &s->v);
  *saturated |= met;
  if (m->n == 0 || met) /* a ramp: no velocity at its corners */
    *v_start = s->v;
}

static double limited_flow(const ed_rig_model *m, double q, double force, int *saturated)
{
  if (isinf(m->velocity))
    return q;
  /* the valve's drop of pressure is what the load leaves of the supply; q drives the piston against F > 0 when q > 0 */
  const double load = isinf(m->force) ? 0.0 : copysign(force, q * force) / m->force;
  const double most = m->velocity * sqrt(fmax(1.0 - load, 0.0));
  if (fabs(q) <= most)
    return q;
  *saturated |= ED_SATURATED_VELOCITY;
  return copysign(most, q);
}

static void move_servo(const ed_rig_model *m, ed_rig_state *s, double h, double w, double force, double *v_start, int *saturated)
{
  const double q_0 = s->flow, e_0 = s->command - s->piston, e_1 = w - (s->piston + h * q_0);
  double q_1 = m->gain * e_1;
  if (m->valve_lag > 0.0) /* exact for an error that is linear over the sub-step */
    q_1 = s->left * q_0 + m->gain * ((s->mean - s->left) * e_0 + (1.0 - s->mean) * e_1);
  q_1 = limited_flow(m, q_1, force, saturated);
  *v_start = q_0;
  s->x += 0.5 * h * (q_0 + q_1);
  s->v = s->flow = q_1;
}

void ed_rig_start(const ed_rig_model *m, ed_rig_state *s, double h)
{
  memset(s, 0, sizeof *s);
  if (m->kind == ED_RIG_SERVO_HYDRAULIC && m->valve_lag > 0.0) {
    const double n = h / m->valve_lag;
    s->left = exp(-n);
    s->mean = (1.0 - s->left) / n;
  }
}

void ed_rig_move(const ed_rig_model *m, ed_rig_state *s, double h, double w, double force, double *v_start, int *saturated)
{
  if (m->kind == ED_RIG_SERVO_HYDRAULIC)
    move_servo(m, s, h, w, force, v_start, saturated);
  else
    move_linear(m, s, h, w, v_start, saturated);
  s->command = w;
}

double ed_rig_beyond(const ed_rig_model *m, const ed_rig_state *s, double force)
{
  if (m->kind != ED_RIG_SERVO_HYDRAULIC)
    return 0.0;
  const double piston = s->x - force / m->oil;
  return fabs(piston) > m->stroke ? copysign(m->stroke, piston) : 0.0;
}

void ed_rig_stop(const ed_rig_model *m, ed_rig_state *s, double end, double force, int *saturated)
{
  s->x = end + force / m->oil;
  s->v = s->flow = 0.0;
  *saturated |= ED_SATURATED_STROKE;
}

void ed_rig_settle(const ed_rig_model *m, ed_rig_state *s, double force, int *saturated)
{
  s->piston = m->kind == ED_RIG_SERVO_HYDRAULIC ? s->x - force / m->oil : s->x;
  if (fabs(force) > m->force)
    *saturated |= ED_SATURATED_FORCE;
}
