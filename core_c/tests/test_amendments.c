/* Amendments of laws: forces against the formulas evaluated here from the samples, true tangents, work, and braces in series. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

typedef struct {
  int kind, n;
  double parameter[4];
} amendment;

static const amendment EACH[] = {
    {ED_AMEND_CONSTANT, 1, {0.8}},
    {ED_AMEND_PAYNE_WHOLE, 4, {0.3, 0.4, 1.3, 2.0}},
    {ED_AMEND_PAYNE_ELASTIC, 4, {1.5, 0.4, 0.8, 0.7}},
    {ED_AMEND_MULLINS_PATH, 2, {0.4, 6.0}},
    {ED_AMEND_MULLINS_MAXIMUM, 2, {0.35, 0.8}},
    {ED_AMEND_MULLINS_ELASTIC, 2, {2.0, 5.0}},
    {ED_AMEND_DEGRADATION_ENERGY, 2, {0.25, 3.0}},
    {ED_AMEND_SELF_HEATING_RATE, 2, {0.03, 4.0}},
    {ED_AMEND_HARDENING_POWER, 3, {0.7, 3.0, 1.1}},
    {ED_AMEND_HARDENING_THRESHOLD, 2, {3.0, 0.6}},
    {ED_AMEND_ONE_SIDED_FACTOR, 2, {0.2, -1.0}},
    {ED_AMEND_ONE_SIDED_SPRING, 3, {2.5, 0.5, -1.0}},
    {ED_AMEND_RELAXATION_BRANCH_MAXWELL, 2, {3.0, 0.25}},
    {ED_AMEND_VELOCITY_POWER_DASHPOT, 2, {0.6, 0.4}},
};
enum { KINDS = sizeof EACH / sizeof *EACH };

static const double ZENER[] = {2.0, 5.0, 0.4};

static void amend(rig *r, const amendment *one)
{
  char message[256] = "";
  CHECK_STATUS(ed_damper_amend(r->damper, one->kind, one->n, one->parameter, message, sizeof message), ED_OK);
  CHECK(ed_damper_state_size(r->damper) <= LARGEST_DAMPER_STATE);
  ed_damper_start(r->damper, r->state);
}

/* Drivers and forces by the definitions, with memories of their own. */
typedef struct {
  double u, v, envelope[KINDS], largest, path, work, heat, branch, force;
} memory;

static double payne(const double *p, double *envelope, double h, double u)
{
  *envelope = fmax(fabs(u), *envelope * exp(-h / p[3]));
  const double power = pow(*envelope / p[1], p[2]);
  return power / (1.0 + power);
}

/* The amended force at (u, v) after h, given the law's; `used`: which of EACH act. */
static double expected(memory *m, const int *used, double h, double u, double v, double law)
{
  double phi = 1.0, beside = 0.0;
  m->path += fabs(u - m->u);
  m->largest = fmax(m->largest, fabs(u));
  for (int i = 0; i < KINDS; i++) {
    const double *p = EACH[i].parameter;
    if (!used[i])
      continue;
    switch (EACH[i].kind) {
    case ED_AMEND_CONSTANT: phi *= p[0]; break;
    case ED_AMEND_PAYNE_WHOLE: phi *= 1.0 - p[0] * payne(p, &m->envelope[i], h, u); break;
    case ED_AMEND_PAYNE_ELASTIC: beside -= p[0] * payne(p, &m->envelope[i], h, u) * u; break;
    case ED_AMEND_MULLINS_PATH: phi *= 1.0 + p[0] * exp(-m->path / p[1]); break;
    case ED_AMEND_MULLINS_MAXIMUM: phi *= 1.0 - p[0] * erf((m->largest - fabs(u)) / p[1]); break;
    case ED_AMEND_MULLINS_ELASTIC: beside += p[0] * exp(-m->path / p[1]) * u; break;
    case ED_AMEND_DEGRADATION_ENERGY: phi *= 1.0 - p[0] * (1.0 - exp(-fmax(m->work, 0.0) / p[1])); break;
    case ED_AMEND_SELF_HEATING_RATE: phi *= exp(-m->heat); break;
    case ED_AMEND_HARDENING_POWER: beside += p[0] * u * pow(fabs(u) / p[2], p[1] - 1.0); break;
    case ED_AMEND_HARDENING_THRESHOLD: beside += fabs(u) > p[1] ? p[0] * (u - copysign(p[1], u)) : 0.0; break;
    case ED_AMEND_ONE_SIDED_FACTOR: phi *= p[1] * u > 0.0 ? 1.0 + p[0] : 1.0; break;
    case ED_AMEND_ONE_SIDED_SPRING: beside += p[2] * u > p[1] ? p[0] * (p[2] * u - p[1]) * p[2] : 0.0; break;
    case ED_AMEND_RELAXATION_BRANCH_MAXWELL: {
      const double tau = p[1], e = exp(-h / tau), slope = (v - m->v) / h; /* particular solution k tau (v - slope tau) */
      m->branch = e * (m->branch - p[0] * tau * (m->v - slope * tau)) + p[0] * tau * (v - slope * tau);
      beside += m->branch;
      break;
    }
    case ED_AMEND_VELOCITY_POWER_DASHPOT: beside += copysign(p[0] * pow(fabs(v), p[1]), v); break;
    }
  }
  const double work = 0.5 * (m->force + phi * law) * (u - m->u);
  m->work += work;
  m->heat = m->heat * exp(-h / 4.0) + 0.03 * work; /* of EACH */
  m->force = phi * law;
  m->u = u;
  m->v = v;
  return phi * law + beside;
}

static double u_at(double t)
{
  return sin(2.1 * t) * (0.5 + 0.1 * t);
}

static double v_at(double t)
{
  return 2.1 * cos(2.1 * t) * (0.5 + 0.1 * t) + 0.1 * sin(2.1 * t);
}

/* One amendment after the other (only < KINDS), or all together, on a law with an exact step or one of SUNDIALS. `move` makes every step
 * twice: nothing of a trial is left behind. */
static void check_forces(int law, int n, const double *parameters, int only)
{
  rig amended = new_rig(law, n, parameters, 0.0), bare = new_rig(law, n, parameters, 0.0);
  int used[KINDS];
  for (int i = 0; i < KINDS; i++) {
    used[i] = only == KINDS || only == i;
    if (used[i])
      amend(&amended, &EACH[i]);
  }
  memory m = {0};
  double changed = 0.0;
  for (int step = 1; step <= 150; step++) {
    const double h = step % 3 ? 0.05 : 0.02, t = 0.04 * step, u = u_at(t), v = v_at(t);
    const double plain = move(&bare, h, u, v), force = expected(&m, used, h, u, v, plain);
    CHECK_NEAR(move(&amended, h, u, v), force, 1e-13 * (1.0 + fabs(force)) * 10.0); /* rounding of some ten operations */
    changed = fmax(changed, fabs(force - plain));
  }
  CHECK(changed > 0.02);
  free_rig(&amended);
  free_rig(&bare);
}

/* Derivatives of every amendment against central differences; not near corners of the definitions, nor where the power of the velocity
 * bends within the difference. */
static void check_tangents(double brace)
{
  for (int i = 0; i < KINDS; i++) {
    rig r = new_rig(ED_LAW_ZENER, 3, ZENER, brace);
    amend(&r, &EACH[i]);
    for (int step = 1; step < 80; step++) {
      const double h = 0.04, t = h * step + 0.003, u = u_at(t), v = v_at(t);
      const int corner = (brace > 0.0 && EACH[i].kind == ED_AMEND_ONE_SIDED_FACTOR && fabs(u) < 0.1) || fabs(v) < 0.1;
      if (!corner)
        check_slopes(&r, h, u, v, 1e-5, 1e-4, brace > 0.0 ? 1e-4 : 5e-6);
      move(&r, h, u, v);
    }
    free_rig(&r);
  }
}

/* The work of a hardening spring to a deformation x and part of the way back: k x^(p + 1) / ((p + 1) r^(p - 1)). */
static void check_work(void)
{
  const double none[] = {1e-12, 0.0}, *p = EACH[8].parameter, end = 0.9;
  rig r = new_rig(ED_LAW_KELVIN_VOIGT, 2, none, 0.0);
  amend(&r, &EACH[8]);
  double work = 0.0, before = 0.0;
  const int n = 2000, out = 1500;
  for (int i = 1; i <= n; i++) {
    const double u = end * (i <= out ? (double)i / out : 1.0 - 0.5 * (i - out) / (n - out)), from = r.u;
    const double force = move_to(&r, u);
    work += 0.5 * (before + force) * (u - from);
    before = force;
  }
  const double x = 0.5 * end;
  CHECK_NEAR(work, p[0] * pow(x, p[1] + 1.0) / ((p[1] + 1.0) * pow(p[2], p[1] - 1.0)), 1e-6); /* (end / n)^2 of the trapezoids */
  free_rig(&r);
}

/* Of kb (u - x) = k x + c x^3 the real root (Cardano). */
static double own_deformation(double u, double k, double c, double kb)
{
  const double p = (k + kb) / c, q = -kb * u / c, root = sqrt(0.25 * q * q + p * p * p / 27.0);
  return cbrt(-0.5 * q + root) + cbrt(-0.5 * q - root);
}

/* A spring with a hardening one beside it, both in series with a brace; by the path for laws that depend on speed and by the other. */
static void check_brace_with_hardening(void)
{
  const double k = 3.0, kb = 4.0, *p = EACH[8].parameter, cubic = p[0] / (p[2] * p[2]);
  const double kelvin[] = {k, 0.0}, plastic[] = {k, 1e6, 0.0};
  rig both[] = {new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb), new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb)};
  for (int i = 0; i < 2; i++) {
    amend(&both[i], &EACH[8]);
    for (int step = 1; step < 100; step++) {
      const double t = 0.05 * step, u = 3.0 * u_at(t), v = 3.0 * v_at(t);
      const double x = own_deformation(u, k, cubic, kb);
      CHECK_NEAR(move(&both[i], 0.05, u, v), kb * (u - x), 1e-8 * kb * (1.0 + fabs(u))); /* of the balance: 1e-9 */
    }
    free_rig(&both[i]);
  }
}

/* A spring that is stiffer to one side, in series with a brace: two springs; the jump rises over 1e-5. */
static void check_one_sided_brace(void)
{
  const double k = 3.0, kb = 4.0, kelvin[] = {k, 0.0}, plastic[] = {k, 1e6, 0.0}, b = EACH[10].parameter[0], side = EACH[10].parameter[1];
  rig both[] = {new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb), new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb)};
  for (int i = 0; i < 2; i++) {
    amend(&both[i], &EACH[10]);
    for (int step = 1; step < 100; step++) {
      const double t = 0.05 * step, u = u_at(t), own = side * u > 0.0 ? k * (1.0 + b) : k;
      CHECK_NEAR(move(&both[i], 0.05, u, v_at(t)), u * own * kb / (own + kb), 1e-5 * b * k);
    }
    free_rig(&both[i]);
  }
}

/* A spring with a Maxwell branch is a Zener damper: exactly where the velocity is linear, as it is of a damper with a brace. */
static void check_branch_is_zener(double brace)
{
  const double kelvin[] = {ZENER[0], 0.0};
  const amendment branch = {ED_AMEND_RELAXATION_BRANCH_MAXWELL, 2, {ZENER[1], ZENER[2] / ZENER[1]}};
  rig one = new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, brace), other = new_rig(ED_LAW_ZENER, 3, ZENER, brace);
  amend(&one, &branch);
  for (int step = 1; step < 100; step++) {
    const double h = 0.03, v = cos(0.2 * step), u = one.u + 0.5 * h * (one.v + v);
    CHECK_NEAR(move(&one, h, u, v), move(&other, h, u, v), brace > 0.0 ? 1e-8 : 1e-13);
  }
  free_rig(&one);
  free_rig(&other);
}

/* A yielding damper whose force falls while it is deformed further, in series with a brace: at the own deformation u - F / kb the same
 * damper without brace carries F. */
static void check_softening_brace(double kb)
{
  const double plastic[] = {10.0, 2.0, 0.0};
  const amendment soft[] = {{ED_AMEND_MULLINS_PATH, 2, {1.0, 0.5}}, {ED_AMEND_DEGRADATION_ENERGY, 2, {0.5, 1.0}}};
  rig braced = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb), own = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, 0.0);
  for (int i = 0; i < 2; i++) {
    amend(&braced, &soft[i]);
    amend(&own, &soft[i]);
  }
  double largest = 0.0, last = 0.0;
  for (int step = 1; step < 200; step++) {
    const double u = sin(0.05 * step), force = move_to(&braced, u);
    CHECK_NEAR(move_to(&own, u - force / kb), force, 1e-7 * kb);
    largest = fmax(largest, fabs(force));
    last = force;
  }
  CHECK(largest > 2.5 && fabs(last) < 1.5); /* of 2.0: it was stronger when new, and is weaker now */
  free_rig(&braced);
  free_rig(&own);
}

static void refused(rig *r, const amendment *one, int status, const char *text)
{
  char message[256] = "";
  const int size = ed_damper_state_size(r->damper);
  CHECK_STATUS(ed_damper_amend(r->damper, one->kind, one->n, one->parameter, message, sizeof message), status);
  CHECK_CONTAINS(message, text);
  CHECK(ed_damper_state_size(r->damper) == size);
}

static void check_refusals(void)
{
  const double bouc_wen[] = {1.0, 0.01, 0.1, 1.0, 0.5, 0.5, 2.0};
  rig plain = new_rig(ED_LAW_ZENER, 3, ZENER, 0.0), braced = new_rig(ED_LAW_BOUC_WEN, 7, bouc_wen, 5.0);
  refused(&plain, &(amendment){99, 1, {1.0}}, ED_E_ID, "there is no amendment 99");
  refused(&plain, &(amendment){ED_AMEND_CONSTANT, 2, {1.0, 1.0}}, ED_E_ARGUMENT, "amendment constant: 2 parameters, but 1 are needed");
  refused(&plain, &(amendment){ED_AMEND_CONSTANT, 1, {NAN}}, ED_E_ARGUMENT, "a finite number");
  refused(&plain, &(amendment){ED_AMEND_PAYNE_WHOLE, 4, {0.1, 0.0, 1.0, 1.0}}, ED_E_ARGUMENT, "payne.whole: a0 = 0");
  refused(&plain, &(amendment){ED_AMEND_ONE_SIDED_FACTOR, 2, {0.1, 0.5}}, ED_E_ARGUMENT, "1 or -1");
  refused(&plain, &(amendment){ED_AMEND_HARDENING_POWER, 3, {1.0, 0.5, 1.0}}, ED_E_ARGUMENT, "at least 1");
  refused(&braced, &EACH[0], ED_E_ARGUMENT, "the brace must be rigid");
  free_rig(&plain);
  free_rig(&braced);
}

int main(void)
{
  const double bouc_wen[] = {1.5, 0.1, 0.1, 1.0, 0.5, 0.5, 2.0};
  for (int only = 0; only <= KINDS; only++)
    check_forces(ED_LAW_ZENER, 3, ZENER, only);
  check_forces(ED_LAW_BOUC_WEN, 7, bouc_wen, KINDS);
  check_tangents(0.0);
  check_tangents(20.0);
  check_work();
  check_brace_with_hardening();
  check_one_sided_brace();
  check_branch_is_zener(0.0);
  check_branch_is_zener(15.0);
  check_softening_brace(15.0);
  check_softening_brace(200.0);
  check_refusals();
  return checks_end("amendments");
}
