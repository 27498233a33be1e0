/* Sections with stresses before any load: their states, fibres that are merged, and what is refused. */
#include "checks.h"
#include "edcore.h"
#include "section/section.h"
#include "steels.h"

#include <math.h>

enum { FIBRES = 6 };
static const double E = 2.1e11, FY = 275e6;
static const double y[FIBRES] = {-0.1, -0.1, -0.1, 0.1, 0.1, 0.1}, area[FIBRES] = {1e-3, 1e-3, 2e-3, 1e-3, 1e-3, 2e-3};
static const double stress[FIBRES] = {-1e8, -1e8, 1e8, 1e8, -1e8, 1e7};

static void check_state(void)
{
  static const int material[FIBRES] = {0};
  const double balanced[FIBRES] = {-1e8, -1e8, 1e8, -1e8, -1e8, 1e8};
  const ed_steel steel = bilinear_steel(E, FY, 0.01);
  ed_section section;
  CHECK_INT(ed_section_from_fibres(&section, FIBRES, y, NULL, area, material, balanced, &steel), 1);
  CHECK_INT(section.n, 4); /* of one depth the fibres of one stress */
  CHECK_NEAR(section.yield_strain, (FY - 1e8 / 0.99) / E, 1e-15);
  double state[8], at[2] = {0.0, 0.0}, value, strain;
  CHECK_INT(section.state_size, 8);
  ed_section_response response;
  ed_section_initialise(&section, state);
  ed_section_trial(&section, state, at, NULL, &response);
  CHECK_INT(response.elastic, 1);
  CHECK_NEAR(response.force[0], 0.0, 1e-9);
  CHECK_NEAR(response.force[1], 0.0, 1e-9);
  ed_section_layer(&section, state, 0, at, &value, &strain);
  CHECK_NEAR(value, -1e8, 1e-6);
  CHECK_NEAR(strain, 0.0, 0.0);
  CHECK_NEAR(ed_section_stored(&section, state, at), 0.0, 1e-9);
  at[0] = 1e-4;
  ed_section_trial(&section, state, at, NULL, &response);
  CHECK_NEAR(response.force[0], E * 8e-3 * 1e-4, 1e-6);
  CHECK_NEAR(ed_section_stored(&section, state, at), 0.5 * E * 8e-3 * 1e-8, 1e-6);
  at[0] = -1.001 * section.yield_strain;
  ed_section_trial(&section, state, at, NULL, &response);
  CHECK_INT(response.elastic, 0);
  ed_section_free(&section);
}

static void check_refusals(void)
{
  ed_model *model = ed_model_new(2);
  const int elastic = ed_model_material(model, ED_ELASTIC, 1, &E);
  const int steel = ed_model_material(model, ED_BILINEAR, 3, (double[]){E, FY, 0.0});
  int material[FIBRES];
  for (int i = 0; i < FIBRES; i++)
    material[i] = steel;
  CHECK_INT(ed_model_stressed_section(model, FIBRES, y, NULL, area, material, stress, 0.0), ED_E_ARGUMENT);
  CHECK_INT(ed_model_stressed_section(model, FIBRES, y, NULL, area, material, (double[FIBRES]){NAN}, 0.0), ED_E_ARGUMENT);
  CHECK_INT(ed_model_stressed_section(model, FIBRES, y, NULL, area, material, (double[FIBRES]){0.0}, 0.0), 0);
  material[2] = elastic;
  CHECK_INT(ed_model_stressed_section(model, FIBRES, y, NULL, area, material, (double[FIBRES]){0.0}, 0.0), ED_E_ARGUMENT);
  ed_model_free(model);
}

int main(void)
{
  check_state();
  check_refusals();
  return checks_end("stresses of sections before any load");
}
