/* What a model refuses: the right status, a message that names the object, and a model that still works afterwards. */
#include "checks.h"
#include "frame.h"

#include <math.h>
#include <string.h>

#define REFUSED(call, status, part)                       \
  do {                                                    \
    CHECK_STATUS((call), (status));                       \
    CHECK_CONTAINS(ed_model_message(model), (part));      \
  } while (0)

static const frame_options SMALL = {.bays = 1, .storeys = 1, .points = 4};

static void check_materials(void)
{
  ed_model *model = ed_model_new(2);
  const double good[] = {2e11, 3e8, 0.01, 20.0, 0.925, 0.15};
  REFUSED(ed_model_material(model, 7, 3, good), ED_E_ARGUMENT, "7");
  REFUSED(ed_model_material(model, -1, 3, good), ED_E_ARGUMENT, "-1");
  REFUSED(ed_model_material(model, ED_BILINEAR, 2, good), ED_E_ARGUMENT, "parameters 2");
  static const double bad_values[] = {0.0, -1.0, 1.0, 0.0, 1.0, 0.0};
  for (int i = 0; i < 6; i++) {
    double p[6];
    memcpy(p, good, sizeof p);
    p[i] = i == 2 || i == 4 ? bad_values[i] : i == 0 ? 0.0 : -1.0;
    REFUSED(ed_model_material(model, ED_MENEGOTTO_PINTO, 6, p), ED_E_ARGUMENT, "material");
    p[i] = i % 2 ? NAN : HUGE_VAL;
    REFUSED(ed_model_material(model, ED_MENEGOTTO_PINTO, 6, p), ED_E_ARGUMENT, "finite");
  }
  CHECK_INT(ed_model_material(model, ED_MENEGOTTO_PINTO, 6, good), 0);
  CHECK_INT(ed_model_elastic_section(model, (double[]){1e9, 1e8}), 0);
  REFUSED(ed_model_material(model, ED_ELASTIC, 1, good), ED_E_STATE, "material");
  ed_model_free(model);
}

static void check_sections(void)
{
  ed_model *model = ed_model_new(2);
  const double E = 2e11, y[] = {-0.1, 0.1}, area[] = {0.01, 0.01}, none[] = {0.01, 0.0}, flat[] = {0.1, 0.1};
  const double endless[] = {0.1, HUGE_VAL};
  const int material[] = {0, 0}, missing[] = {0, 3};
  CHECK_INT(ed_model_material(model, ED_ELASTIC, 1, &E), 0);
  REFUSED(ed_model_elastic_section(model, (double[]){0.0, 1.0}), ED_E_ARGUMENT, "EA 0");
  REFUSED(ed_model_elastic_section(model, (double[]){1.0, -2.0}), ED_E_ARGUMENT, "EI -2");
  REFUSED(ed_model_elastic_section(model, (double[]){NAN, 1.0}), ED_E_ARGUMENT, "section");
  REFUSED(ed_model_fibre_section(model, 0, y, NULL, area, material, 0.0), ED_E_ARGUMENT, "fibre");
  REFUSED(ed_model_fibre_section(model, 2, y, NULL, none, material, 0.0), ED_E_ARGUMENT, "fibre 2");
  REFUSED(ed_model_fibre_section(model, 2, endless, NULL, area, material, 0.0), ED_E_ARGUMENT, "fibre 2");
  REFUSED(ed_model_fibre_section(model, 2, y, NULL, area, missing, 0.0), ED_E_ID, "material 3");
  REFUSED(ed_model_fibre_section(model, 2, flat, NULL, area, material, 0.0), ED_E_ARGUMENT, "bending");
  CHECK_STATUS(ed_model_section_layers(model, 0), ED_E_ID); /* nothing was kept */
  CHECK_INT(ed_model_fibre_section(model, 2, y, NULL, area, material, 0.0), 0);
  CHECK_INT(ed_model_section_layers(model, 0), 2);
  CHECK_STATUS(ed_model_section_layers(model, -1), ED_E_ID);
  ed_model_free(model);
}

static void check_nodes(void)
{
  ed_model *model = frame_model(SMALL);
  REFUSED(ed_model_node(model, "lost", (double[]){NAN, 0.0}), ED_E_ARGUMENT, "lost");
  REFUSED(ed_model_node(model, "far", (double[]){0.0, HUGE_VAL}), ED_E_ARGUMENT, "far");
  REFUSED(ed_model_fix(model, 99, (int[]){1, 1, 1}), ED_E_ID, "99");
  REFUSED(ed_model_fix(model, -1, (int[]){1, 1, 1}), ED_E_ID, "-1");
  REFUSED(ed_model_tie(model, 2, 98, (int[]){1, 0, 0}), ED_E_ID, "98");
  REFUSED(ed_model_tie(model, 97, 2, (int[]){1, 0, 0}), ED_E_ID, "97");
  REFUSED(ed_model_tie(model, 2, 2, (int[]){1, 0, 0}), ED_E_ARGUMENT, "A1");
  CHECK_STATUS(ed_model_tie(model, 3, 2, (int[]){1, 0, 0}), ED_OK);
  CHECK_STATUS(ed_model_tie(model, 2, 3, (int[]){1, 0, 0}), ED_OK); /* the same group already */
  REFUSED(ed_model_mass(model, 96, (double[]){1.0, 1.0, 0.0}), ED_E_ID, "96");
  REFUSED(ed_model_mass(model, 2, (double[]){-1.0, 0.0, 0.0}), ED_E_ARGUMENT, "A1");
  REFUSED(ed_model_mass(model, 2, (double[]){0.0, NAN, 0.0}), ED_E_ARGUMENT, "A1");
  ed_model_free(model);
}

static void check_members(void)
{
  ed_model *model = frame_model(SMALL);
  int sections[11] = {0}, missing[] = {0, 0, 5};
  const int twin = ed_model_node(model, "A1 twin", (double[]){0.0, 3.5});
  REFUSED(ed_model_beam_column(model, "short", 0, 2, 1, sections, ED_LINEAR, NULL, NULL), ED_E_ARGUMENT, "short");
  REFUSED(ed_model_beam_column(model, "many", 0, 2, 11, sections, ED_LINEAR, NULL, NULL), ED_E_ARGUMENT, "many");
  REFUSED(ed_model_beam_column(model, "b", 0, 2, 3, missing, ED_LINEAR, NULL, NULL), ED_E_ID, "section 5");
  REFUSED(ed_model_beam_column(model, "b", 0, 77, 3, sections, ED_LINEAR, NULL, NULL), ED_E_ID, "node 77");
  REFUSED(ed_model_beam_column(model, "point", 2, twin, 3, sections, ED_LINEAR, NULL, NULL), ED_E_ARGUMENT, "point");
  REFUSED(ed_model_beam_column(model, "loop", 2, 2, 3, sections, ED_LINEAR, NULL, NULL), ED_E_ARGUMENT, "loop");
  REFUSED(ed_model_beam_column(model, "odd", 0, 2, 3, sections, 3, NULL, NULL), ED_E_ARGUMENT, "odd");
  REFUSED(ed_model_elastic_beam(model, "e", 0, 2, 5, ED_LINEAR, NULL, NULL), ED_E_ID, "section 5");
  REFUSED(ed_model_elastic_beam(model, "zero", twin, 2, 0, ED_LINEAR, NULL, NULL), ED_E_ARGUMENT, "zero");
  REFUSED(ed_model_truss(model, "bar", 0, 2, 9, 0.01, ED_LINEAR), ED_E_ID, "material 9");
  REFUSED(ed_model_truss(model, "thin", 0, 2, 0, 0.0, ED_LINEAR), ED_E_ARGUMENT, "thin");
  REFUSED(ed_model_truss(model, "flat", twin, 2, 0, 0.01, ED_LINEAR), ED_E_ARGUMENT, "flat");
  REFUSED(ed_model_link(model, "soft", 0, 2, -1.0, 0.0, 0.0, 0.0), ED_E_ARGUMENT, "soft");
  REFUSED(ed_model_link(model, "turned", 0, 2, 1.0, 0.0, 0.0, NAN), ED_E_ARGUMENT, "turned");
  REFUSED(ed_model_link(model, "self", 2, 2, 1.0, 0.0, 0.0, 0.0), ED_E_ARGUMENT, "self");
  REFUSED(ed_model_link(model, "gone", 2, 55, 1.0, 0.0, 0.0, 0.0), ED_E_ID, "55");
  CHECK_INT(ed_model_link(model, "pad", 2, twin, 1e8, 1e8, 1e8, 0.0), 3); /* columns, beam; nothing was kept */
  REFUSED(ed_model_uniform_load(model, GRAVITY, 3, 0.0, (double[]){-1.0}), ED_E_ARGUMENT, "pad");
  ed_analysis *analysis = frame_analysis(model); /* after all this the model still stands */
  ed_analysis_free(analysis);
  ed_model_free(model);
}

static void check_loads(void)
{
  ed_model *model = frame_model(SMALL);
  REFUSED(ed_model_nodal_load(model, 5, 2, (double[]){1.0, 0.0, 0.0}), ED_E_ID, "pattern 5");
  REFUSED(ed_model_nodal_load(model, LATERAL, 44, (double[]){1.0, 0.0, 0.0}), ED_E_ID, "44");
  REFUSED(ed_model_nodal_load(model, LATERAL, 2, (double[]){NAN, 0.0, 0.0}), ED_E_ARGUMENT, "A1");
  REFUSED(ed_model_uniform_load(model, 5, 2, 0.0, (double[]){1.0}), ED_E_ID, "pattern 5");
  REFUSED(ed_model_uniform_load(model, GRAVITY, 33, 0.0, (double[]){1.0}), ED_E_ID, "element 33");
  REFUSED(ed_model_uniform_load(model, GRAVITY, 2, 0.0, (double[]){HUGE_VAL}), ED_E_ARGUMENT, "B_1_1");
  REFUSED(ed_model_point_load(model, GRAVITY, 2, 0.5, NAN, (double[]){0.0}), ED_E_ARGUMENT, "B_1_1");
  REFUSED(ed_model_point_load(model, GRAVITY, 33, 0.5, 0.0, (double[]){1.0}), ED_E_ID, "element 33");
  REFUSED(ed_model_point_load(model, GRAVITY, 2, 1.5, 0.0, (double[]){1.0}), ED_E_ARGUMENT, "1.5");
  CHECK_CONTAINS(ed_model_message(model), "B_1_1");
  REFUSED(ed_model_point_load(model, GRAVITY, 2, NAN, 0.0, (double[]){1.0}), ED_E_ARGUMENT, "B_1_1");
  ed_model_free(model);
}

/* Every array grows many times; names longer than there is room for are cut. */
static void check_growth(void)
{
  ed_model *model = ed_model_new(2);
  char name[200];
  memset(name, 'x', sizeof name - 1);
  name[sizeof name - 1] = '\0';
  CHECK_INT(ed_model_elastic_section(model, (double[]){1e9, 1e8}), 0);
  const int pattern = ed_model_pattern(model);
  for (int i = 0; i < 300; i++) {
    CHECK_INT(ed_model_node(model, i % 2 ? name : NULL, (double[]){i, 0.0}), i);
    if (i > 0)
      CHECK_INT(ed_model_elastic_beam(model, i % 2 ? NULL : name, i - 1, i, 0, ED_LINEAR, NULL, NULL), i - 1);
    CHECK_STATUS(ed_model_nodal_load(model, pattern, i, (double[]){0.0, 1.0, 0.0}), ED_OK);
    if (i > 0)
      CHECK_STATUS(ed_model_point_load(model, pattern, i - 1, 0.5, 0.0, (double[]){1.0}), ED_OK);
  }
  CHECK_STATUS(ed_model_fix(model, 0, (int[]){1, 1, 1}), ED_OK);
  ed_analysis *analysis = frame_analysis(model);
  CHECK_INT(ed_n_equations(analysis), 3 * 299);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

int main(void)
{
  check_materials();
  check_sections();
  check_nodes();
  check_members();
  check_loads();
  check_growth();
  ed_model_free(NULL);
  return checks_end("refusals of the model");
}
