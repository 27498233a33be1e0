/* Fibres of one depth and material become one layer, whatever order they come in; the order changes no bit. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "sections.h"
#include "steels.h"

#include <string.h>

static const double E = 2.1e11, FY = 275e6;

static void shuffle(int n, double *y, double *area, int *material, numbers *source)
{
  for (int i = n - 1; i > 0; i--) {
    const int j = (int)next_number(source, 0.0, i + 1.0);
    const double depth = y[i], a = area[i];
    const int m = material[i];
    y[i] = y[j];
    y[j] = depth;
    area[i] = area[j];
    area[j] = a;
    material[i] = material[j];
    material[j] = m;
  }
}

static void check_count_and_sums(const ed_steel *steels)
{
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES];
  const int n = i_section_fibres(4, 5, 0, 1, y, area, material);
  ed_section section;
  CHECK_INT(n, 60);
  CHECK_INT(ed_section_from_fibres(&section, n, y, NULL, area, material, NULL, steels), 1);
  CHECK_INT(section.n, 12);
  CHECK_INT(section.n_padded, 16);
  CHECK_INT(section.elastic, 0);
  double given = 0.0, merged = 0.0, inertia = 0.0;
  for (int i = 0; i < n; i++) {
    given += area[i];
    inertia += area[i] * y[i] * y[i];
  }
  for (int i = 0; i < section.n; i++) {
    merged += section.area[i];
    CHECK(i == 0 || section.y[i] > section.y[i - 1]);
  }
  CHECK_NEAR(merged, given, 1e-14 * given);
  CHECK_NEAR(section.k[2], E * inertia, 1e-14 * E * inertia);
  CHECK_NEAR(section.depth, 0.225 - 0.0146 / 8.0, 1e-15);
  CHECK_NEAR(section.yield_strain, FY / E, 1e-18);
  ed_section_free(&section);
}

static void check_two_materials_at_one_depth(const ed_steel *steels)
{
  static const double y[] = {0.1, -0.1, 0.1, -0.1, 0.1}, area[] = {1.0, 1.0, 2.0, 2.0, 4.0};
  static const int material[] = {0, 0, 1, 0, 0};
  ed_section section;
  CHECK_INT(ed_section_from_fibres(&section, 5, y, NULL, area, material, NULL, steels), 1);
  CHECK_INT(section.n, 3);
  CHECK(section.area[0] == 3.0 && section.area[1] == 5.0 && section.area[2] == 2.0);
  CHECK(section.steel[1] == &steels[0] && section.steel[2] == &steels[1]);
  ed_section_free(&section);
}

static void check_order(const ed_steel *steels)
{
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES];
  numbers source = {5};
  const int n = i_section_fibres(4, 5, 0, 1, y, area, material);
  for (int i = 0; i < n; i++)
    area[i] *= next_number(&source, 0.5, 1.5); /* sums of these depend on their order */
  ed_section first;
  CHECK_INT(ed_section_from_fibres(&first, n, y, NULL, area, material, NULL, steels), 1);
  double state[MOST_SECTION_STATE];
  ed_section_initialise(&first, state);
  ed_section_commit(&first, state, (double[]){1e-3, 0.02}, NULL);
  for (int trial = 0; trial < 20; trial++) {
    shuffle(n, y, area, material, &source);
    ed_section other;
    CHECK_INT(ed_section_from_fibres(&other, n, y, NULL, area, material, NULL, steels), 1);
    CHECK_INT(other.n, first.n);
    CHECK_SAME(other.y, first.y, first.n);
    CHECK_SAME(other.area, first.area, first.n);
    ed_section_response a, b;
    ed_section_trial(&first, state, (double[]){-2e-4, -0.01}, NULL, &a);
    ed_section_trial(&other, state, (double[]){-2e-4, -0.01}, NULL, &b);
    CHECK_SAME(b.force, a.force, 2);
    CHECK_SAME(b.k, a.k, 3);
    ed_section_free(&other);
  }
  ed_section_free(&first);
}

int main(void)
{
  const ed_steel bilinear[] = {bilinear_steel(E, FY, 0.0), bilinear_steel(E, 1.3 * FY, 0.02)};
  const ed_steel curved[] = {menegotto_pinto_steel(E, FY, 0.01), bilinear_steel(E, 1.3 * FY, 0.02)};
  check_count_and_sums(bilinear);
  check_two_materials_at_one_depth(bilinear);
  check_order(bilinear);
  check_order(curved);
  return checks_end("merging of fibres");
}
