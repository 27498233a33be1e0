/* Amendments that act beside the law. */
#include "damper/amendment.h"
#include "damper/relaxation.h"

#include <math.h>

/* Powers of the velocity below 1 are chords below this speed, as of the law viscous_power. */
static const double AT_REST = 1e-9;

static void payne_elastic(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  double by_u1;
  const double g = ed_payne_share(p[1], p[2], p[3], before, ends, after, &by_u1);
  out->value = -p[0] * g * ends->u1;
  out->by_u1 = -p[0] * (g + by_u1 * ends->u1);
}

const ed_amendment_kind ed_amend_payne_elastic = {
    .name = "payne.elastic", .has_state = 1, .on_speed = 1, .n_parameters = 4,
    .parameter = {{"k", ED_ANY}, {"a0", ED_POSITIVE}, {"m", ED_POSITIVE}, {"tau_a", ED_POSITIVE}}, .at_end = payne_elastic};

static void mullins_elastic(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  double by_u1;
  const double share = ed_path_share(p[1], before, ends, after, &by_u1);
  out->value = p[0] * share * ends->u1;
  out->by_u1 = p[0] * (share + by_u1 * ends->u1);
}

const ed_amendment_kind ed_amend_mullins_elastic = {
    .name = "mullins.elastic", .has_state = 1, .n_parameters = 2, .parameter = {{"k", ED_ANY}, {"s0", ED_POSITIVE}},
    .at_end = mullins_elastic};

static void hardening_power(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double secant = p[0] * pow(fabs(ends->u1) / p[2], p[1] - 1.0);
  out->value = secant * ends->u1;
  out->by_u1 = p[1] * secant;
}

const ed_amendment_kind ed_amend_hardening_power = {
    .name = "hardening.power", .n_parameters = 3,
    .parameter = {{"k", ED_ANY}, {"p", ED_AT_LEAST_ONE}, {"r", ED_POSITIVE}}, .at_end = hardening_power};

static void hardening_threshold(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double beyond = fabs(ends->u1) - p[1];
  out->value = p[0] * fmax(beyond, 0.0) * ed_sign(ends->u1);
  out->by_u1 = beyond > 0.0 ? p[0] : 0.0;
}

const ed_amendment_kind ed_amend_hardening_threshold = {
    .name = "hardening.threshold", .n_parameters = 2, .parameter = {{"k", ED_ANY}, {"u0", ED_NOT_NEGATIVE}},
    .at_end = hardening_threshold};

static void one_sided_spring(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double beyond = p[2] * ends->u1 - p[1];
  out->value = p[0] * fmax(beyond, 0.0) * p[2];
  out->by_u1 = beyond > 0.0 ? p[0] : 0.0;
}

const ed_amendment_kind ed_amend_one_sided_spring = {
    .name = "one_sided.spring", .n_parameters = 3,
    .parameter = {{"k", ED_ANY}, {"u0", ED_NOT_NEGATIVE}, {"side", ED_SIDE}}, .at_end = one_sided_spring};

static void one_sided_contact(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double beyond = p[3] * ends->u1 - p[1];
  const double secant = beyond > 0.0 ? p[0] * pow(beyond / p[4], p[2] - 1.0) : 0.0;
  out->value = secant * fmax(beyond, 0.0) * p[3];
  out->by_u1 = p[2] * secant;
}

const ed_amendment_kind ed_amend_one_sided_contact = {
    .name = "one_sided.contact", .n_parameters = 5,
    .parameter = {{"k", ED_ANY}, {"u0", ED_NOT_NEGATIVE}, {"n", ED_AT_LEAST_ONE}, {"side", ED_SIDE}, {"r", ED_POSITIVE}},
    .at_end = one_sided_contact};

static void one_sided_even(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double size = fabs(ends->u1), secant = p[0] * pow(size / p[2], p[1] - 1.0);
  out->value = secant * size;
  out->by_u1 = p[1] * secant * ed_sign(ends->u1);
}

const ed_amendment_kind ed_amend_one_sided_even = {
    .name = "one_sided.even", .n_parameters = 3,
    .parameter = {{"k", ED_ANY}, {"n", ED_AT_LEAST_ONE}, {"r", ED_POSITIVE}}, .at_end = one_sided_even};

/* Q' + Q/tau = k v, v linear between the ends of the step. */
static void relaxation_branch(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  const double rate = 1.0 / p[1], velocity[3] = {ends->v0, ends->v1 - ends->v0, 0.0};
  double gain[3], *const gains[3] = {&gain[0], &gain[1], &gain[2]};
  ed_relax(1, ends->h, velocity, &rate, &p[0], &before, after, gains);
  out->value = *after;
  out->by_v0 = gain[0] - gain[1];
  out->by_v1 = gain[1];
}

const ed_amendment_kind ed_amend_relaxation_branch_maxwell = {
    .name = "relaxation_branch.maxwell", .has_state = 1, .on_speed = 1, .n_parameters = 2,
    .parameter = {{"k", ED_ANY}, {"tau", ED_POSITIVE}}, .at_end = relaxation_branch};

static void dashpot(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double alpha = p[1], speed = fabs(ends->v1);
  const int rests = speed < AT_REST && alpha <= 1.0;
  const double secant = p[0] * pow(rests ? AT_REST : speed, alpha - 1.0);
  out->value = secant * ends->v1;
  out->by_v1 = rests ? secant : alpha * secant;
  out->chord = fmax(secant - out->by_v1, 0.0);
}

const ed_amendment_kind ed_amend_velocity_exponent_dashpot = {
    .name = "velocity_exponent.dashpot", .on_speed = 1, .n_parameters = 2,
    .parameter = {{"c", ED_ANY}, {"alpha", ED_POSITIVE}}, .at_end = dashpot};

/* Activated flow [Eyring 1936]. */
static void flow(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  (void)before, (void)after;
  const double v = ends->v1;
  out->value = p[0] * asinh(v / p[1]);
  out->by_v1 = p[0] / hypot(v, p[1]);
  out->chord = v != 0.0 ? fmax(out->value / v - out->by_v1, 0.0) : 0.0;
}

const ed_amendment_kind ed_amend_velocity_exponent_flow = {
    .name = "velocity_exponent.flow", .on_speed = 1, .n_parameters = 2, .parameter = {{"f", ED_ANY}, {"v0", ED_POSITIVE}}, .at_end = flow};
