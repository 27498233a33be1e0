/* One member with rigid ends: closed form of its stiffness, loads on its rigid parts, rigid motions, tangents by differences. */
#include "checks.h"
#include "member.h"

#include <math.h>
#include <string.h>

static const double A = 0.3, B = 0.5, L = 4.0;
static const ed_element_kind KINDS[] = {ED_FIBRE_BEAM, ED_ELASTIC_BEAM};

static member rigid_member(ed_element_kind kind, int geometry, steel_kind steel)
{
  return member_new((member_options){.kind = kind, .geometry = geometry, .steel = steel, .rigid = {A, B}});
}

/* Rotations of the nodes turn the clear length l at its ends by t (1 + a / l) and t a / l: slope deflection with arms. */
static void check_stiffness(ed_element_kind kind)
{
  member m = rigid_member(kind, ED_LINEAR, PLASTIC);
  const double l = L - A - B, EI = m.e.section[0]->k[2], k = EI / l, d[6] = {0};
  double t[36];
  CHECK_NEAR(m.e.length, l, 1e-15);
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_tangent(&m.e, d, m.block, t);
  CHECK_NEAR(t[14], k * (4.0 + 12.0 * A / l + 12.0 * A * A / (l * l)), 1e-12 * EI);
  CHECK_NEAR(t[35], k * (4.0 + 12.0 * B / l + 12.0 * B * B / (l * l)), 1e-12 * EI);
  CHECK_NEAR(t[17], k * (2.0 + 6.0 * (A + B) / l + 12.0 * A * B / (l * l)), 1e-12 * EI);
  CHECK_NEAR(m.e.c * t[8] - m.e.s * t[2], k / l * (6.0 + 12.0 * A / l), 1e-12 * EI);
  member_free(&m);
}

/* Fixed nodes under a uniform load: w l^2 / 12 at the faces; the arms bring its shear and their own load to the nodes. */
static void check_uniform_load(ed_element_kind kind, int geometry)
{
  member m = rigid_member(kind, geometry, PLASTIC);
  const double l = L - A - B, w = 20e3, d[6] = {0};
  double f[6];
  member_load(&m, 0.0, -w, 0.0, 0.0);
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  CHECK_NEAR(f[2], w * (l * l / 12.0 + 0.5 * l * A + 0.5 * A * A), 1e-11 * w * L * L);
  CHECK_NEAR(f[5], -w * (l * l / 12.0 + 0.5 * l * B + 0.5 * B * B), 1e-11 * w * L * L);
  CHECK_NEAR(m.e.c * f[1] - m.e.s * f[0], w * (0.5 * l + A), 1e-11 * w * L);
  CHECK_NEAR(m.e.c * f[4] - m.e.s * f[3], w * (0.5 * l + B), 1e-11 * w * L);
  member_free(&m);
}

/* Sums of forces and moments of a triangular load over the whole length and of forces on both arms. */
static void check_resultants(void)
{
  const ed_member_load loads[] = {{.position = 0.0, .end = 1.0, .transverse_end = {-30e3}},
                                  {.position = 0.05, .transverse = {-7e3}, .axial = 2e3},
                                  {.position = 0.95, .transverse = {-5e3}, .axial = 1e3}};
  member m = rigid_member(ED_ELASTIC_BEAM, ED_LINEAR, PLASTIC);
  const double d[6] = {0};
  double f[6];
  for (int i = 0; i < 3; i++)
    ed_rigid_add_load(&m.e, &loads[i], 1.0);
  ed_element_finish_loads(&m.e);
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  const double across = m.e.c * (f[1] + f[4]) - m.e.s * (f[0] + f[3]), along = m.e.c * (f[0] + f[3]) + m.e.s * (f[1] + f[4]);
  const double shear_j = m.e.c * f[4] - m.e.s * f[3];
  CHECK_NEAR(across, 0.5 * 30e3 * L + 12e3, 1e-7);
  CHECK_NEAR(along, -3e3, 1e-7);
  CHECK_NEAR(f[2] + f[5] + shear_j * L, 30e3 * L * L / 3.0 + 0.05 * L * 7e3 + 0.95 * L * 5e3, 1e-6);
  member_free(&m);
}

static void check_rigid_motion(ed_element_kind kind, double turn)
{
  member m = rigid_member(kind, ED_COROTATIONAL, PLASTIC);
  double d[6], f[6];
  draw_displacement(&m, turn, 0.0, 7, d);
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  for (int k = 0; k < 6; k++)
    CHECK_NEAR(f[k], 0.0, 1e-5); /* N: the stiffness, 1e9 N/m, times the rounding of displacements of 5 m */
  member_free(&m);
}

/* The force-based member iterates to 1e-11 of its forces. P-Delta leaves out what is not symmetric: it is tried undeformed. */
static void check_tangent(ed_element_kind kind, int geometry, unsigned seed)
{
  member m = rigid_member(kind, geometry, HARDENING);
  double d[6], t[36], plus[6], minus[6];
  member_load(&m, geometry == ED_COROTATIONAL ? 0.0 : 3e3, -20e3, 0.0, -30e3);
  draw_displacement(&m, geometry == ED_COROTATIONAL ? 0.7 : 0.0, geometry == ED_P_DELTA ? 0.0 : 1e-3, seed, d);
  if (geometry == ED_P_DELTA)
    d[3] += 1e-3 * m.e.c, d[4] += 1e-3 * m.e.s, d[2] = d[5] = 0.0; /* a tension of some 1 MN */
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_tangent(&m.e, d, m.block, t);
  const double elastic = m.e.stiffness[0];
  for (int j = 0; j < 6; j++) {
    const double h = 1e-6, unit = j % 3 == 2 ? L : 1.0;
    double moved[6];
    memcpy(moved, d, sizeof moved);
    moved[j] = d[j] + h;
    CHECK_STATUS(member_update(&m, moved), ED_OK);
    ed_element_forces(&m.e, moved, m.block, plus);
    moved[j] = d[j] - h;
    CHECK_STATUS(member_update(&m, moved), ED_OK);
    ed_element_forces(&m.e, moved, m.block, minus);
    for (int i = 0; i < 6; i++)
      CHECK_NEAR((plus[i] - minus[i]) / (2.0 * h), t[6 * i + j], 1e-6 * elastic * unit * (i % 3 == 2 ? L : 1.0));
  }
  member_free(&m);
}

static void check_refused(void)
{
  member m = member_new((member_options){.kind = ED_TRUSS});
  CHECK_STATUS(ed_model_rigid_ends(m.model, 0, 0.1, 0.1), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_rigid_ends(m.model, 1, 0.1, 0.1), ED_E_ID);
  member_free(&m);
  m = member_new((member_options){.kind = ED_ELASTIC_BEAM});
  CHECK_STATUS(ed_model_rigid_ends(m.model, 0, 2.0, 2.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_rigid_ends(m.model, 0, -0.1, 0.1), ED_E_ARGUMENT);
  member_free(&m);
}

int main(void)
{
  for (int k = 0; k < 2; k++) {
    check_stiffness(KINDS[k]);
    check_uniform_load(KINDS[k], ED_LINEAR);
    check_uniform_load(KINDS[k], ED_COROTATIONAL);
    for (int i = 0; i < 4; i++)
      check_rigid_motion(KINDS[k], -1.3 + 1.7 * i);
    for (int geometry = ED_LINEAR; geometry <= ED_COROTATIONAL; geometry++)
      for (unsigned seed = 1; seed <= 5; seed++)
        check_tangent(KINDS[k], geometry, seed);
  }
  check_resultants();
  check_refused();
  return checks_end("rigid ends");
}
