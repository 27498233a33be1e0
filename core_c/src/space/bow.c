/* Bows: what loads along the member, Legendre's polynomials P_k'' over its length, bend it to between fixed nodes. Moments of the member on
 * hinges are P_k - 1 (k even) and P_k - s (k odd), s = -1 .. 1; moments that restrain its ends come on top, through the springs. Loads of
 * degree 0 to ED_BOWS - 1 leave of the force at which it buckles between fixed nodes: 5e-7 too much on hinges, 6e-4 with fixed ends. Shear
 * deformation is Timoshenko's; the axial force acts along the slope of the axis (Engesser). */
#include "space/bow.h"

#include <math.h>
#include <string.h>

enum { POINTS = 8 }; /* of Gauss: exact for slopes of degree ED_BOWS + 2, squared */
static const double PLACE[POINTS] = {-0.96028985649753623, -0.79666647741362674, -0.52553240991632899, -0.18343464249564980,
                                     0.18343464249564980,  0.52553240991632899,  0.79666647741362674,  0.96028985649753623};
static const double WEIGHT[POINTS] = {0.10122853629037626, 0.22238103445337447, 0.31370664587788729, 0.36268378337836198,
                                      0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626};

/* P_2' .. and the integrals of P_2 .. that vanish at both ends, (P_k+1 - P_k-1) / (2 k + 1). */
static void legendre(double s, double *slope, double *integral)
{
  double P[ED_BOWS + 3] = {1.0, s}, D[ED_BOWS + 3] = {0.0, 1.0};
  for (int k = 1; k < ED_BOWS + 2; k++) {
    P[k + 1] = ((2 * k + 1) * s * P[k] - k * P[k - 1]) / (k + 1);
    D[k + 1] = D[k - 1] + (2 * k + 1) * P[k];
  }
  for (int b = 0; b < ED_BOWS; b++) {
    slope[b] = D[b + 2];
    integral[b] = (P[b + 3] - P[b + 1]) / (2 * b + 5);
  }
}

/* Lower triangle of Cholesky's factor, in place; 0 where the matrix is not positive definite. */
static int factor(double a[ED_BOWS][ED_BOWS])
{
  for (int i = 0; i < ED_BOWS; i++)
    for (int j = 0; j <= i; j++) {
      double rest = a[i][j];
      for (int k = 0; k < j; k++)
        rest -= a[i][k] * a[j][k];
      if (i == j && !(rest > 0.0))
        return 0;
      a[i][j] = i == j ? sqrt(rest) : rest / a[j][j];
    }
  return 1;
}

/* x <- L^-1 x of one value for each bow, `step` apart. */
static void divide(const double L[ED_BOWS][ED_BOWS], double *x, int step)
{
  for (int i = 0; i < ED_BOWS; i++) {
    for (int k = 0; k < i; k++)
      x[i * step] -= L[i][k] * x[k * step];
    x[i * step] /= L[i][i];
  }
}

static void bow(double force, double length, ed_space_plane p, const double *k, ed_space_bow *of)
{
  const double phi = 12.0 * p.EI / length * p.shear, soft = 0.5 * length / p.EI;
  double f[3], slopes[ED_BOWS][POINTS], ends[2][POINTS], energy[ED_BOWS][ED_BOWS] = {{0.0}};
  ed_member_flexibility(length, p, f);
  const double turned[2][2] = {{f[0] * k[0] + f[1] * k[1], f[0] * k[1] + f[1] * k[2]},
                               {f[1] * k[0] + f[2] * k[1], f[1] * k[1] + f[2] * k[2]}}; /* end sections, by the nodes */
  for (int g = 0; g < POINTS; g++) {
    const double s = PLACE[g];
    double D[ED_BOWS], integral[ED_BOWS];
    legendre(s, D, integral);
    const double x = 0.5 * (1.0 + s), shared = 0.5 / (1.0 + phi) * (6.0 * x * (1.0 - x) + phi);
    ends[0][g] = 1.0 - x - shared; /* slope from the chord when an end section turns by 1 */
    ends[1][g] = x - shared;
    for (int b = 0; b < ED_BOWS; b++) {
      /* on hinges, whose end sections turn by t1 and t2; then turned back as far as the springs restrain them */
      const int odd = b % 2;
      const double t1 = odd ? -1.0 / 3.0 : 1.0, t2 = odd ? -1.0 / 3.0 : -1.0;
      const double hinged = integral[b] - (odd ? 0.5 * (s * s - 1.0) + 1.0 / 3.0 : s) - phi / 3.0 * (D[b] - odd);
      slopes[b][g] = soft * (hinged - ends[0][g] * (turned[0][0] * t1 + turned[0][1] * t2) - ends[1][g] * (turned[1][0] * t1 + turned[1][1] * t2));
    }
    for (int b = 0; b < ED_BOWS; b++)
      for (int c = 0; c < ED_BOWS; c++) /* work of the load of one bow on the other */
        energy[b][c] -= WEIGHT[g] * D[b] * slopes[c][g];
  }
  factor(energy);
  memset(of, 0, sizeof *of);
  for (int g = 0; g < POINTS; g++) {
    double unit[ED_BOWS];
    const double weight = 0.5 * force * length * WEIGHT[g];
    const double one = ends[0][g] * turned[0][0] + ends[1][g] * turned[1][0], other = ends[0][g] * turned[0][1] + ends[1][g] * turned[1][1];
    for (int b = 0; b < ED_BOWS; b++)
      unit[b] = slopes[b][g];
    divide(energy, unit, 1);
    of->turns[0] += weight * one * one;
    of->turns[1] += weight * one * other;
    of->turns[2] += weight * other * other;
    for (int b = 0; b < ED_BOWS; b++) {
      for (int c = 0; c < ED_BOWS; c++)
        of->bows[b][c] += weight * unit[b] * unit[c];
      of->coupling[b][0] += weight * unit[b] * one;
      of->coupling[b][1] += weight * unit[b] * other;
    }
  }
}

void ed_member_bow(const ed_space_member *m, double axial, ed_space_bowed *of)
{
  of->across = axial / m->length;
  if (m->axial_only)
    return;
  bow(axial, m->length, ed_member_plane_y(m), m->stiffness.y, &of->y);
  bow(axial, m->length, ed_member_plane_z(m), m->stiffness.z, &of->z);
}

/* Moments at the ends, and forces on the bows, of one plane. */
static void of_plane(const ed_space_bow *bow, const double *rotation, const double *amplitude, double *moment, double *image)
{
  moment[0] = bow->turns[0] * rotation[0] + bow->turns[1] * rotation[1];
  moment[1] = bow->turns[1] * rotation[0] + bow->turns[2] * rotation[1];
  for (int b = 0; b < ED_BOWS; b++) {
    moment[0] += bow->coupling[b][0] * amplitude[b];
    moment[1] += bow->coupling[b][1] * amplitude[b];
    image[b] += bow->coupling[b][0] * rotation[0] + bow->coupling[b][1] * rotation[1];
    for (int c = 0; c < ED_BOWS; c++)
      image[b] += bow->bows[b][c] * amplitude[c];
  }
}

void ed_member_add_geometric(const ed_space_member *m, const ed_space_bowed *of, const double *start, const double *end,
                             const double *amplitude, double *force, double *image)
{
  const double apart[3] = {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
  double D[3], r1[3], r2[3], y[2], z[2];
  ed_member_to_local(m, apart, D);
  for (int i = 1; i < 3; i++) {
    force[i] -= of->across * D[i];
    force[6 + i] += of->across * D[i];
  }
  if (m->axial_only)
    return;
  ed_member_to_local(m, start + 3, r1);
  ed_member_to_local(m, end + 3, r2);
  const double in_y[2] = {r1[1] + D[2] / m->length, r2[1] + D[2] / m->length};
  const double in_z[2] = {r1[2] - D[1] / m->length, r2[2] - D[1] / m->length};
  of_plane(&of->y, in_y, amplitude, y, image);
  of_plane(&of->z, in_z, amplitude + ED_BOWS, z, image + ED_BOWS);
  ed_member_add_end_moments(m->length, y[0], y[1], z[0], z[1], force);
}

static int pressed(const ed_space_bow *bow, double lambda, double *k)
{
  double bows[ED_BOWS][ED_BOWS], coupling[ED_BOWS][2];
  for (int b = 0; b < ED_BOWS; b++) {
    for (int c = 0; c < ED_BOWS; c++)
      bows[b][c] = (b == c) + lambda * bow->bows[b][c];
    coupling[b][0] = lambda * bow->coupling[b][0];
    coupling[b][1] = lambda * bow->coupling[b][1];
  }
  if (!factor(bows))
    return 0;
  for (int i = 0; i < 3; i++)
    k[i] += lambda * bow->turns[i];
  divide(bows, &coupling[0][0], 2);
  divide(bows, &coupling[0][1], 2);
  for (int b = 0; b < ED_BOWS; b++) {
    k[0] -= coupling[b][0] * coupling[b][0];
    k[1] -= coupling[b][0] * coupling[b][1];
    k[2] -= coupling[b][1] * coupling[b][1];
  }
  return 1;
}

int ed_member_pressed(const ed_space_member *m, const ed_space_bowed *of, double lambda, ed_space_stiffness *stiffness)
{
  *stiffness = m->stiffness;
  stiffness->across += lambda * of->across;
  return m->axial_only || (pressed(&of->y, lambda, stiffness->y) && pressed(&of->z, lambda, stiffness->z));
}
