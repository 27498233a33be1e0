#include "damper/ode_block.h"

#include "base/dense.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 80 };

int ed_ode_turns_itself(const ed_damper *damper)
{
  return damper->brace > 0.0 && damper->law->takes_brace && damper->n_memory > 0;
}

/* Moves the samples to the interval that holds t. */
static void seek(ed_ode_samples *samples, double t)
{
  int at = samples->at;
  while (at > 0 && t < samples->time[at])
    at--;
  while (at < samples->n - 2 && t > samples->time[at + 1])
    at++;
  if (at == samples->at)
    return;
  samples->at = at;
  ed_path_hermite(&samples->path, samples->time[at + 1] - samples->time[at], samples->u[at], samples->v[at], samples->u[at + 1],
                  samples->v[at + 1]);
}

void ed_ode_motion(const ed_ode_block *block, double t, double *u, double *v)
{
  const ed_path *path = block->path;
  if (!path) {
    seek(block->samples, t);
    path = &block->samples->path;
    t -= block->samples->time[block->samples->at];
  }
  *u = ed_path_u(path, t);
  *v = ed_path_v(path, t);
  if (*v * block->way < 0.0 || *v == 0.0)
    *v = block->way * DBL_MIN;
}

int ed_ode_rate(const ed_ode_block *block, double t, const double *y, ed_damper_rate *rate)
{
  double u, v, sum;
  ed_ode_motion(block, t, &u, &v);
  block->damper->law->rate(block->damper, u, v, y, block->memory, rate);
  sum = rate->force;
  for (int i = 0; i < block->damper->n_ode; i++)
    sum += rate->y[i];
  return isfinite(sum);
}

int ed_ode_own_velocity(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, double *velocity)
{
  double u, v;
  ed_ode_motion(block, t, &u, &v);
  if (!ed_ode_rate(block, t, y, &work->rate))
    return 0;
  *velocity = v - work->rate.y[0];
  return 1;
}

/* Derivatives of rate and force to the memory, along its derivative to unknown k; in work->other.y and its force. */
static void memory_term(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, int k)
{
  const ed_damper *damper = block->damper;
  const double d = block->difference[k];
  double u, v, force, forward[ED_MAX_ODE];
  ed_ode_motion(block, t, &u, &v);
  for (int i = 0; i < damper->n_memory; i++) {
    work->memory[0][i] = block->memory[i] + d * block->memory_slope[k][i];
    work->memory[1][i] = block->memory[i] - d * block->memory_slope[k][i];
  }
  damper->law->rate(damper, u, v, y, work->memory[0], &work->other);
  force = work->other.force;
  memcpy(forward, work->other.y, (size_t)damper->n_ode * sizeof *forward);
  damper->law->rate(damper, u, v, y, work->memory[1], &work->other);
  work->other.force = (force - work->other.force) / (2.0 * d);
  for (int i = 0; i < damper->n_ode; i++)
    work->other.y[i] = (forward[i] - work->other.y[i]) / (2.0 * d);
}

/* What the motion and the memory add to the derivative of sensitivity k. */
static void forcing(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, int k, double *result)
{
  const ed_damper_rate *rate = &work->rate;
  const double h_u = ed_path_u(&block->direction[k], t), h_v = ed_path_v(&block->direction[k], t);
  const int n = block->damper->n_ode;
  for (int i = 0; i < n; i++)
    result[i] = rate->y_u[i] * h_u + rate->y_v[i] * h_v;
  if (block->moved) {
    memory_term(block, work, t, y, k);
    for (int i = 0; i < n; i++)
      result[i] += work->other.y[i];
  }
}

int ed_ode_derivatives(const ed_ode_block *block, ed_ode_work *work, double t, double scale, const double *y, int stride,
                       double *derivative)
{
  const int n = block->damper->n_ode;
  const ed_damper_rate *rate = &work->rate;
  if (!ed_ode_rate(block, t, y, &work->rate))
    return 0;
  for (int i = 0; i < n; i++)
    derivative[i] = scale * rate->y[i];
  for (int k = 0; block->direction && k < ED_ODE_DIRECTIONS; k++) {
    const double *s = y + (k + 1) * stride;
    double *ds = derivative + (k + 1) * stride;
    forcing(block, work, t, y, k, ds);
    for (int i = 0; i < n; i++) {
      double sum = ds[i];
      if (block->damper->diagonal_ode)
        sum += rate->y_y[i] * s[i];
      else
        for (int j = 0; j < n; j++)
          sum += rate->y_y[i * n + j] * s[j];
      ds[i] = scale * sum;
    }
  }
  return 1;
}

/* The matrix 1 - gamma df/dy of the rates in work, factored; diagonal as its inverse. 0: singular. */
static int factor(const ed_ode_block *block, ed_ode_work *work, double gamma)
{
  const int n = block->damper->n_ode, diagonal = n == 1 || block->damper->diagonal_ode;
  const double *jacobian = work->rate.y_y;
  if (diagonal) {
    for (int i = 0; i < n; i++) {
      const double d = 1.0 - gamma * jacobian[i];
      if (!(fabs(d) > 0.0) || !isfinite(d))
        return 0;
      work->matrix[i] = 1.0 / d;
    }
    return 1;
  }
  for (int i = 0; i < n * n; i++)
    work->matrix[i] = -gamma * jacobian[i];
  for (int i = 0; i < n; i++)
    work->matrix[i * n + i] += 1.0;
  return ed_dense_factor(n, work->matrix, work->pivot);
}

static void solve(const ed_ode_block *block, const ed_ode_work *work, double *x)
{
  const int n = block->damper->n_ode;
  if (n == 1 || block->damper->diagonal_ode)
    for (int i = 0; i < n; i++)
      x[i] *= work->matrix[i];
  else
    ed_dense_solve(n, work->matrix, work->pivot, x);
}

/* Newton's method for one variable. Where the residual grows with z, as it does for all that decays, a root is kept between the
 * ends that were found to lie on its two sides; when it does not come closer quickly, halfway between them. */
static int solve_one(const ed_ode_block *block, ed_ode_work *work, double t, double gamma, double a, double weight, double *z)
{
  double low = -INFINITY, high = INFINITY, previous = INFINITY;
  for (int i = 0; i < NEWTON_STEPS; i++) {
    if (!ed_ode_rate(block, t, z, &work->rate) || !factor(block, work, gamma) || work->matrix[0] < 0.0)
      return 0;
    const double residual = *z - a - gamma * work->rate.y[0];
    if (residual > 0.0)
      high = *z;
    else
      low = *z;
    double next = *z - residual * work->matrix[0];
    const double step = fabs(next - *z);
    if (!(step * weight > 1.0)) {
      *z = next;
      return isfinite(step);
    }
    if (!(next > low && next < high && step <= 0.5 * previous) && isfinite(high - low))
      next = 0.5 * (low + high);
    previous = fabs(next - *z);
    *z = next;
  }
  return 0;
}

static int solve_several(const ed_ode_block *block, ed_ode_work *work, double t, double gamma, const double *a,
                         const double *weight, double *z)
{
  const int n = block->damper->n_ode;
  for (int iteration = 0; iteration < NEWTON_STEPS; iteration++) {
    if (!ed_ode_rate(block, t, z, &work->rate) || !factor(block, work, gamma))
      return 0;
    double largest = 0.0;
    for (int i = 0; i < n; i++)
      work->step[i] = a[i] + gamma * work->rate.y[i] - z[i];
    solve(block, work, work->step);
    for (int i = 0; i < n; i++) {
      z[i] += work->step[i];
      largest = fmax(largest, fabs(work->step[i]) * weight[i]);
      if (!isfinite(z[i]))
        return 0;
    }
    if (largest <= 1.0)
      return 1;
  }
  return 0;
}

int ed_ode_stage(const ed_ode_block *block, ed_ode_work *work, double t, double gamma, const double *a, const double *weight,
                 int stride, double *z)
{
  const int n = block->damper->n_ode;
  if (!(n == 1 ? solve_one(block, work, t, gamma, a[0], weight[0], z) : solve_several(block, work, t, gamma, a, weight, z)))
    return 0;
  for (int k = 0; block->direction && k < ED_ODE_DIRECTIONS; k++) {
    double *s = z + (k + 1) * stride;
    forcing(block, work, t, z, k, s);
    for (int i = 0; i < n; i++)
      s[i] = a[(k + 1) * stride + i] + gamma * s[i];
    solve(block, work, s);
  }
  return 1;
}

int ed_ode_estimate(ed_ode_block *block, ed_ode_work *work, double t0, double t1, const double *y, int stride,
                    double *change, double *rate)
{
  const int n = block->damper->n_ode, diagonal = block->damper->diagonal_ode;
  const double h = t1 - t0, middle = t0 + 0.5 * h;
  double *moved = work->before, u, v;
  block->way = 0.0;
  ed_ode_motion(block, middle, &u, &v);
  block->way = (v > 0.0) - (v < 0.0);
  *rate = 0.0;
  memcpy(moved, y, (size_t)n * sizeof *moved);
  /* two steps of Newton's method to where an implicit Euler step with the motion in the middle leads */
  for (int pass = 0; pass < 2; pass++) {
    if (!ed_ode_rate(block, middle, moved, &work->rate) || !factor(block, work, h))
      return pass; /* the first step may leave the range of the law */
    for (int k = 0; pass == 0 && block->direction && k < ED_ODE_DIRECTIONS; k++)
      for (int i = 0; i < n; i++)
        change[(k + 1) * stride + i] = block->reach[k] * (fabs(work->rate.y_v[i]) + h * fabs(work->rate.y_u[i]));
    for (int i = 0; i < n; i++)
      work->step[i] = y[i] + h * work->rate.y[i] - moved[i];
    solve(block, work, work->step);
    for (int i = 0; i < n; i++) {
      moved[i] += work->step[i];
      change[i] = fabs(moved[i] - y[i]);
      if (!isfinite(change[i]))
        return 0;
      for (int j = diagonal ? i : 0; j <= (diagonal ? i : n - 1); j++)
        *rate = fmax(*rate, fabs(work->rate.y_y[diagonal ? i : i * n + j]));
    }
  }
  return 1;
}

int ed_ode_force(const ed_ode_block *block, ed_ode_work *work, double t, const double *y, int stride, ed_damper_force *out)
{
  const ed_damper_rate *rate = &work->rate;
  if (!ed_ode_rate(block, t, y, &work->rate))
    return 0;
  out->force = rate->force;
  for (int k = 0; block->direction && k < ED_ODE_DIRECTIONS; k++) {
    const double *s = y + (k + 1) * stride;
    double sum = rate->force_u * ed_path_u(&block->direction[k], t) + rate->force_v * ed_path_v(&block->direction[k], t);
    for (int i = 0; i < block->damper->n_ode; i++)
      sum += rate->force_y[i] * s[i];
    if (block->moved) {
      memory_term(block, work, t, y, k);
      sum += work->other.force;
    }
    out->slope[k] = sum;
    if (!isfinite(sum))
      return 0;
  }
  return 1;
}

/* Derivatives of the memory after an event at t, by difference quotients: it consists of largest and smallest values, which are
 * linear. At an event of its own a value is at its extreme, so that the change of t adds nothing. */
static void memory_slopes(ed_ode_block *block, ed_ode_work *work, double t, const double *y, int stride)
{
  const ed_damper *damper = block->damper;
  const int n = damper->n_ode, m = damper->n_memory;
  double u, v;
  ed_ode_motion(block, t, &u, &v);
  for (int k = 0; k < ED_ODE_DIRECTIONS; k++) {
    const double h_u = ed_path_u(&block->direction[k], t), h_v = ed_path_v(&block->direction[k], t);
    const double d = block->difference[k], *s = y + (k + 1) * stride;
    for (int side = 0; side < 2; side++) {
      const double change = side ? -d : d;
      for (int i = 0; i < m; i++)
        work->memory[side][i] = block->memory[i] + (block->moved ? change * block->memory_slope[k][i] : 0.0);
      for (int i = 0; i < n; i++)
        work->before[i] = y[i] + change * s[i];
      damper->law->remember(damper, u + change * h_u, v + change * h_v, work->before, work->memory[side]);
    }
    for (int i = 0; i < m; i++)
      block->memory_slope[k][i] = (work->memory[0][i] - work->memory[1][i]) / (2.0 * d);
  }
}

void ed_ode_remember(ed_ode_block *block, ed_ode_work *work, double t, const double *y, int stride, int inside)
{
  const ed_damper *damper = block->damper;
  if (!damper->law->remember || damper->n_memory == 0)
    return;
  if (inside && block->direction) {
    memory_slopes(block, work, t, y, stride);
    block->moved = 1;
  }
  double u, v;
  ed_ode_motion(block, t, &u, &v);
  damper->law->remember(damper, u, v, y, block->memory);
}
