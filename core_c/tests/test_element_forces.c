/* End forces of one member: equilibrium with its loads, rigid motions, closed forms of elastic beams. */
#include "checks.h"
#include "member.h"

#include <math.h>

static const double WX = 3e3, WY = -20e3, PX = 15e3, PY = -30e3, SHARE = 0.3;
static const ed_element_kind KINDS[] = {ED_FIBRE_BEAM, ED_ELASTIC_BEAM, ED_TRUSS, ED_LINK};

/* Sum of forces and of moments about i, the ends where the geometry sees them. */
static void check_balance(ed_element_kind kind, int geometry, int loaded, double size, unsigned long long seed)
{
  const int own = kind == ED_LINK ? ED_LINEAR : geometry;
  member m = member_new((member_options){.kind = kind, .geometry = own, .steel = HARDENING});
  const double L = m.e.length, c = m.e.c, s = m.e.s;
  double d[6], f[6];
  if (loaded)
    member_load(&m, WX, WY, PX, PY);
  draw_displacement(&m, geometry == ED_COROTATIONAL && kind != ED_LINK ? 0.7 : 0.0, size, seed, d);
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  const double X = loaded ? WX * L + PX : 0.0, Y = loaded ? WY * L + PY : 0.0;
  double level = 1e3;
  for (int i = 0; i < 6; i++)
    level = fmax(level, fabs(f[i]));
  /* the member resists: its forces on the nodes' side carry the load's opposite sign */
  CHECK_NEAR(f[0] + f[3] + c * X - s * Y, 0.0, 1e-13 * level);
  CHECK_NEAR(f[1] + f[4] + s * X + c * Y, 0.0, 1e-13 * level);
  const double dx = d[3] - d[0], dy = d[4] - d[1], drift = -s * dx + c * dy;
  double x = L * c, y = L * s; /* of j from i */
  if (geometry == ED_P_DELTA && kind != ED_LINK) {
    x -= s * drift;
    y += c * drift;
  } else if (geometry == ED_COROTATIONAL && kind != ED_LINK) {
    x += dx;
    y += dy;
  }
  /* loads keep their direction and act on the chord where it has moved to */
  const double moved = geometry == ED_LINEAR ? 0.0 : drift;
  const double along = geometry == ED_COROTATIONAL ? L + c * dx + s * dy : L;
  const double of_loads = loaded ? along * (0.5 * WY * L + SHARE * PY) - moved * (0.5 * WX * L + SHARE * PX) : 0.0;
  CHECK_NEAR(f[2] + f[5] + x * f[4] - y * f[3] + of_loads, 0.0, 1e-12 * level * L);
  member_free(&m);
}

static void check_rigid_motion(ed_element_kind kind)
{
  static const double turns[] = {0.0, 0.4, -1.3, 2.6, 3.3, 7.0};
  for (int i = 0; i < 6; i++) {
    member m = member_new((member_options){.kind = kind, .geometry = ED_COROTATIONAL, .steel = PLASTIC});
    double d[6], f[6];
    draw_displacement(&m, turns[i], 0.0, 3 + (unsigned)i, d);
    CHECK_STATUS(member_update(&m, d), ED_OK);
    ed_element_forces(&m.e, d, m.block, f);
    for (int k = 0; k < 6; k++)
      CHECK_NEAR(f[k], 0.0, 1e-5); /* N: the stiffness, 1e9 N/m, times the rounding of displacements of 5 m */
    member_free(&m);
  }
}

/* Fixed ends: the fixed-end moments and shears of a prismatic beam (any handbook). */
static void check_fixed_ends(ed_element_kind kind, int release_j)
{
  member m = member_new((member_options){.kind = kind, .steel = PLASTIC, .points = 6, .release = {0, release_j}});
  const double L = m.e.length;
  const double d[6] = {0};
  const ed_member_load uniform = {.position = -1.0, .transverse = {WY}};
  ed_element_add_load(&m.e, &uniform, 1.0);
  ed_element_finish_loads(&m.e);
  double f[6];
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  const double w = -WY;
  CHECK_NEAR(f[2], (release_j ? 1.0 / 8.0 : 1.0 / 12.0) * w * L * L, 1e-11 * w * L * L);
  CHECK_NEAR(f[5], release_j ? 0.0 : -w * L * L / 12.0, 1e-11 * w * L * L);
  const double shear_i = m.e.c * f[1] - m.e.s * f[0], shear_j = m.e.c * f[4] - m.e.s * f[3];
  CHECK_NEAR(shear_i, (release_j ? 5.0 / 8.0 : 0.5) * w * L, 1e-11 * w * L);
  CHECK_NEAR(shear_j, (release_j ? 3.0 / 8.0 : 0.5) * w * L, 1e-11 * w * L);
  member_free(&m);
}

static void check_point_load(void)
{
  member m = member_new((member_options){.kind = ED_ELASTIC_BEAM, .steel = PLASTIC});
  const double L = m.e.length, a = SHARE * L, b = L - a, P = -PY, d[6] = {0};
  const ed_member_load point = {.position = SHARE, .transverse = {PY}, .axial = PX};
  ed_element_add_load(&m.e, &point, 1.0);
  ed_element_finish_loads(&m.e);
  double f[6];
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_forces(&m.e, d, m.block, f);
  CHECK_NEAR(f[2], P * a * b * b / (L * L), 1e-11 * P * L);
  CHECK_NEAR(f[5], -P * a * a * b / (L * L), 1e-11 * P * L);
  const double axial_i = m.e.c * f[0] + m.e.s * f[1], axial_j = m.e.c * f[3] + m.e.s * f[4];
  CHECK_NEAR(axial_i, -PX * b / L, 1e-11 * PX);
  CHECK_NEAR(axial_j, -PX * a / L, 1e-11 * PX);
  member_free(&m);
}

int main(void)
{
  for (int k = 0; k < 4; k++)
    for (int geometry = ED_LINEAR; geometry <= ED_COROTATIONAL; geometry++)
      for (int loaded = 0; loaded < (k < 2 ? 2 : 1); loaded++)
        for (int i = 0; i < 6; i++)
          check_balance(KINDS[k], geometry, loaded, i < 3 ? 1e-3 : 0.03, 10 + (unsigned)i);
  for (int k = 0; k < 3; k++)
    check_rigid_motion(KINDS[k]);
  for (int k = 0; k < 2; k++) {
    check_fixed_ends(KINDS[k], 0);
    check_fixed_ends(KINDS[k], 1);
  }
  check_point_load();
  return checks_end("end forces");
}
