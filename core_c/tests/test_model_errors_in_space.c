/* What a model in space refuses beside what test_model_errors.c has: the right status, a message that names node or member, and a model
 * that still works afterwards. */
#include "checks.h"
#include "frame.h"

#include <math.h>
#include <string.h>

#define REFUSED(call, status, part)                       \
  do {                                                    \
    CHECK_STATUS((call), (status));                       \
    CHECK_CONTAINS(ed_model_message(model), (part));      \
  } while (0)

enum { ELASTIC, FIBRES, FLAT, SECTIONS };
enum { FOOT, TOP, SIDE, FLOOR, NODES };

static const int ALL[] = {1, 1, 1, 1, 1, 1}, UX[] = {1, 0, 0, 0, 0, 0}, UY[] = {0, 1, 0, 0, 0, 0}, UZ[] = {0, 0, 1, 0, 0, 0},
                 RZ[] = {0, 0, 0, 0, 0, 1}, OF_MASTER[] = {0, 0, 1, 1, 1, 0};
static const double ALONG_X[] = {1.0, 0.0, 0.0};

/* A material, three sections (the last in one plane), a foot, two nodes above it 4 m apart and the master of their floor between them. */
static ed_model *some_model(void)
{
  ed_model *model = ed_model_new(3);
  const double E = 2e11, y[] = {-0.1, 0.1, -0.1, 0.1}, z[] = {-0.1, -0.1, 0.1, 0.1}, area[] = {1e-3, 1e-3, 1e-3, 1e-3};
  const int material[4] = {0};
  CHECK_INT(ed_model_material(model, ED_ELASTIC, 1, &E), 0);
  CHECK_INT(ed_model_elastic_section(model, (double[]){8e8, 8e6, 8e6, 1e6}), ELASTIC);
  CHECK_INT(ed_model_fibre_section(model, 4, y, z, area, material, 1e6), FIBRES);
  CHECK_INT(ed_model_fibre_section(model, 4, y, NULL, area, material, 0.0), FLAT);
  CHECK_INT(ed_model_node(model, "foot", (double[]){0.0, 0.0, 0.0}), FOOT);
  CHECK_INT(ed_model_node(model, "top", (double[]){0.0, 0.0, 3.0}), TOP);
  CHECK_INT(ed_model_node(model, "side", (double[]){4.0, 0.0, 3.0}), SIDE);
  CHECK_INT(ed_model_node(model, "floor", (double[]){2.0, 0.0, 3.0}), FLOOR);
  CHECK_STATUS(ed_model_fix(model, FOOT, ALL), ED_OK);
  CHECK_STATUS(ed_model_fix(model, FLOOR, OF_MASTER), ED_OK);
  return model;
}

/* Column and beam, and equal masses at both of its ends. */
static void add_members(ed_model *model)
{
  CHECK_INT(ed_model_elastic_beam(model, "column", FOOT, TOP, ELASTIC, ED_P_DELTA, NULL, ALONG_X), 0);
  CHECK_INT(ed_model_elastic_beam(model, "beam", TOP, SIDE, ELASTIC, ED_LINEAR, NULL, (double[]){0.0, 0.0, 1.0}), 1);
  for (int node = TOP; node <= SIDE; node++)
    CHECK_STATUS(ed_model_mass(model, node, (double[]){1e3, 1e3, 1e3, 0.0, 0.0, 0.0}), ED_OK);
}

/* After all refusals the model still stands. */
static void check_stands(ed_model *model)
{
  ed_analysis *analysis = frame_analysis(model);
  CHECK(analysis != NULL);
  ed_analysis_free(analysis);
  ed_model_free(model);
}

static void check_sections(void)
{
  ed_model *model = some_model();
  const double y[] = {-0.1, 0.1, 0.2}, z[] = {-0.05, 0.05, 0.1}, none[] = {0.0, 0.0, 0.0}, area[] = {1e-3, 1e-3, 1e-3};
  const double endless[] = {0.0, HUGE_VAL, 0.1};
  const int material[3] = {0};
  REFUSED(ed_model_elastic_section(model, (double[]){1e9, 1e7, 0.0, 1e6}), ED_E_ARGUMENT, "EI about y 0");
  REFUSED(ed_model_elastic_section(model, (double[]){1e9, 1e7, 1e7, -1.0}), ED_E_ARGUMENT, "GJ -1");
  REFUSED(ed_model_fibre_section(model, 3, y, z, area, material, 1e6), ED_E_ARGUMENT, "one line"); /* it slopes */
  REFUSED(ed_model_fibre_section(model, 3, y, none, area, material, 1e6), ED_E_ARGUMENT, "one line");
  REFUSED(ed_model_fibre_section(model, 3, none, z, area, material, 1e6), ED_E_ARGUMENT, "one line");
  REFUSED(ed_model_fibre_section(model, 3, y, endless, area, material, 1e6), ED_E_ARGUMENT, "fibre 2");
  REFUSED(ed_model_fibre_section(model, 3, y, z, area, material, 0.0), ED_E_ARGUMENT, "GJ 0");
  REFUSED(ed_model_fibre_section(model, 3, y, z, area, material, NAN), ED_E_ARGUMENT, "GJ");
  CHECK_STATUS(ed_model_section_layers(model, SECTIONS), ED_E_ID); /* nothing was kept */
  add_members(model);
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, SIDE}), ED_OK);
  check_stands(model);
}

/* Of a column from the foot to the top: nothing may be left between offsets, nor may it run along its web. */
static void check_ends(ed_model *model)
{
  const double none[3] = {0.0, 0.0, 0.0}, wrong[3] = {0.0, NAN, 0.0}, beyond[3] = {0.0, 0.0, 9.0}, far_off[3] = {1e5, 0.0, 0.0};
  REFUSED(ed_model_rigid_ends(model, 0, 2.0, 2.0), ED_E_ARGUMENT, "column");
  REFUSED(ed_model_offset_ends(model, 0, wrong, none), ED_E_ARGUMENT, "column");
  REFUSED(ed_model_offset_ends(model, 0, beyond, none), ED_E_ARGUMENT, "column");
  REFUSED(ed_model_offset_ends(model, 0, none, far_off), ED_E_ARGUMENT, "along its web");
  REFUSED(ed_model_offset_ends(model, 77, none, none), ED_E_ID, "77");
}

static void check_members(void)
{
  ed_model *model = some_model();
  const int sections[] = {FIBRES, FLAT, FIBRES}, flat[] = {FLAT, FLAT, FLAT}, good[] = {FIBRES, FIBRES, FIBRES};
  const double along[] = {0.0, 0.0, 1.0}, slanted[] = {0.8, 0.0, 0.6}, little[] = {0.5, 0.0, 0.0}, none[] = {0.0, 0.0, 0.0};
  const double wrong[] = {NAN, 0.0, 0.0}, *const webs[] = {along, slanted, little, none, wrong};
  for (int i = 0; i < 5; i++) {
    REFUSED(ed_model_elastic_beam(model, "twisted", FOOT, TOP, ELASTIC, ED_LINEAR, NULL, webs[i]), ED_E_ARGUMENT, "twisted");
    CHECK_CONTAINS(ed_model_message(model), "web");
    REFUSED(ed_model_beam_column(model, "turned", FOOT, TOP, 3, good, ED_LINEAR, NULL, webs[i]), ED_E_ARGUMENT, "turned");
  }
  REFUSED(ed_model_elastic_beam(model, "flat", FOOT, TOP, FLAT, ED_LINEAR, NULL, ALONG_X), ED_E_ID, "flat");
  REFUSED(ed_model_beam_column(model, "half", FOOT, TOP, 3, sections, ED_LINEAR, NULL, ALONG_X), ED_E_ID, "half");
  REFUSED(ed_model_beam_column(model, "plane", FOOT, TOP, 3, flat, ED_LINEAR, NULL, ALONG_X), ED_E_ID, "plane");
  REFUSED(ed_model_link(model, "pad", FOOT, TOP, 1.0, 1.0, 1.0, 0.0), ED_E_ARGUMENT, "pad");
  REFUSED(ed_model_strut(model, "brace", FOOT, TOP, FIBRES, 3, 2, 1e-3, 1.0, 0.0, 0, 1e-3, ED_LINEAR), ED_E_ID, "brace");
  double coefficient[12] = {0.0};
  const double stiffness = 1e6;
  REFUSED(ed_model_spring(model, "loose", FOOT, TOP, coefficient, ED_SPRING_MULTILINEAR, 1, &stiffness), ED_E_ARGUMENT, "loose");
  coefficient[11] = NAN;
  REFUSED(ed_model_spring(model, "odd", FOOT, TOP, coefficient, ED_SPRING_MULTILINEAR, 1, &stiffness), ED_E_ARGUMENT, "coefficient 12");
  add_members(model); /* nothing was kept */
  check_ends(model);
  const int pattern = ed_model_pattern(model);
  REFUSED(ed_model_uniform_load(model, pattern, 1, 0.0, (double[]){0.0, NAN}), ED_E_ARGUMENT, "beam");
  REFUSED(ed_model_partial_load(model, pattern, 1, 0.1, 0.9, (double[]){0.0, 0.0}, (double[]){0.0, HUGE_VAL}), ED_E_ARGUMENT, "beam");
  REFUSED(ed_model_nodal_load(model, pattern, TOP, (double[]){0.0, 0.0, 0.0, 0.0, 0.0, NAN}), ED_E_ARGUMENT, "top");
  REFUSED(ed_model_mass(model, TOP, (double[]){0.0, 0.0, 0.0, 0.0, 0.0, -1.0}), ED_E_ARGUMENT, "top");
  REFUSED(ed_model_node(model, "sky", (double[]){0.0, 0.0, HUGE_VAL}), ED_E_ARGUMENT, "sky");
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, SIDE}), ED_OK);
  check_stands(model);
}

static void check_diaphragms(void)
{
  ed_model *model = some_model();
  const int both[] = {TOP, SIDE};
  const int other = ed_model_node(model, "other", (double[]){2.0, 5.0, 3.0}), last = ed_model_node(model, "last", (double[]){2.0, 6.0, 3.0});
  CHECK_STATUS(ed_model_fix(model, other, ALL), ED_OK);
  REFUSED(ed_model_diaphragm(model, FLOOR, 0, both), ED_E_ARGUMENT, "floor"); /* it moves nothing */
  REFUSED(ed_model_diaphragm(model, FLOOR, -1, both), ED_E_ARGUMENT, "floor");
  REFUSED(ed_model_diaphragm(model, 77, 2, both), ED_E_ID, "77");
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, 78}), ED_E_ID, "78");
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, FLOOR}), ED_E_ARGUMENT, "floor");
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, FOOT}), ED_E_ARGUMENT, "foot"); /* supported */
  CHECK_STATUS(ed_model_tie(model, last, TOP, UZ), ED_OK);                                  /* not in plan */
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 1, both), ED_OK);
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, (int[]){SIDE, TOP}), ED_E_ARGUMENT, "top"); /* it is in one */
  REFUSED(ed_model_diaphragm(model, TOP, 1, (int[]){SIDE}), ED_E_ARGUMENT, "top");        /* nested */
  REFUSED(ed_model_diaphragm(model, SIDE, 1, (int[]){FLOOR}), ED_E_ARGUMENT, "floor");
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 1, both + 1), ED_OK); /* more nodes of the same */
  const int *const in_plan[] = {UX, UY, RZ};
  static const char *const name[] = {"ux", "uy", "rz"};
  for (int d = 0; d < 3; d++) {
    REFUSED(ed_model_tie(model, last, TOP, in_plan[d]), ED_E_ARGUMENT, "top");
    CHECK_CONTAINS(ed_model_message(model), name[d]);
    REFUSED(ed_model_tie(model, TOP, last, in_plan[d]), ED_E_ARGUMENT, "top");
    REFUSED(ed_model_fix(model, TOP, in_plan[d]), ED_E_ARGUMENT, "top"); /* as before the diaphragm */
    CHECK_CONTAINS(ed_model_message(model), "floor");
  }
  CHECK_STATUS(ed_model_fix(model, last, ALL), ED_OK);
  ed_model_free(model);

  /* a node that others are tied to moves as they do, who know nothing of its lever */
  model = some_model();
  const int twin = ed_model_node(model, "twin", (double[]){0.0, 1.0, 3.0});
  CHECK_STATUS(ed_model_tie(model, twin, TOP, UX), ED_OK);
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, both), ED_E_ARGUMENT, "top");
  REFUSED(ed_model_diaphragm(model, FLOOR, 1, (int[]){twin}), ED_E_ARGUMENT, "twin");
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 1, (int[]){SIDE}), ED_OK); /* nothing was kept */
  ed_model_free(model);

  model = some_model();
  add_members(model);
  const double parameters[] = {1e3};
  CHECK_INT(ed_model_damper(model, "damper", ED_LAW_VISCOUS, 1, parameters, 0.0, 0.0, 1.0, 1.0, 1, (int[]){SIDE}, (int[]){0}, parameters), 0);
  REFUSED(ed_model_diaphragm(model, FLOOR, 2, both), ED_E_STATE, "dampers");
  REFUSED(ed_model_damper(model, "far", ED_LAW_VISCOUS, 1, parameters, 0.0, 0.0, 1.0, 1.0, 1, (int[]){SIDE}, (int[]){6}, parameters), ED_E_ID,
          "degree 6");
  REFUSED(ed_model_damper(model, "low", ED_LAW_VISCOUS, 1, parameters, 0.0, 0.0, 1.0, 1.0, 1, (int[]){SIDE}, (int[]){-1}, parameters), ED_E_ID,
          "low");
  ed_model_free(model);
}

/* The masses of a diaphragm stay uncoupled only about their centre; the message names the master, whichever node was made first. */
static void check_centre(void)
{
  for (int first = 0; first < 2; first++) {
    ed_model *model = some_model();
    const int both[] = {TOP, SIDE};
    int master = FLOOR, status = ED_OK;
    char message[300] = "";
    if (!first) {
      master = ed_model_node(model, "late", (double[]){2.0, 0.0, 3.0});
      CHECK_STATUS(ed_model_fix(model, master, OF_MASTER), ED_OK);
      CHECK_STATUS(ed_model_fix(model, FLOOR, ALL), ED_OK);
    }
    add_members(model);
    CHECK_STATUS(ed_model_mass(model, SIDE, (double[]){1.0, 0.0, 0.0, 0.0, 0.0, 0.0}), ED_OK);
    CHECK_STATUS(ed_model_diaphragm(model, master, 2, both), ED_OK);
    ed_analysis_free(frame_analysis(model)); /* nodes and master on one line: m_x has no lever */
    CHECK_STATUS(ed_model_mass(model, SIDE, (double[]){0.0, 1.0, 0.0, 0.0, 0.0, 0.0}), ED_OK);
    CHECK(!ed_analysis_new(model, &status, message, sizeof message));
    CHECK_STATUS(status, ED_E_ARGUMENT);
    CHECK_CONTAINS(message, first ? "floor" : "late");
    CHECK_CONTAINS(message, "centre");
    ed_model_free(model);
  }
}

static void check_analysis(void)
{
  ed_model *model = some_model();
  add_members(model);
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, SIDE}), ED_OK);
  const int pattern = ed_model_pattern(model);
  CHECK_STATUS(ed_model_nodal_load(model, pattern, FLOOR, (double[]){1e3, 1e3, 0.0, 0.0, 0.0, 1e3}), ED_OK);
  ed_analysis *a = frame_analysis(model);
  const double newmark[] = {0.5, 0.25}, still[2] = {0.0};
#define RUN_REFUSED(call, status, part)                \
  do {                                                 \
    CHECK_STATUS((call), (status));                    \
    CHECK_CONTAINS(ed_analysis_message(a), (part));    \
  } while (0)
  for (int d = 0; d < 2; d++) {
    RUN_REFUSED(ed_pushover_begin(a, pattern, TOP, d, 0.01, 1), ED_E_ARGUMENT, "top");
    CHECK_CONTAINS(ed_analysis_message(a), "floor");
  }
  RUN_REFUSED(ed_pushover_begin(a, pattern, FLOOR, 2, 0.01, 1), ED_E_ARGUMENT, "floor"); /* supported */
  RUN_REFUSED(ed_pushover_begin(a, pattern, FLOOR, 6, 0.01, 1), ED_E_ID, "degree 6");
  RUN_REFUSED(ed_pushover_begin(a, pattern, FLOOR, -1, 0.01, 1), ED_E_ID, "degree -1");
  CHECK_STATUS(ed_pushover_begin(a, pattern, FLOOR, 1, 0.001, 1), ED_OK);
  CHECK_STATUS(run_to_end(a, 1), ED_OK);
  for (int kind = ED_DISPLACEMENT; kind <= ED_REACTION; kind++) {
    CHECK(add_channel(a, kind, TOP, 5) >= 0);
    CHECK(add_channel(a, kind, TOP, 6) < 0);
  }
  CHECK(add_channel(a, ED_GROUND_ACCELERATION, 0, 2) >= 0);
  CHECK(add_channel(a, ED_GROUND_ACCELERATION, 0, 3) < 0);
  for (int kind = ED_END_FORCE; kind <= ED_GLOBAL_FORCE; kind++) {
    CHECK(add_channel(a, kind, 0, 11) >= 0);
    CHECK(add_channel(a, kind, 0, 12) < 0);
  }
  CHECK(add_channel(a, ED_DEFORMATION, 0, 4) >= 0);
  CHECK(add_channel(a, ED_DEFORMATION, 0, 5) < 0);
  CHECK_STATUS(ed_history_begin(a, 1, 0.01, still, still, still, ED_NEWMARK, newmark), ED_OK);
  RUN_REFUSED(ed_history_support(a, FOOT, 6, still, still, still), ED_E_ID, "degree 6");
  RUN_REFUSED(ed_history_support(a, TOP, 5, still, still, still), ED_E_ARGUMENT, "top");
  RUN_REFUSED(ed_history_force(a, 1, (int[]){TOP}, (int[]){6}, (double[]){1.0}), ED_E_ID, "degree 6");
  CHECK_STATUS(run_to_end(a, 1), ED_OK);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* A supported master: what a node of its diaphragm does is no motion of a support. */
static void check_supports(void)
{
  ed_model *model = some_model();
  add_members(model);
  CHECK_STATUS(ed_model_fix(model, FLOOR, UX), ED_OK);
  CHECK_STATUS(ed_model_diaphragm(model, FLOOR, 2, (int[]){TOP, SIDE}), ED_OK);
  ed_analysis *a = frame_analysis(model);
  const double newmark[] = {0.5, 0.25}, still[2] = {0.0};
  CHECK_STATUS(ed_history_begin(a, 1, 0.01, still, still, still, ED_NEWMARK, newmark), ED_OK);
  RUN_REFUSED(ed_history_support(a, TOP, 0, still, still, still), ED_E_ARGUMENT, "top");
  CHECK_CONTAINS(ed_analysis_message(a), "floor");
  CHECK_STATUS(ed_history_support(a, FLOOR, 0, still, still, still), ED_OK);
  CHECK_STATUS(run_to_end(a, 1), ED_OK);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* What only space has is refused in a plane. */
static void check_plane(void)
{
  ed_model *model = frame_model((frame_options){.bays = 1, .storeys = 1, .points = 4});
  const double y[] = {-0.1, 0.1}, area[] = {1e-3, 1e-3};
  const int material[] = {0, 0};
  CHECK(!ed_model_new(1) && !ed_model_new(4) && !ed_model_new(0));
  REFUSED(ed_model_diaphragm(model, 2, 1, (int[]){3}), ED_E_ARGUMENT, "plane");
  REFUSED(ed_model_fibre_section(model, 2, y, y, area, material, 1e6), ED_E_ARGUMENT, "plane");
  REFUSED(ed_model_damper(model, "out", ED_LAW_VISCOUS, 1, area, 0.0, 0.0, 1.0, 1.0, 1, (int[]){2}, (int[]){3}, area), ED_E_ID, "degree 3");
  ed_analysis *a = frame_analysis(model);
  CHECK(add_channel(a, ED_DISPLACEMENT, 2, 3) < 0);
  CHECK(add_channel(a, ED_GROUND_ACCELERATION, 0, 2) < 0);
  CHECK(add_channel(a, ED_END_FORCE, 0, 6) < 0);
  CHECK_STATUS(ed_pushover_begin(a, LATERAL, 2, 3, 0.01, 1), ED_E_ID);
  ed_analysis_free(a);
  ed_model_free(model);
}

int main(void)
{
  check_sections();
  check_members();
  check_diaphragms();
  check_centre();
  check_analysis();
  check_supports();
  check_plane();
  return checks_end("refusals of models in space");
}
