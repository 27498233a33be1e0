/* Tangents of one member against central differences of its forces: every geometry, elastic and yielded, released,
 * loaded. */
#include "checks.h"
#include "member.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  long tried, smooth;
} tally;

/* Forces without what the P-Delta tangent leaves out, change of the axial force times drift / L: it would make the
 * matrix unsymmetric. `chord` is drift / L where the tangent is taken. Then the tangent; the
 * block is left as it was. */
static int evaluate(member *m, const double *d, double chord, double *force, double *tangent)
{
  const size_t bytes = (size_t)ed_element_block_size(&m->e) * sizeof(double);
  double *block = malloc(bytes);
  memcpy(block, m->block, bytes);
  const int status = member_update(m, d);
  ed_element_forces(&m->e, d, m->block, force);
  ed_element_tangent(&m->e, d, m->block, tangent);
  const double left_out = (m->block[ED_BLOCK_Q] - block[ED_BLOCK_Q]) * chord;
  force[0] -= m->e.s * left_out;
  force[1] += m->e.c * left_out;
  force[3] += m->e.s * left_out;
  force[4] -= m->e.c * left_out;
  memcpy(m->block, block, bytes);
  free(block);
  return status;
}

/* A section next to fully plastic: the direction of the iteration keeps 1e-8 of the elastic stiffness there by design,
 * which shows in the tangent when less than 1e-4 is left. */
static int nearly_plastic(const member *m)
{
  for (int p = 0; p < m->e.points; p++) {
    const double *k = m->block + ed_point_at(ED_PLANE, p) + ed_point_k(ED_PLANE);
    const ed_section *section = m->e.section[p];
    const double a = k[0] / section->k[0], b = k[2] / section->k[2], c = k[1] * k[1] / (section->k[0] * section->k[2]);
    if (a * b - c < 1e-4 * (a + b) || a + b == 0.0) /* smaller eigenvalue, nearly */
      return 1;
  }
  return 0;
}

static void check_at(member *m, const double *d, tally *count)
{
  const double elastic = m->e.kind == ED_LINK ? 3e7 : m->e.stiffness[0];
  double tangent[36], scale[6];
  const int status = member_update(m, d);
  count->tried += 6;
  CHECK_STATUS(status, ED_OK);
  if (status != ED_OK || nearly_plastic(m))
    return;
  ed_element_tangent(&m->e, d, m->block, tangent);
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < i; j++)
      CHECK_NEAR(tangent[6 * i + j], tangent[6 * j + i], 1e-9 * elastic * m->e.length);
  const double drift = -m->e.s * (d[3] - d[0]) + m->e.c * (d[4] - d[1]);
  const double chord = m->e.geometry == ED_P_DELTA && m->e.kind != ED_LINK ? drift / m->e.length : 0.0;
  for (int i = 0; i < 6; i++)
    scale[i] = i % 3 == 2 ? m->e.length : 1.0;
  for (int j = 0; j < 6; j++) {
    double plus[6], minus[6], after[36], before[36], moved[6], jump = 0.0;
    const double h = 1e-6 / scale[j] * m->e.length * 0.1;
    memcpy(moved, d, sizeof moved);
    moved[j] = d[j] + h;
    CHECK_STATUS(evaluate(m, moved, chord, plus, after), ED_OK);
    moved[j] = d[j] - h;
    CHECK_STATUS(evaluate(m, moved, chord, minus, before), ED_OK);
    /* tangents at the two sides: the difference of the forces lies between them */
    for (int i = 0; i < 6; i++)
      jump = fmax(jump, fabs(after[6 * i + j] - before[6 * i + j]) / (scale[i] * scale[j]));
    if (jump > 1e-3 * elastic)
      continue; /* a layer starts to yield or unloads within h */
    count->smooth++;
    /* rounding of the forces over h; the element iterates to an energy of 1e-22 of its own, forces to 1e-11 */
    for (int i = 0; i < 6; i++)
      CHECK_NEAR((plus[i] - minus[i]) / (2.0 * h), tangent[6 * i + j],
                 (1e-6 * elastic + jump) * scale[i] * scale[j]);
  }
}

static void check_member(member_options options, int loaded, double size, tally *count)
{
  for (unsigned seed = 1; seed <= 5; seed++) {
    member m = member_new(options);
    double d[6];
    if (loaded)
      member_load(&m, 3e3, -20e3, 15e3, -30e3);
    draw_displacement(&m, options.geometry == ED_COROTATIONAL ? 0.7 : 0.0, size, seed, d);
    check_at(&m, d, count);
    ed_element_commit(&m.e, m.block, m.layers);
    draw_displacement(&m, options.geometry == ED_COROTATIONAL ? 0.8 : 0.0, size, seed + 100, d);
    check_at(&m, d, count); /* from a committed, often yielded state */
    member_free(&m);
  }
}

/* At rest and in small motions the tangent is the elastic one: closed form of a prismatic beam in local axes. */
static void check_closed_form(ed_element_kind kind)
{
  member m = member_new((member_options){.kind = kind, .steel = PLASTIC});
  const ed_section *section = m.e.section[0];
  const double L = m.e.length, EA = section->k[0], EI = section->k[2];
  const double d[6] = {0};
  double t[36];
  CHECK_STATUS(member_update(&m, d), ED_OK);
  ed_element_tangent(&m.e, d, m.block, t);
  const double c = m.e.c, s = m.e.s, k = 12.0 * EI / (L * L * L);
  CHECK_NEAR(t[0], c * c * EA / L + s * s * k, 1e-12 * EA / L);
  CHECK_NEAR(t[1], c * s * (EA / L - k), 1e-12 * EA / L);
  CHECK_NEAR(t[7], s * s * EA / L + c * c * k, 1e-12 * EA / L);
  CHECK_NEAR(t[14], 4.0 * EI / L, 1e-12 * EI);
  CHECK_NEAR(t[17], 2.0 * EI / L, 1e-12 * EI);
  CHECK_NEAR(t[2], -s * 6.0 * EI / (L * L), 1e-12 * EI);
  CHECK_NEAR(t[8], c * 6.0 * EI / (L * L), 1e-12 * EI);
  member_free(&m);
}

int main(void)
{
  static const ed_element_kind kinds[] = {ED_FIBRE_BEAM, ED_ELASTIC_BEAM, ED_TRUSS, ED_LINK};
  tally count = {0, 0};
  check_closed_form(ED_FIBRE_BEAM);
  check_closed_form(ED_ELASTIC_BEAM);
  for (int k = 0; k < 4; k++)
    for (int geometry = ED_LINEAR; geometry <= (k == 3 ? ED_LINEAR : ED_COROTATIONAL); geometry++)
      for (int steel = 0; steel < (kinds[k] == ED_FIBRE_BEAM ? STEEL_KINDS : 1); steel++)
        for (int release = 0; release < (k < 2 ? 4 : 1); release++)
          for (int loaded = 0; loaded < (k < 2 ? 2 : 1); loaded++) {
            const member_options options = {.kind = kinds[k], .geometry = geometry, .steel = (steel_kind)steel,
                                            .release = {release & 1, release >> 1}};
            check_member(options, loaded, 1e-3, &count); /* elastic without loads */
            check_member(options, loaded, 0.02, &count); /* far beyond yield */
          }
  CHECK(count.smooth > 0.9 * count.tried);
  return checks_end("tangents of elements");
}
