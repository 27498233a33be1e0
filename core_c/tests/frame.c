#include "frame.h"

#include "checks.h"
#include "sections.h"

#include <math.h>
#include <stdio.h>

const double AVERAGE_ACCELERATION[2] = {0.5, 0.25};

int frame_node(frame_options o, int line, int floor)
{
  return floor * (o.bays + 1) + line;
}

ed_model *frame_model(frame_options o)
{
  ed_model *model = ed_model_new(2);
  const double steel[] = {2.1e11, 275e6, o.hardening};
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int material[MOST_FIBRES], sections[10];
  CHECK_INT(ed_model_material(model, ED_BILINEAR, 3, steel), 0);
  const int fibres = i_section_fibres(4, 1, 0, 0, y, area, material);
  CHECK_INT(ed_model_fibre_section(model, fibres, y, NULL, area, material, 0.0), 0);
  for (int p = 0; p < 10; p++)
    sections[p] = 0;
  CHECK_INT(ed_model_pattern(model), GRAVITY);
  CHECK_INT(ed_model_pattern(model), LATERAL);
  for (int floor = 0; floor <= o.storeys; floor++)
    for (int line = 0; line <= o.bays; line++) {
      char name[16];
      snprintf(name, sizeof name, "%c%d", 'A' + line % 26, floor);
      const int node = ed_model_node(model, name, (double[]){6.0 * line, 3.5 * floor});
      CHECK_INT(node, frame_node(o, line, floor));
      if (floor == 0)
        CHECK_STATUS(ed_model_fix(model, node, (int[]){1, 1, 1}), ED_OK);
      else
        CHECK_STATUS(ed_model_mass(model, node, (double[]){20e3, 20e3, 0.0}), ED_OK);
    }
  for (int floor = 1; floor <= o.storeys; floor++) {
    for (int line = 0; line <= o.bays; line++) {
      char name[24];
      snprintf(name, sizeof name, "C_%c_%d", 'A' + line % 26, floor);
      CHECK(ed_model_beam_column(model, name, frame_node(o, line, floor - 1), frame_node(o, line, floor), o.points, sections, o.geometry, NULL, NULL) >= 0);
    }
    for (int bay = 1; bay <= o.bays; bay++) {
      char name[24];
      snprintf(name, sizeof name, "B_%d_%d", bay, floor);
      const int beam = ed_model_beam_column(model, name, frame_node(o, bay - 1, floor), frame_node(o, bay, floor), o.points, sections, ED_LINEAR, NULL, NULL);
      CHECK_STATUS(ed_model_uniform_load(model, GRAVITY, beam, 0.0, (double[]){-25e3}), ED_OK);
    }
    CHECK_STATUS(ed_model_nodal_load(model, LATERAL, frame_node(o, 0, floor), (double[]){1e3 * floor, 0.0, 0.0}), ED_OK);
  }
  return model;
}

ed_analysis *frame_analysis(const ed_model *model)
{
  char message[512] = "";
  int status = ED_OK;
  ed_analysis *analysis = ed_analysis_new(model, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  if (!analysis)
    printf("%s\n", message);
  return analysis;
}

int run_to_end(ed_analysis *analysis, int steps)
{
  const int status = ed_run_advance(analysis, steps);
  ed_run_end(analysis);
  return status;
}

int add_channel(ed_analysis *analysis, int kind, int object, int component)
{
  const double one = 1.0;
  return ed_channel(analysis, 1, &one, &kind, &object, &component, 1);
}

void ground_motion(int n, double dt, double peak, double *acceleration)
{
  for (int i = 0; i <= n; i++) {
    const double t = i * dt;
    acceleration[i] = peak * fmin(1.0, t) * (0.6 * sin(5.1 * t) + 0.3 * sin(11.7 * t + 1.0) + 0.1 * sin(31.0 * t));
  }
}

void add_dampers(ed_model *model, frame_options o)
{
  static const double parameters[][12] = {
      [ED_LAW_KELVIN_VOIGT] = {2e5, 3e3}, [ED_LAW_ZENER] = {1e5, 2e5, 1e4}, [ED_LAW_GENERALISED_MAXWELL] = {1e5, 1e5, 1e4, 2e5, 3e3},
      [ED_LAW_FRACTIONAL_KELVIN] = {1e5, 0.2, 0.5}, [ED_LAW_FRACTIONAL_ZENER] = {1e5, 0.1, 0.5, 0.6}, [ED_LAW_VISCOUS] = {3e3},
      [ED_LAW_VISCOUS_POWER] = {3e3, 0.5}, [ED_LAW_MAXWELL] = {5e3, 0.2}, [ED_LAW_MAXWELL_POWER] = {5e3, 0.5, 1e5},
      [ED_LAW_FRACTIONAL_MAXWELL] = {5e3, 0.2, 0.6}, [ED_LAW_FRICTION] = {0.3, 2e3, 1e5}, [ED_LAW_ELASTIC_PLASTIC] = {1e5, 5e2, 0.02},
      [ED_LAW_RAMBERG_OSGOOD] = {1e5, 5e2, 0.1, 8.0}, [ED_LAW_BOUC_WEN] = {500.0, 5e-3, 0.05, 1.0, 0.5, 0.5, 1.0},
      [ED_LAW_MODIFIED_BOUC_WEN] = {1e5, 2e4, 0.01, 5e-3, 0.05, 1.0, 0.5, 0.5, 1.0, 2e3, 0.5},
      [ED_LAW_ASYMPTOTE] = {500.0, 1e5, 1e5, 0.0, 2.0, 1.5, 1e3}, [ED_LAW_LINEARISED] = {1e5, 0.2, 10.0},
      [ED_LAW_MGMM] = {5e4, 1.5e3, 1e4, 2e3, 0.4, 3e5, 3e5, 8e-3, 9e4, 2e4, 13e-3, 0.0}};
  static const int count[] = {2, 3, 5, 3, 4, 1, 2, 2, 3, 3, 3, 3, 4, 7, 11, 7, 3, 12};
  const int degree[] = {0, 0};
  const double coefficient[] = {1.0, -1.0};
  for (int storey = 1; storey <= 2; storey++)
    for (int law = ED_LAW_KELVIN_VOIGT; law <= ED_LAW_MGMM; law++) {
      const int node[] = {frame_node(o, 0, storey), frame_node(o, 0, storey - 1)};
      CHECK(ed_model_damper(model, "damper", law, count[law], parameters[law], storey == 2 ? 5e5 : 0.0, 0.0, 1.0, 1.0, 2, node, degree,
                            coefficient) >= 0);
    }
}
