/* Section forces and tangents: the vector kernel against fibre by fibre sums, elastic answers bit for bit, tangents
 * against differences, closed forms of a rectangle, and energies against the work done. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "sections.h"
#include "steels.h"

#include <math.h>
#include <string.h>

static const double E = 2.1e11, FY = 275e6, YIELD = 275e6 / 2.1e11, DEPTH = 0.225;

static ed_section i_section(const ed_steel *steels, int flange, int web)
{
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES];
  ed_section section;
  const int n = i_section_fibres(5, 2, flange, web, y, area, material);
  CHECK_INT(ed_section_from_fibres(&section, n, y, NULL, area, material, NULL, steels), 1);
  return section;
}

/* Random states and deformations; the kernel sums in other order than the reference: rounding of the sum of
 * magnitudes. */
static void check_kernel(const ed_steel *steels)
{
  numbers source = {17};
  for (int trial = 0; trial < 300; trial++) {
    double y[MOST_FIBRES], area[MOST_FIBRES], plastic[MOST_FIBRES];
    int material[MOST_FIBRES];
    const int n = 1 + trial % 40; /* every remainder of the lanes */
    for (int i = 0; i < n; i++) {
      y[i] = -DEPTH + 2.0 * DEPTH * (i + next_number(&source, 0.1, 0.9)) / n; /* increasing: layers keep the order */
      area[i] = next_number(&source, 1e-4, 1e-3);
      material[i] = (int)next_number(&source, 0.0, 3.0);
      plastic[i] = next_number(&source, -3.0, 3.0) * YIELD;
    }
    for (int i = 0; i < n; i++)
      plastic[i] *= trial % 3 == 0 || steels[material[i]].law == ED_ELASTIC ? 0.0 : 1.0;
    ed_section section;
    CHECK_INT(ed_section_from_fibres(&section, n, y, NULL, area, material, NULL, steels), 1);
    CHECK(section.straight && !section.curved);
    CHECK_INT(section.n, n);
    double state[MOST_SECTION_STATE] = {0};
    memcpy(state, plastic, (size_t)n * sizeof *state);
    const double e0 = next_number(&source, -2.0, 2.0) * YIELD, kappa = next_number(&source, -2.0, 2.0) * YIELD / DEPTH;
    ed_section_response got;
    ed_section_trial(&section, state, (double[]){e0, kappa}, NULL, &got);
    const ed_section_response expected = sum_of_fibres(n, y, area, material, steels, plastic, e0, kappa);
    double A = 0.0;
    for (int i = 0; i < n; i++)
      A += area[i];
    CHECK_NEAR(got.force[0], expected.force[0], 1e-14 * 10.0 * E * YIELD * A);
    CHECK_NEAR(got.force[1], expected.force[1], 1e-14 * 10.0 * E * YIELD * A * DEPTH);
    CHECK_NEAR(got.k[0], expected.k[0], 1e-14 * E * A);
    CHECK_NEAR(got.k[1], expected.k[1], 1e-14 * E * A * DEPTH);
    CHECK_NEAR(got.k[2], expected.k[2], 1e-14 * E * A * DEPTH * DEPTH);
    CHECK_INT(got.elastic, expected.elastic);
    ed_section_free(&section);
  }
}

static void check_elastic_bits(const ed_steel *steels)
{
  ed_section section = i_section(steels, 0, 1);
  const double state[MOST_SECTION_STATE] = {0};
  const double initial[3] = {section.k[0], section.k[1], section.k[2]};
  for (int i = -9; i <= 9; i++) {
    ed_section_response r;
    ed_section_trial(&section, state, (double[]){0.05 * i * YIELD, 0.05 * i * YIELD / DEPTH}, NULL, &r);
    CHECK_INT(r.elastic, 1);
    CHECK_SAME(r.k, initial, 3);
  }
  ed_section_free(&section);
}

static void check_tangent(const ed_steel *steels, int flange, int web)
{
  numbers source = {23};
  ed_section section = i_section(steels, flange, web);
  double state[MOST_SECTION_STATE];
  ed_section_initialise(&section, state);
  int smooth = 0, tried = 0;
  for (int trial = 0; trial < 200; trial++) {
    const double e0 = next_number(&source, -3.0, 3.0) * YIELD, kappa = next_number(&source, -4.0, 4.0) * YIELD / DEPTH;
    const double h = 1e-6 * YIELD;
    ed_section_response r, plus[2], minus[2];
    ed_section_trial(&section, state, (double[]){e0, kappa}, NULL, &r);
    ed_section_trial(&section, state, (double[]){e0 + h, kappa}, NULL, &plus[0]);
    ed_section_trial(&section, state, (double[]){e0 - h, kappa}, NULL, &minus[0]);
    ed_section_trial(&section, state, (double[]){e0, kappa + h / DEPTH}, NULL, &plus[1]);
    ed_section_trial(&section, state, (double[]){e0, kappa - h / DEPTH}, NULL, &minus[1]);
    /* one layer at its yield point within h spoils the difference: seen as tangents that differ at the two sides */
    int same = 1;
    for (int i = 0; i < 2; i++)
      same &= fabs(plus[i].k[0] - minus[i].k[0]) < 1e-3 * section.k[0];
    tried++;
    smooth += same;
    if (same) {
      /* rounding of the forces over h: 1e-16 / 1e-6, and curvature of the curved law times h^2 */
      CHECK_NEAR((plus[0].force[0] - minus[0].force[0]) / (2.0 * h), r.k[0], 1e-6 * section.k[0]);
      CHECK_NEAR((plus[0].force[1] - minus[0].force[1]) / (2.0 * h), r.k[1], 1e-6 * section.k[0] * DEPTH);
      CHECK_NEAR((plus[1].force[0] - minus[1].force[0]) * DEPTH / (2.0 * h), r.k[1], 1e-6 * section.k[0] * DEPTH);
      CHECK_NEAR((plus[1].force[1] - minus[1].force[1]) * DEPTH / (2.0 * h), r.k[2], 1e-6 * section.k[0] * DEPTH * DEPTH);
    }
    ed_section_commit(&section, state, (double[]){e0, kappa}, NULL);
  }
  CHECK(smooth > 0.9 * tried);
  ed_section_free(&section);
}

/* A rectangle of many layers under growing curvature: M / M_yield = 1.5 - 0.5 (kappa_y / kappa)^2. */
static void check_moment_curvature(const ed_steel *steels)
{
  enum { N = 1000 };
  static double y[N], area[N];
  static int material[N];
  const double height = 0.3, width = 0.1;
  for (int i = 0; i < N; i++) {
    y[i] = ((i + 0.5) / N - 0.5) * height;
    area[i] = width * height / N;
  }
  ed_section section;
  CHECK_INT(ed_section_from_fibres(&section, N, y, NULL, area, material, NULL, steels), 1);
  static double state[N + ED_LANES];
  const double yield_moment = FY * width * height * height / 6.0, kappa_y = 2.0 * YIELD / height;
  for (int i = 1; i <= 20; i++) {
    const double ratio = 0.5 * i;
    ed_section_response r;
    ed_section_trial(&section, state, (double[]){0.0, ratio * kappa_y}, NULL, &r);
    const double expected = ratio <= 1.0 ? ratio : 1.5 - 0.5 / (ratio * ratio);
    CHECK_NEAR(r.force[1], expected * yield_moment, 2e-6 * yield_moment); /* midpoint rule: 2 / N^2 */
    CHECK_NEAR(r.force[0], 0.0, 1e-12 * FY * width * height);
  }
  ed_section_free(&section);
}

static void check_energy(const ed_steel *steels, int flange, int web)
{
  static const double turns[][2] = {{0, 0}, {0.5, 4.0}, {-0.5, -3.0}, {1.0, 2.0}, {0.9, 1.5}, {0.0, -5.0}, {0.2, 0.1}};
  enum { N = 2000 };
  ed_section section = i_section(steels, flange, web);
  double state[MOST_SECTION_STATE], work = 0.0, dissipated = 0.0, e0 = 0.0, kappa = 0.0;
  ed_section_initialise(&section, state);
  ed_section_response last = {0};
  for (size_t t = 1; t < sizeof turns / sizeof *turns; t++)
    for (int i = 1; i <= N; i++) {
      const double s = (double)i / N;
      const double next_e = YIELD * (turns[t - 1][0] + s * (turns[t][0] - turns[t - 1][0]));
      const double next_k = YIELD / DEPTH * (turns[t - 1][1] + s * (turns[t][1] - turns[t - 1][1]));
      ed_section_response r;
      ed_section_trial(&section, state, (double[]){next_e, next_k}, NULL, &r);
      work += 0.5 * ((r.force[0] + last.force[0]) * (next_e - e0) + (r.force[1] + last.force[1]) * (next_k - kappa));
      dissipated += ed_section_commit(&section, state, (double[]){next_e, next_k}, NULL);
      e0 = next_e;
      kappa = next_k;
      last = r;
    }
  const double stored = ed_section_stored(&section, state, (double[]){e0, kappa});
  CHECK(stored > 0.0 && dissipated > stored);
  CHECK_NEAR(dissipated + stored, work, 2e-6 * work); /* trapezoids across yield points: (step / yield strain)^2 / 8 */
  /* stored energy is that of the layers' stresses */
  double of_layers = 0.0;
  for (int i = 0; i < section.n; i++) {
    double stress, strain;
    ed_section_layer(&section, state, i, (double[]){e0, kappa}, &stress, &strain);
    CHECK_NEAR(strain, e0 - kappa * section.y[i], 1e-18);
    of_layers += section.area[i] * stress * stress / (2.0 * section.steel[i]->E);
  }
  CHECK_NEAR(stored, of_layers, 1e-13 * of_layers);
  ed_section_free(&section);
}

/* Within the reach of a trial forces follow the tangent, to 1e-12 of yield in each layer; a commit there by the trial's record leaves the
 * stresses of one that evaluates every layer. */
static void check_reach(const ed_steel *steels, int flange, int web, double shortest)
{
  numbers source = {5};
  ed_section section = i_section(steels, flange, web);
  double state[MOST_SECTION_STATE], evaluated[MOST_SECTION_STATE], record[MOST_SECTION_STATE], e0 = 0.0, kappa = 0.0, force = 0.0;
  double longest = 0.0;
  for (int i = 0; i < section.n; i++)
    force += section.area[i] * section.steel[i]->E * YIELD;
  ed_section_initialise(&section, state);
  for (int i = 0; i < 500; i++) {
    e0 += next_number(&source, -0.3, 0.3) * YIELD;
    kappa += next_number(&source, -1.0, 1.0) * YIELD / DEPTH;
    ed_section_response r, there;
    ed_section_trial(&section, state, (double[]){e0, kappa}, record, &r);
    const double reach = fmin(r.reach, YIELD); /* without yielding nothing ends it */
    const double part = next_number(&source, -1.0, 1.0), de = part * reach, dk = (1.0 - fabs(part)) * reach / section.depth;
    longest = fmax(longest, reach);
    ed_section_trial(&section, state, (double[]){e0 + de, kappa + dk}, NULL, &there);
    /* layers of a stress of up to 1.3 times yield, sums of some 20 of them */
    CHECK_NEAR(there.force[0], r.force[0] + r.k[0] * de + r.k[1] * dk, 2e-12 * force);
    CHECK_NEAR(there.force[1], r.force[1] + r.k[1] * de + r.k[2] * dk, 2e-12 * force * section.depth);
    e0 += de;
    kappa += dk;
    memcpy(evaluated, state, (size_t)section.state_size * sizeof *state);
    const double dissipated = ed_section_commit(&section, evaluated, (double[]){e0, kappa}, NULL);
    CHECK_NEAR(ed_section_commit(&section, state, (double[]){e0, kappa}, record), dissipated, 1e-11 * force * YIELD);
    for (int layer = 0; layer < section.n; layer++) {
      double stress, expected, strain;
      ed_section_layer(&section, state, layer, (double[]){e0, kappa}, &stress, &strain);
      ed_section_layer(&section, evaluated, layer, (double[]){e0, kappa}, &expected, &strain);
      CHECK_NEAR(stress, expected, 2e-12 * FY);
    }
    memcpy(state, evaluated, (size_t)section.state_size * sizeof *state);
  }
  CHECK(longest > shortest * YIELD);
  ed_section_free(&section);
}

static void check_elastic_section(void)
{
  ed_section section;
  ed_section_response r;
  ed_section_elastic(&section, ED_PLANE, (double[]){3e9, 5e7});
  ed_section_trial(&section, NULL, (double[]){1e-3, -2e-3}, NULL, &r);
  CHECK(r.force[0] == 3e9 * 1e-3 && r.force[1] == 5e7 * -2e-3 && r.k[0] == 3e9 && r.k[1] == 0.0 && r.k[2] == 5e7 && r.elastic);
  CHECK_INT(section.state_size, 0);
  CHECK_NEAR(ed_section_stored(&section, NULL, (double[]){1e-3, -2e-3}), 0.5 * (3e9 * 1e-6 + 5e7 * 4e-6), 1e-9);
  CHECK(ed_section_commit(&section, NULL, (double[]){1e-3, -2e-3}, NULL) == 0.0);
  ed_section_free(&section);
}

int main(void)
{
  const ed_steel steels[] = {bilinear_steel(E, FY, 0.0), bilinear_steel(E, 1.3 * FY, 0.02), elastic_steel(0.5 * E),
                             menegotto_pinto_steel(E, FY, 0.01)};
  check_kernel(steels);
  check_elastic_bits(steels);
  check_tangent(steels, 0, 1);
  check_tangent(steels, 1, 2);
  check_tangent(steels, 3, 0);
  check_tangent(steels, 3, 3);
  check_moment_curvature(steels);
  check_energy(steels, 0, 0);
  check_energy(steels, 1, 2);
  check_energy(steels, 3, 1);
  check_reach(steels, 0, 1, 1e-3); /* to the nearest kink */
  check_reach(steels, 3, 3, 1e-7); /* sqrt(1e-12) over the bend */
  check_reach(steels, 3, 1, 1e-7);
  check_elastic_section();
  return checks_end("section response");
}
