/* Bouc-Wen (thesis Eqs. 2.67, 2.68; Wen 1976): F = alpha Fy/Y u + (1 - alpha) Fy z. */
#include "damper/bouc_wen.h"

#include "damper/laws.h"
#include "edcore.h"

enum { ED_LAW_BOUC_WEN_PARAMETERS };

int ed_bouc_wen_check(const ed_bouc_wen_shape *shape, char message[ED_DAMPER_MESSAGE])
{
  if (shape->beta + shape->gamma >= 0.0)
    return ED_OK;
  return ed_refuse_parameter(message, "beta", shape->beta, "at least -gamma: below it z grows without bound");
}

static ed_bouc_wen_shape shape_of(const ed_damper *damper)
{
  const double *p = damper->parameter;
  return (ed_bouc_wen_shape){p[Y], p[A], p[BETA], p[GAMMA], p[N]};
}

static int prepare(ed_damper *damper, char message[ED_DAMPER_MESSAGE])
{
  const ed_bouc_wen_shape shape = shape_of(damper);
  damper->n_ode = 1;
  damper->diagonal_ode = 1;
  return ed_bouc_wen_check(&shape, message);
}

static int step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                ed_damper_force *out)
{
  const double *p = damper->parameter, k = p[ALPHA] * p[FY] / p[Y], f = (1.0 - p[ALPHA]) * p[FY];
  const ed_bouc_wen_shape shape = shape_of(damper);
  double slope[2];
  trial[0] = committed[0];
  const int status = ed_bouc_wen_follow(&shape, path, direction, trial, slope);
  out->force = k * ed_path_u(path, path->h) + f * trial[0];
  for (int j = 0; j < 2; j++)
    out->slope[j] = k * ed_path_u(&direction[j], path->h) + f * slope[j];
  return status;
}

/* In two directions, each with its z. */
static int step_pair(const ed_damper *damper, const double *const committed[2], const ed_path path[2], const ed_path direction[2],
                     double *const trial[2], ed_pair_force *out)
{
  const double *p = damper->parameter, k = p[ALPHA] * p[FY] / p[Y], f = (1.0 - p[ALPHA]) * p[FY];
  const ed_bouc_wen_shape shape = shape_of(damper);
  double z[2] = {committed[0][0], committed[1][0]};
  const int status = ed_bouc_wen_follow_pair(&shape, path, direction, z, out->slope);
  for (int c = 0; c < 2; c++) {
    trial[c][0] = z[c];
    out->force[c] = k * ed_path_u(&path[c], path[c].h) + f * z[c];
    for (int i = 0; i < 4; i++)
      out->slope[c][i / 2][i % 2] = f * out->slope[c][i / 2][i % 2] + (c == i / 2 ? k * ed_path_u(&direction[i % 2], path[c].h) : 0.0);
  }
  return status;
}

/* As differential equation. With a brace k_b in series the own deformation u_d follows from k_b (u - u_d) = F(u_d, z), and its velocity is
 * w = k_b v / (k_b + dF/du_d), so that z stays the only variable. */
static void rate(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out)
{
  (void)memory;
  const double *p = damper->parameter, brace = damper->brace;
  const double k = p[ALPHA] * p[FY] / p[Y], f = (1.0 - p[ALPHA]) * p[FY];
  const ed_bouc_wen_shape shape = shape_of(damper);
  double slope, slope_z;
  ed_bouc_wen_slope(&shape, y[0], ed_way(v), &slope, &slope_z);
  double part = 1.0, share = 1.0, share_z = 0.0; /* of the whole: part of the linear spring, share of the velocity */
  if (brace > 0.0) {
    part = brace / (brace + k);
    share = brace / (brace + k + f * slope);
    share_z = -share * share * f * slope_z / brace;
  }
  out->force = part * (k * u + f * y[0]);
  out->force_u = part * k;
  out->force_v = 0.0;
  out->force_y[0] = part * f;
  out->y[0] = slope * share * v;
  out->y_u[0] = 0.0;
  out->y_v[0] = slope * share;
  out->y_y[0] = (slope_z * share + slope * share_z) * v;
}

const ed_law ed_bouc_wen = {.name = "bouc_wen",
                            .rate_independent = 1,
                            .takes_brace = 1,
                            .prepare = prepare,
                            .step = step,
                            .step_pair = step_pair,
                            .rate = rate};
