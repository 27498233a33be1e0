/* Delay compensators of real-time substructure tests: C99 in one header, without allocation, for a virtual test and for the
 * signal processor of a laboratory alike.
 *
 *   static ed_compensator state;                          // one for each actuator
 *   ed_compensator_start(&parameters, &state);            // before the test
 *   u = ed_compensator_step(&parameters, &state, x, v, a, measured);   // once a main step
 *   F += ed_compensator_force(&parameters, &state);       // what a Smith predictor adds to the measured force, else 0
 *
 * A step begins at t. x, v, a: target displacement, velocity and acceleration at its end, t + step. measured: displacement of the
 * specimen at t. u: the command that the actuator shall reach at t + step, in a ramp. SI units.
 *
 * Sources: Horiuchi et al. (1999); Wallace, Wagg & Neild (2005); Chen & Ricles (2009); Darby, Williams & Blakeborough (2002); Chae,
 * Kazemibidokhti & Ricles (2013); Malloy & Blakeborough in the thesis, 6.2.3. docs/theory/compensators.md has the equations. */
#ifndef ED_COMPENSATOR_H
#define ED_COMPENSATOR_H

#ifndef ED_CFFI
#include <math.h>
#include <string.h>
#endif

/* Sizes. A laboratory may define smaller ones before it includes this header. */
#ifndef ED_COMPENSATOR_MEMORY
#define ED_COMPENSATOR_MEMORY 1024 /* main steps that it looks back; a power of 2 */
#endif
#ifndef ED_COMPENSATOR_WINDOW
#define ED_COMPENSATOR_WINDOW 4096 /* main steps in the window of ATS */
#endif
#define ED_COMPENSATOR_TERMS 256   /* of a difference equation */
#define ED_COMPENSATOR_SECTIONS 4  /* of the filter, of second order each */
#define ED_COMPENSATOR_ORDER 4     /* of a polynomial */

enum {
  ED_COMPENSATE_LINEAR = 0,       /* a difference equation with constant coefficients */
  ED_COMPENSATE_LIVE_DELAY = 1,   /* a polynomial over the delay that zero crossings give */
  ED_COMPENSATE_ATS = 2,          /* adaptive time series, window with equal weights */
  ED_COMPENSATE_MODIFIED_ATS = 3  /* adaptive time series that forgets exponentially */
};

/* What a term of a difference equation multiplies. */
enum { ED_OF_TARGET = 0, ED_OF_VELOCITY = 1, ED_OF_ACCELERATION = 2, ED_OF_MEASURED = 3, ED_OF_COMMAND = 4, ED_OF_SIGNALS = 5 };

typedef struct {
  int of, lag;        /* signal, and main steps back: 0 is the present call; of commands at least 1 */
  double coefficient;
} ed_compensator_term;

typedef struct {
  int kind;
  double step;        /* main step, s */
  /* LINEAR: u = the sum of terms; force_terms give what is added to the measured force. */
  int n_terms, n_force_terms;
  ed_compensator_term term[ED_COMPENSATOR_TERMS];
  ed_compensator_term force_term[ED_COMPENSATOR_TERMS];
  /* LIVE_DELAY: polynomial of this order through targets a delay apart; of each error of the delay that share is taken; only crossings
   * between peaks above the threshold count. */
  int order;
  double delay, least_delay, largest_delay, share;
  /* LIVE_DELAY and both ATS: amplitude of the measured displacement, m, below which nothing is adapted. */
  double threshold;
  /* Both ATS: u = alpha_0 x + alpha_1 v + alpha_2 a. */
  double initial[3], least[3], largest[3];
  double rate[3];     /* largest change a second */
  int differences;    /* 1: v and a of the target are backward differences of x (Eq. 6.17), 0: as given */
  int n_sections;     /* Butterworth filter of command and measurement */
  double section[ED_COMPENSATOR_SECTIONS][5]; /* b0 b1 b2 a1 a2, a0 = 1 */
  double forgetting;  /* MODIFIED_ATS: weight of a sample after a step */
  int window, every;  /* ATS: main steps, and of these each how manieth is taken */
} ed_compensator_parameters;

typedef struct {
  long steps;
  double memory[ED_OF_SIGNALS][ED_COMPENSATOR_MEMORY]; /* rings */
  double force;       /* to add to the measured force */
  double delay;       /* LIVE_DELAY, s */
  double crossing[2][2]; /* of target and measured: times of the last ones downwards and upwards that were not compared; -1: none */
  double peak[2];        /* of both: magnitude since the last crossing */
  double alpha[3];
  double independence; /* of x, v, a in the data: smallest pivot of their correlation matrix, 1 to 0 */
  int adapting, limited; /* bits 0 to 2: alpha_0 to alpha_2 at a limit or rate */
  double command, last_target, last_velocity;
  double filter[2][ED_COMPENSATOR_SECTIONS][2];
  double filtered[2]; /* of the last step: measured displacement and velocity; LIVE_DELAY: target and measured displacement */
  double M[6], W[3];  /* 00 01 02 11 12 22 */
  double row[ED_COMPENSATOR_WINDOW][4]; /* ring of x, v, a, u */
} ed_compensator;

#ifndef ED_CFFI

static inline void ed_compensator_start(const ed_compensator_parameters *p, ed_compensator *s)
{
  memset(s, 0, sizeof *s);
  s->delay = p->delay;
  for (int i = 0; i < 3; i++)
    s->alpha[i] = p->initial[i];
  s->crossing[0][0] = s->crossing[0][1] = s->crossing[1][0] = s->crossing[1][1] = -1.0;
}

/* ---- difference equations --------------------------------------------------------------------------------------- */

static inline double ed_compensator_sum(const ed_compensator *s, int n, const ed_compensator_term *term)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += term[i].coefficient * s->memory[term[i].of][(s->steps - term[i].lag) & (ED_COMPENSATOR_MEMORY - 1)];
  return sum;
}

/* ---- live delay ------------------------------------------------------------------------------------------------- */

/* The target `back` seconds before the end of the present step; 0 before the test. */
static inline double ed_compensator_past(const ed_compensator_parameters *p, const ed_compensator *s, double back)
{
  const double *ring = s->memory[ED_OF_TARGET];
  const double steps = back / p->step;
  const long whole = (long)steps;
  const double part = steps - (double)whole;
  if (whole + 1 >= ED_COMPENSATOR_MEMORY)
    return 0.0;
  const double later = ring[(s->steps - whole) & (ED_COMPENSATOR_MEMORY - 1)];
  const double earlier = ring[(s->steps - whole - 1) & (ED_COMPENSATOR_MEMORY - 1)];
  return later + part * (earlier - later);
}

/* Time of a crossing of zero between two samples a step apart, the later one at t; < 0: none. *upwards: its direction. */
static inline double ed_compensator_crossing(double before, double now, double t, double step, int *upwards)
{
  if (!((before < 0.0 && now >= 0.0) || (before > 0.0 && now <= 0.0)))
    return -1.0;
  *upwards = now > before;
  return t - step * now / (now - before);
}

/* Takes a crossing of one signal, and compares it with the last one of the other in the same direction, once: the measured signal may be
 * late, or ahead of the target where the delay is taken for too long. */
static inline void ed_compensator_pair(const ed_compensator_parameters *p, ed_compensator *s, int measured, int upwards, double time,
                                       double peak)
{
  double *own = &s->crossing[measured][upwards], *other = &s->crossing[!measured][upwards];
  *own = peak > p->threshold ? time : -1.0;
  if (*own < 0.0 || *other < 0.0 || time - *other > p->largest_delay)
    return;
  s->delay = fmin(fmax(s->delay + p->share * (measured ? time - *other : *other - time), p->least_delay), p->largest_delay);
  *own = *other = -1.0;
}

/* signal: 0 target, 1 measured. */
static inline void ed_compensator_look_for_crossing(const ed_compensator_parameters *p, ed_compensator *s, int signal, double now,
                                                    double t)
{
  int upwards = 0;
  const double time = ed_compensator_crossing(s->filtered[signal], now, t, p->step, &upwards);
  if (time >= 0.0) {
    ed_compensator_pair(p, s, signal, upwards, time, s->peak[signal]);
    s->peak[signal] = 0.0;
  }
  s->peak[signal] = fmax(s->peak[signal], fabs(now));
  s->filtered[signal] = now;
}

static inline void ed_compensator_find_delay(const ed_compensator_parameters *p, ed_compensator *s, double x, double measured)
{
  const double t = (double)s->steps * p->step; /* of the measurement; the target is a step ahead */
  ed_compensator_look_for_crossing(p, s, 1, measured, t);
  ed_compensator_look_for_crossing(p, s, 0, x, t + p->step);
}

static inline double ed_compensator_extrapolate(const ed_compensator_parameters *p, const ed_compensator *s)
{
  /* nodes 0, -d, -2 d ... and the value at +d: binomial coefficients with alternating signs */
  double sum = 0.0, coefficient = 1.0;
  for (int j = 0; j <= p->order; j++) {
    coefficient *= (double)(p->order + 1 - j) / (double)(j + 1);
    sum += (j % 2 ? -coefficient : coefficient) * ed_compensator_past(p, s, j * s->delay);
  }
  return sum;
}

/* ---- adaptive time series --------------------------------------------------------------------------------------- */

static inline double ed_compensator_filter(const ed_compensator_parameters *p, double (*z)[2], double x)
{
  for (int i = 0; i < p->n_sections; i++) {
    const double *c = p->section[i], y = c[0] * x + z[i][0];
    z[i][0] = c[1] * x - c[3] * y + z[i][1];
    z[i][1] = c[2] * x - c[4] * y;
    x = y;
  }
  return x;
}

/* M alpha = W by Cholesky's factors of the correlation matrix, in which no unit counts; 0: what is measured does not determine the three
 * coefficients apart. */
static inline int ed_compensator_solve(ed_compensator *s, const double M[6], const double W[3], double alpha[3])
{
  const double ROUNDING = 1e-12;
  if (!(M[0] > 0.0 && M[3] > 0.0 && M[5] > 0.0))
    return 0;
  const double d0 = 1.0 / sqrt(M[0]), d1 = 1.0 / sqrt(M[3]), d2 = 1.0 / sqrt(M[5]);
  const double r01 = M[1] * d0 * d1, r02 = M[2] * d0 * d2, r12 = M[4] * d1 * d2;
  const double p1 = 1.0 - r01 * r01, l12 = r12 - r01 * r02;
  if (!(p1 > ROUNDING))
    return 0;
  const double p2 = 1.0 - r02 * r02 - l12 * l12 / p1;
  if (!(p2 > ROUNDING))
    return 0;
  s->independence = p1 < p2 ? p1 : p2;
  const double w0 = W[0] * d0, w1 = W[1] * d1 - r01 * w0, w2 = W[2] * d2 - r02 * w0 - l12 / p1 * w1;
  const double y2 = w2 / p2, y1 = (w1 - l12 * y2) / p1, y0 = w0 - r01 * y1 - r02 * y2;
  alpha[0] = y0 * d0;
  alpha[1] = y1 * d1;
  alpha[2] = y2 * d2;
  return 1;
}

static inline void ed_compensator_add(const double r[4], double M[6], double W[3])
{
  M[0] += r[0] * r[0], M[1] += r[0] * r[1], M[2] += r[0] * r[2];
  M[3] += r[1] * r[1], M[4] += r[1] * r[2], M[5] += r[2] * r[2];
  W[0] += r[0] * r[3], W[1] += r[1] * r[3], W[2] += r[2] * r[3];
}

static inline void ed_compensator_adapt(const ed_compensator_parameters *p, ed_compensator *s, double measured)
{
  const double x = ed_compensator_filter(p, s->filter[0], measured), u = ed_compensator_filter(p, s->filter[1], s->command);
  const double v = (x - s->filtered[0]) / p->step, a = (v - s->filtered[1]) / p->step, row[4] = {x, v, a, u};
  double found[3];
  s->filtered[0] = x;
  s->filtered[1] = v;
  s->adapting |= fabs(measured) > p->threshold;
  if (p->kind == ED_COMPENSATE_MODIFIED_ATS) {
    for (int i = 0; i < 6; i++)
      s->M[i] *= p->forgetting;
    for (int i = 0; i < 3; i++)
      s->W[i] *= p->forgetting;
    ed_compensator_add(row, s->M, s->W);
  } else {
    memcpy(s->row[s->steps % p->window], row, sizeof row);
    if (s->adapting) {
      memset(s->M, 0, sizeof s->M);
      memset(s->W, 0, sizeof s->W);
      for (int back = 0; back < p->window && back <= s->steps; back += p->every)
        ed_compensator_add(s->row[(s->steps - back) % p->window], s->M, s->W);
    }
  }
  s->limited = 0;
  if (!s->adapting || !ed_compensator_solve(s, s->M, s->W, found))
    return;
  for (int i = 0; i < 3; i++) {
    const double most = p->rate[i] * p->step, low = fmax(p->least[i], s->alpha[i] - most), high = fmin(p->largest[i], s->alpha[i] + most);
    s->limited |= (found[i] < low || found[i] > high) << i;
    s->alpha[i] = fmin(fmax(found[i], low), high);
  }
}

/* ---- a step ----------------------------------------------------------------------------------------------------- */

static inline double ed_compensator_step(const ed_compensator_parameters *p, ed_compensator *s, double x, double v, double a,
                                         double measured)
{
  const int at = (int)(s->steps & (ED_COMPENSATOR_MEMORY - 1));
  s->memory[ED_OF_TARGET][at] = x;
  if (p->kind == ED_COMPENSATE_LINEAR) {
    s->memory[ED_OF_VELOCITY][at] = v;
    s->memory[ED_OF_ACCELERATION][at] = a;
    s->memory[ED_OF_MEASURED][at] = measured;
    s->command = ed_compensator_sum(s, p->n_terms, p->term);
    s->memory[ED_OF_COMMAND][at] = s->command;
    s->force = ed_compensator_sum(s, p->n_force_terms, p->force_term);
  } else if (p->kind == ED_COMPENSATE_LIVE_DELAY) {
    ed_compensator_find_delay(p, s, x, measured);
    s->command = ed_compensator_extrapolate(p, s);
  } else {
    ed_compensator_adapt(p, s, measured);
    if (p->differences) {
      v = (x - s->last_target) / p->step;
      a = (v - s->last_velocity) / p->step;
      s->last_target = x;
      s->last_velocity = v;
    }
    s->command = s->alpha[0] * x + s->alpha[1] * v + s->alpha[2] * a;
  }
  s->steps++;
  return s->command;
}

/* What is to be added to the force that is measured at the end of the step. */
static inline double ed_compensator_force(const ed_compensator_parameters *p, const ed_compensator *s)
{
  return p->kind == ED_COMPENSATE_LINEAR ? s->force : 0.0;
}

#endif
#endif
